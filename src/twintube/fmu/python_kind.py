"""The FMU that carries the equations as Python source: built by pythonfmu, runs in the Python of the host computer."""

import contextlib
import hashlib
import io
import json
import re
import sys
import tempfile
import zipfile
from dataclasses import asdict
from pathlib import Path

from twintube import core
from twintube.dampers import Damper
from twintube.fmu.description import model_name
from twintube.native.units import SOURCES

CAPABILITIES = {"canInterpolateInputs": "false", "canNotUseMemoryManagementFunctions": "true"}
CARRIED = "twintube.core"


def carried_sources() -> dict[str, str]:
    """The sources that travel inside the FMU, by path: the folder of the model, whole."""
    folder = Path(core.__file__).parent
    return {path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.py"))}


def stage(folder: Path, damper: Damper) -> Path:
    """Lay the sources out in `folder` and return the slave's script.

    The modules carry a digest of the sources in their names: two FMUs of different versions can share a process.
    """
    carried = carried_sources()
    slave = (SOURCES / "twintube_slave.py").read_text(encoding="utf-8")
    digest = hashlib.sha256(("".join(carried.values()) + slave).encode()).hexdigest()[:12]
    package = f"twintube_{digest}"

    def renamed(text: str) -> str:
        return re.sub(rf"^(from|import) {re.escape(CARRIED)}\b", rf"\1 {package}", text, flags=re.MULTILINE)

    for name, text in carried.items():
        path = folder / package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(renamed(text), encoding="utf-8")
    start = {"model_name": model_name(damper), "sources": digest, "parameters": asdict(damper.parameters)}
    # A state is restored only in the FMU that it comes from; the GUID is not known inside.
    start["identity"] = hashlib.sha256(json.dumps(start).encode()).hexdigest()[:32]
    (folder / "start.json").write_text(json.dumps(start, indent=1), encoding="utf-8")
    script = folder / f"slave_{digest}.py"
    script.write_text(renamed(slave), encoding="utf-8")
    return script


def built(script: Path, folder: Path) -> Path:
    """Run pythonfmu's builder on the staged sources."""
    from pythonfmu.builder import FmuBuilder

    package = next(script.parent.glob("twintube_*"))
    path, modules = list(sys.path), set(sys.modules)
    # The model description is replaced later; the options only keep the builder from asking for a tool.
    options = {"needsExecutionTool": "false", "canGetAndSetFMUstate": "true", "canSerializeFMUstate": "true"}
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            fmu: Path = FmuBuilder.build_FMU(
                script, dest=folder, project_files=[package, script.parent / "start.json"], **options
            )
    finally:
        sys.path[:] = path
        for name in set(sys.modules) - modules:
            if name.startswith((package.name, script.stem)):
                del sys.modules[name]
    return Path(fmu)


def content(damper: Damper) -> dict[str, bytes]:
    """Libraries and resources by their path inside the FMU."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "stage"
        folder.mkdir()
        with zipfile.ZipFile(built(stage(folder, damper), Path(name) / "built")) as archive:
            wanted = [n for n in archive.namelist() if n.startswith(("binaries/", "resources/")) and "/tests/" not in n]
            return {n: archive.read(n) for n in wanted if not n.endswith("/")}
