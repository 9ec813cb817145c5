"""The section "Add an effect" of docs/effects.md, followed to the letter in a copy of the package."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from twintube.native import library

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "effects.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"<!-- file: (\S+) -->\n```python\n(.*?)```", re.DOTALL)

HEAD = """
import numpy as np

import twintube
from twintube import harmonic_block, load, simulate
from twintube.core.effects import EFFECTS, active
from twintube.core.hooks import sources

assert twintube.__file__.startswith(COPY), twintube.__file__
(name,) = set(sources()) - set(OLD)
plain = load("SA8", as_published=True)
damper = plain.with_(groove_share=0.5)
assert active(damper.parameters) == (name,)
"""
INTERPRETED = """
from twintube.core import model
from twintube.core.effects import State
from twintube.core.variables import Derived, Flow, blank
from twintube.fmu.description import described
from twintube.native.headers import header
from twintube.native.library import LibraryError


def fluid(damper):
    p, d, s, f = damper.parameters, blank(Derived), blank(State), blank(Flow)
    model.set_up(p, d)
    model.start(p, d, s, -0.04)
    forces = []
    for i in range(1, 81):
        model.advance(p, d, s, f, -0.04 + 0.001 * i, 0.5, 0.5, 0.002)
        forces.append(s.F_fluid)
    return np.array(forces)


ratio = fluid(damper) / fluid(plain)
stroke = 0.001 * np.arange(1, 81) - 0.04
np.testing.assert_allclose(ratio, 1 - 0.5 * np.exp(-((stroke / 0.02) ** 2)), rtol=1e-9)
xml = described(damper, "{0}", "2025-01-01T00:00:00Z", {}, sources=[], categories=[]).decode()
assert 'name="bypass_groove.groove_share"' in xml and 'name="bypass_groove.groove_length"' in xml
assert "bypass_groove_scale_fluid" in header("kernel.h")
try:
    simulate(damper, harmonic_block(0.524, dt=5e-3))
except LibraryError as error:
    assert "run `python -m twintube.native`" in str(error)
else:
    raise AssertionError("a library without the effect was taken for current")
"""
COMPILED = """
block = harmonic_block(0.524, dt=5e-3)
a, b = (simulate(d, block.stroke, block.velocity, block.time) for d in (plain, damper))
fast = (np.abs(b.stroke) < 2e-3) & (np.abs(b.velocity) > 0.1)
np.testing.assert_allclose(b.columns["F_fluid"][fast] / a.columns["F_fluid"][fast], 0.5, atol=0.01)
"""
RENAMED = """
from twintube import harmonic_block, load, simulate
from twintube.core.effects import EFFECTS, active

values = {i.name: 0.1 * i.metadata["upper"] for effect in EFFECTS.values() for i in effect.parameters
          if i.metadata["role"] == "strength" and i.name != "groove_share"}
damper = load("SA8", as_published=True).with_(oil_level=0.6, gas_preload=0, **values)
block = harmonic_block(1.572, dt=4e-3)
parts = (block.stroke[-400:], block.velocity[-400:], block.time[-400:])
result = simulate(damper, *parts, interpreted=True)
print(" ".join(active(damper.parameters)))
print("".join(values.tobytes().hex() for values in result.columns.values()))
"""


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Python with the copy of the package."""
    environment = os.environ | {"PYTHONPATH": str(folder)}
    return subprocess.run(
        [sys.executable, *arguments], cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=300
    )


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    library.present()
    folder = tmp_path_factory.mktemp("copy")
    ignored = shutil.ignore_patterns("__pycache__", "examples", "fmu_sources")
    shutil.copytree(ROOT / "src" / "twintube", folder / "twintube", ignore=ignored)
    shutil.copytree(ROOT / "fmu_src", folder / "twintube" / "fmu_sources", ignore=ignored)
    ((path, text),) = BLOCK.findall(PAGE)
    assert not (folder / "twintube" / path).exists()
    (folder / "twintube" / path).write_text(text, encoding="utf-8")
    return folder


def head(copy: Path) -> str:
    """The beginning of a script: the effect is the only one that this checkout does not have."""
    from twintube.core.hooks import sources

    return f"COPY = {str(copy)!r}\nOLD = {sorted(sources())!r}\n{HEAD}"


def test_the_page_gives_an_effect_that_works(copy: Path) -> None:
    done = run(copy, "-c", head(copy) + INTERPRETED)
    assert done.returncode == 0, done.stderr


