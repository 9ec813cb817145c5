"""A changed equation is never hidden: a stale library is refused; every cache, journal and FMU sees the change."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from twintube import provenance
from twintube.native import library

ROOT = Path(__file__).parents[2]
# A constant or an operator of five files of the model, and the change.
MUTATIONS = {
    "kernel/forces.py": ("1.0", "1.0625"),
    "kernel/rebound.py": ("d.Y_Re * oil", "0.75 * d.Y_Re * oil"),
    "kernel/step.py": ("acting / abs(dz)", "0.75 * acting / abs(dz)"),
    "effects/oil_temperature.py": ("-p.fade_heat", "-1.0625 * p.fade_heat"),
    "model.py": ("0.5 *", "0.5625 *"),
}
KEPT = (
    "twintube.report.paper.records",
    "twintube.report.paper.fitted",
    "twintube.studies.cases",
    "twintube.identification.objective",
)
PROBE = """
import hashlib, json, sys
from twintube import load, harmonic_block, provenance, simulate
from twintube.engine import compiled
from twintube.fmu import python_kind
from twintube.native.headers import header
from twintube.native.library import LibraryError
damper = load("SA8").with_(oil_level=0.6, gas_preload=0, fade_heat=1e-4)
block = harmonic_block(1.048, dt=5e-3)
try:
    compiled.module()
    refused = ""
except LibraryError as error:
    refused = str(error)
result = simulate(damper, block.stroke, block.velocity, block.time, interpreted=True)
print(json.dumps({
    "refused": refused,
    "native_kind": hashlib.sha256(header("kernel.h").encode()).hexdigest(),
    "python_kind": hashlib.sha256(json.dumps(python_kind.carried_sources()).encode()).hexdigest(),
    "work": float(result.work[-1]),
    **{module: provenance.fingerprint(module) for module in sys.argv[1:]},
}))
"""


def package(folder: Path) -> Path:
    """A copy of the package's sources and library as a folder for the module search path."""
    library.present()
    shutil.copytree(ROOT / "src" / "twintube", folder / "twintube", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(ROOT / "fmu_src", folder / "twintube" / "fmu_sources", ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def probe(folder: Path, output: Path) -> dict[str, object]:
    """What the copy of the package says."""
    output.mkdir()
    done = subprocess.run(
        [sys.executable, "-c", PROBE, *KEPT],
        capture_output=True, text=True, check=False, env=os.environ | {"PYTHONPATH": str(folder)}, cwd=output,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return dict(json.loads(done.stdout))


@pytest.fixture(scope="module")
def original(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    folder = tmp_path_factory.mktemp("original")
    return probe(package(folder / "src"), folder / "out")


def test_the_library_belongs_to_the_package_as_it_is(original: dict[str, object]) -> None:
    assert original["refused"] == ""


SOME = ("kernel/forces.py", "effects/oil_temperature.py")  # by default; the others at night


@pytest.mark.parametrize("name", [n if n in SOME else pytest.param(n, marks=pytest.mark.slow) for n in MUTATIONS])
def test_a_changed_equation_shows_everywhere(name: str, original: dict[str, object], tmp_path: Path) -> None:
    folder = package(tmp_path / "src")
    path = folder / "twintube" / "core" / name
    text = path.read_text(encoding="utf-8")
    old, new = MUTATIONS[name]
    body = text.index("\ndef ")
    assert old in text[body:]
    path.write_text(text[:body] + text[body:].replace(old, new, 1), encoding="utf-8")
    changed = probe(folder, tmp_path / "out")
    assert "is of other equations: run `python -m twintube.native`" in str(changed["refused"])
    assert str(changed["refused"]).count("\n") == 0
    assert changed["work"] != original["work"]
    for what in ("native_kind", "python_kind", *KEPT):
        assert changed[what] != original[what], what


def test_what_does_not_matter_does_not_change_a_fingerprint() -> None:
    names = {path.name for path in provenance.files("twintube.identification.objective")}
    assert "SA8.toml" in names
    assert "page.html" not in names
    assert not {path.name for path in provenance.files("twintube.engine.simulate")} & {"reproduce.py", "base.py"}


def test_a_fingerprint_follows_imports_dynamic_ones_and_named_files() -> None:
    files = {"/".join(path.parts[-2:]) for path in provenance.files("twintube.engine.simulate")}
    assert {
        "kernel/forces.py",
        "effects/oil_temperature.py",
        "core/model.py",
        "engine/loops.py",
        "vehicle/loops.py",
    } <= files
