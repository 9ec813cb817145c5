"""Build the damper as an FMI 2.0 co-simulation FMU: parameter set -> FMU -> validated.

python build_fmu.py SA8
python build_fmu.py SA8 --oil-level 0.6 --gas-lost --output rear_60.fmu
python build_fmu.py --parameters my_damper.toml
"""

import contextlib
import hashlib
import io
import json
import re
import shutil
import sys
import tempfile
import uuid
import zipfile
from dataclasses import asdict
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, Any

import typer

from fmu_src import description, documentation
from twintube.parameters import Damper, ParameterError, load

ROOT = Path(__file__).parent
PACKAGE = ROOT / "src" / "twintube"
CARRIED = ("__init__.py", "variables.py", "checks.py", "frame.py", "model.py", "kernel", "effects")
OPTIONS = {
    "needsExecutionTool": "false",  # nothing but a Python library; PyFMI refuses FMUs that say true
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
}


class BuildError(RuntimeError):
    """The FMU could not be built; the message says why."""


def carried_sources() -> dict[str, str]:
    """The sources that travel inside the FMU, by path."""
    found = {}
    for name in CARRIED:
        path = PACKAGE / name
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            found[file.relative_to(PACKAGE).as_posix()] = file.read_text(encoding="utf-8")
    return found


def model_name(damper: Damper) -> str:
    """The model's name: an identifier of the C language."""
    return "twintube_" + re.sub(r"\W", "_", damper.name)


def stage(folder: Path, damper: Damper) -> Path:
    """Lay the sources out in `folder` and return the slave's script.

    The modules carry a digest of the sources in their names: two FMUs of different versions can share a process.
    """
    sources = carried_sources()
    slave = (ROOT / "fmu_src" / "twintube_slave.py").read_text(encoding="utf-8")
    digest = hashlib.sha256(("".join(sources.values()) + slave).encode()).hexdigest()[:12]
    package = f"twintube_{digest}"

    def renamed(text: str) -> str:
        return re.sub(r"^(from|import) twintube\b", rf"\1 {package}", text, flags=re.MULTILINE)

    for name, text in sources.items():
        path = folder / package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(renamed(text), encoding="utf-8")
    start = {"model_name": model_name(damper), "parameters": asdict(damper.parameters)}
    (folder / "start.json").write_text(json.dumps(start, indent=1), encoding="utf-8")
    script = folder / f"slave_{digest}.py"
    script.write_text(renamed(slave), encoding="utf-8")
    return script


def pythonfmu_build(script: Path, folder: Path) -> Path:
    """Run pythonfmu's builder on the staged sources."""
    from pythonfmu.builder import FmuBuilder

    package = next(script.parent.glob("twintube_*"))
    path, modules = list(sys.path), set(sys.modules)
    try:
        built: Path = FmuBuilder.build_FMU(
            script, dest=folder, project_files=[package, script.parent / "start.json"], **OPTIONS
        )
    finally:
        sys.path[:] = path
        for name in set(sys.modules) - modules:
            if name.startswith((package.name, script.stem)):
                del sys.modules[name]
    return Path(built)


def completed(built: Path, damper: Damper, target: Path) -> None:
    """Copy the FMU to `target` with the full model description, documentation, icon and licence."""
    date = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    with zipfile.ZipFile(built) as old, zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as new:
        content = {name: old.read(name) for name in old.namelist() if "/tests/" not in name}
        identity = json.dumps(sorted((n, hashlib.sha256(c).hexdigest()) for n, c in content.items() if n[-4:] != ".xml"))
        guid = "{" + str(uuid.uuid5(uuid.NAMESPACE_URL, identity)) + "}"
        content["modelDescription.xml"] = description.complete(content["modelDescription.xml"], guid, date)
        content["model.png"] = (ROOT / "fmu_src" / "model.png").read_bytes()
        content["documentation/index.html"] = documentation.page(damper).encode()
        content["documentation/licenses/license.txt"] = (ROOT / "LICENSE").read_bytes()
        for name, data in content.items():
            new.writestr(name, data)


def validated(fmu: Path) -> None:
    """Raise BuildError with whatever fmpy's validation says."""
    from fmpy.validation import validate_fmu

    found = validate_fmu(str(fmu))
    if found:
        raise BuildError("the FMU is not valid: " + "; ".join(found))


def build(damper: Damper, output: Path | str | None = None) -> Path:
    """Build and validate the FMU of a damper; `output` is a file or a folder, by default the current one.

    Nothing is left behind if it fails. Raises BuildError, and OSError where the output cannot be written.
    """
    target = Path(output) if output is not None else Path.cwd()
    if target.suffix != ".fmu":
        target = target / f"{model_name(damper)}.fmu"
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        stage_folder = Path(folder) / "stage"
        stage_folder.mkdir()
        built = pythonfmu_build(stage(stage_folder, damper), Path(folder) / "built")
        fresh = Path(folder) / target.name
        completed(built, damper, fresh)
        validated(fresh)
        part = target.with_suffix(f".{uuid.uuid4().hex}.part")
        try:
            shutil.copyfile(fresh, part)
            part.replace(target)
        finally:
            part.unlink(missing_ok=True)
    return target


app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)


@app.command(epilog="Example: python build_fmu.py SA8 --oil-level 0.6 --gas-lost --output rear_60.fmu")
def main(
    damper: Annotated[str, typer.Argument(help="A named damper, SA1 to SA8.")] = "SA8",
    parameters: Annotated[Path | None, typer.Option(help="A parameter file (TOML) instead of a named damper.")] = None,
    oil_level: Annotated[float | None, typer.Option(help="Start value: oil, share of the intact volume.")] = None,
    gas_lost: Annotated[bool, typer.Option("--gas-lost", help="Start value: the gas preload is lost.")] = False,
    output: Annotated[Path | None, typer.Option(help="File (.fmu) or folder; default: the current folder.")] = None,
) -> None:
    """Build the FMU of a damper and validate it with fmpy."""
    try:
        chosen = load(parameters if parameters is not None else damper)
        changes: dict[str, Any] = {}
        if oil_level is not None:
            changes["oil_level"] = oil_level
        if gas_lost:
            changes["gas_preload"] = 0
        chatter = io.StringIO()
        with contextlib.redirect_stdout(chatter):
            built = build(chosen.with_(**changes), output)
    except (ParameterError, BuildError, OSError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None
    typer.echo(f"{built}: {chosen.name}, {chosen.title}; valid FMI 2.0 co-simulation FMU, {built.stat().st_size // 1024} kB")


if __name__ == "__main__":
    app()
