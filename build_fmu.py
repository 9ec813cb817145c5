"""Build the damper as an FMI 2.0 co-simulation FMU: parameter set -> FMU -> validated.

python build_fmu.py SA8
python build_fmu.py SA8 --oil-level 0.6 --gas-lost --output rear_60.fmu
python build_fmu.py --parameters my_damper.toml
python build_fmu.py SA8 --as-published
python build_fmu.py SA8 --kind python
"""

import hashlib
import json
import shutil
import tempfile
import uuid
import zipfile
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from fmu_src import description, documentation, python_kind, reference
from fmu_src.description import model_name
from fmu_src.native import binaries, sources
from twintube.closures import acting, closed
from twintube.parameters import Damper, ParameterError, load

ROOT = Path(__file__).parent
Kind = Literal["native", "python"]


class BuildError(RuntimeError):
    """The FMU could not be built; the message says why."""


def identity(content: dict[str, bytes]) -> str:
    """A GUID that follows from the content."""
    listed = json.dumps(sorted((name, hashlib.sha256(data).hexdigest()) for name, data in content.items()))
    return "{" + str(uuid.uuid5(uuid.NAMESPACE_URL, listed)) + "}"


def native_content(damper: Damper, platforms: Sequence[str]) -> tuple[str, dict[str, bytes]]:
    """GUID, and sources and libraries by their path inside the FMU."""
    guid = identity({name: text.encode() for name, text in sources.sources(damper, "").items()})
    texts = sources.sources(damper, guid)
    libraries = binaries.binaries(texts, model_name(damper), platforms)
    return guid, {f"sources/{name}": text.encode() for name, text in texts.items()} | libraries


def contents(damper: Damper, kind: Kind, platforms: Sequence[str]) -> dict[str, bytes]:
    """All files of the FMU by their path."""
    date = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    if kind == "native":
        guid, content = native_content(damper, platforms)
        xml = description.described(damper, guid, date, sources.CAPABILITIES, [sources.COMPILED], sources.LOG_CATEGORIES)
    else:
        content = python_kind.content(damper)
        xml = description.described(damper, identity(content), date, python_kind.CAPABILITIES, [], [])
    return {
        "modelDescription.xml": xml,
        **content,
        "model.png": (ROOT / "fmu_src" / "model.png").read_bytes(),
        "documentation/index.html": documentation.page(damper, kind).encode(),
        "documentation/licenses/license.txt": (ROOT / "LICENSE").read_bytes(),
        **{f"extra/twintube/{name}": text.encode() for name, text in reference.files(damper).items()},
    }


def validated(fmu: Path) -> None:
    """Raise BuildError with whatever fmpy's validation says."""
    from fmpy.validation import validate_fmu

    found = validate_fmu(str(fmu))
    if found:
        raise BuildError("the FMU is not valid: " + "; ".join(found))


def build(
    damper: Damper,
    output: Path | str | None = None,
    kind: Kind = "native",
    platforms: Sequence[str] = tuple(binaries.PLATFORMS),
) -> Path:
    """Build and validate the FMU of a damper; `output` is a file or a folder, by default the current one.

    `platforms` are those that a native FMU gets libraries for. Nothing is left behind if it fails. Raises BuildError, and
    OSError where the output cannot be written.
    """
    target = Path(output) if output is not None else Path.cwd()
    if target.suffix != ".fmu":
        target = target / f"{model_name(damper)}.fmu"
    target.parent.mkdir(parents=True, exist_ok=True)
    try:
        content = contents(damper, kind, platforms)
    except binaries.CompilerError as error:
        raise BuildError(str(error)) from error
    with tempfile.TemporaryDirectory() as folder:
        fresh = Path(folder) / target.name
        with zipfile.ZipFile(fresh, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, data in content.items():
                archive.writestr(name, data)
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
    kind: Annotated[
        Kind, typer.Option(help="Compiled for all platforms, or Python source run by the host's Python.")
    ] = "native",
    platform: Annotated[
        list[str] | None, typer.Option(help=f"Only for this platform; may be repeated: {', '.join(binaries.PLATFORMS)}.")
    ] = None,
    as_published: Annotated[
        bool,
        typer.Option("--as-published", help="The paper's equations alone: gas that cavitation frees never dissolves again."),
    ] = False,
    output: Annotated[Path | None, typer.Option(help="File (.fmu) or folder; default: the current folder.")] = None,
) -> None:
    """Build the FMU of a damper and validate it with fmpy.

    As a vehicle rides for minutes, gas that cavitation frees goes back into the oil, unless --as-published asks for the
    paper's equations alone or the parameter set says itself what becomes of it.

    The first build for Windows compiles the runtime too and takes a minute or two; later ones take seconds.
    """
    try:
        chosen = load(parameters if parameters is not None else damper)
        changes: dict[str, Any] = {}
        if oil_level is not None:
            changes["oil_level"] = oil_level
        if gas_lost:
            changes["gas_preload"] = 0
        chosen = chosen.with_(**changes)
        if not as_published:
            chosen = closed(chosen)
        built = build(chosen, output, kind, platform or tuple(binaries.PLATFORMS))
    except (ParameterError, BuildError, OSError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None
    typer.echo(
        f"{built}: {chosen.name}, {chosen.title}; valid {kind} FMI 2.0 co-simulation FMU, "
        f"{built.stat().st_size // 1024} kB\n"
        f"cavitation: {acting(chosen)}"
    )


if __name__ == "__main__":
    app()