def test_the_compiled_model_has_it(copy: Path) -> None:
    made = run(copy, "-m", "twintube.native")
    assert made.returncode == 0, made.stderr
    done = run(copy, "-c", head(copy) + COMPILED)
    assert done.returncode == 0, done.stderr


def test_the_generated_parts_know_it(copy: Path) -> None:
    stubs = run(copy, "-m", "twintube.stubs")
    assert stubs.returncode == 0, stubs.stderr
    assert "groove_share: float" in (copy / "twintube" / "core" / "effects" / "__init__.pyi").read_text(encoding="utf-8")
    table = run(copy, "-m", "twintube", "dampers", "--variables")
    assert "- `bypass_groove.groove_share`, " in table.stdout, table.stderr


def test_the_name_of_a_file_changes_no_result(copy: Path) -> None:
    """All effects at once; that of fluid_lag comes after others in the alphabet then, but not in the model."""
    before = run(copy, "-c", RENAMED)
    folder = copy / "twintube" / "core" / "effects"
    text = (folder / "fluid_lag.py").read_text(encoding="utf-8")
    (folder / "fluid_lag.py").unlink()
    (folder / "zz_lag.py").write_text(text.replace("fluid_lag", "zz_lag"), encoding="utf-8")
    try:
        after = run(copy, "-c", RENAMED)
    finally:
        (folder / "zz_lag.py").unlink()
        (folder / "fluid_lag.py").write_text(text, encoding="utf-8")
    assert (before.returncode, after.returncode) == (0, 0), before.stderr + after.stderr
    (names, bits), (other_names, other_bits) = before.stdout.splitlines(), after.stdout.splitlines()
    assert "fluid_lag" in names and other_names.split()[-1] == "zz_lag"
    assert bits == other_bits


def test_two_effects_of_one_order_are_refused(copy: Path) -> None:
    folder = copy / "twintube" / "core" / "effects"
    text = (folder / "end_stop.py").read_text(encoding="utf-8")
    (folder / "end_stop.py").write_text(re.sub(r"^ORDER = .*", "ORDER = 20", text, flags=re.M), encoding="utf-8")
    try:
        done = run(copy, "-c", "import twintube.core.effects")
    finally:
        (folder / "end_stop.py").write_text(text, encoding="utf-8")
    assert done.returncode != 0
    assert "both have ORDER = 20" in done.stderr.splitlines()[-1]


def test_an_unknown_unit_is_an_error(copy: Path) -> None:
    ((path, text),) = BLOCK.findall(PAGE)
    other = copy / "twintube" / path
    other.write_text(text.replace('"bypass_groove", "", "m"', '"bypass_groove", "", "furlong"'), encoding="utf-8")
    try:
        done = run(copy, "-c", "import twintube.core.effects")
    finally:
        other.write_text(text, encoding="utf-8")
    assert done.returncode != 0
    assert "unit 'furlong' of bypass_groove" in done.stderr.splitlines()[-1]


STATE = """

@dataclass(frozen=False, slots=True)
class State(Frame):
    \"\"\"What it remembers.\"\"\"

    warmth: float = {}
"""


@pytest.mark.parametrize(
    ("old", "new", "name"),
    [
        ("def bypass_groove_scale", STATE.format("0.0") + "\n\ndef bypass_groove_scale", "State.warmth"),
        (
            "def bypass_groove_scale",
            STATE.format('var("", "", "J", "heat")') + "\n\ndef bypass_groove_scale",
            "State.warmth",
        ),
        ('role="scale")  # fmt: skip', 'role="scale")  # fmt: skip\n    depth: float = 0.0', "Parameters.depth"),
    ],
)
def test_a_field_that_the_table_cannot_hold_is_named_with_its_file(copy: Path, old: str, new: str, name: str) -> None:
    ((path, text),) = BLOCK.findall(PAGE)
    other = copy / "twintube" / path
    assert old in text
    other.write_text(text.replace(old, new, 1), encoding="utf-8")
    try:
        done = run(copy, "-c", "import twintube.core.effects")
    finally:
        other.write_text(text, encoding="utf-8")
    assert done.returncode != 0
    assert f"effects/bypass_groove.py: {name}: must be var(..., default=...)" in done.stderr.splitlines()[-1]


def test_every_name_and_role_of_an_effect_is_on_the_page() -> None:
    from twintube.core.hooks import NEEDED, ROLES

    section = PAGE[PAGE.index("## Add an effect") :]
    for name in NEEDED:
        assert name in section
    for role in ROLES:
        assert f"`{role}`" in section
