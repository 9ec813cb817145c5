"""Build the damper as an FMI 2.0 co-simulation FMU: parameter set -> FMU -> validated -> written."""

from __future__ import annotations

import hashlib
import json
import shutil
import tempfile
import uuid
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from twintube.core.checks import problems
from twintube.dampers import Damper, load
from twintube.errors import UserError
from twintube.files import replacing
from twintube.fmu import archive, binaries, description, documentation, licences, python_kind, related, sources, terminals
from twintube.fmu.description import model_name
from twintube.fmu.equations import StaleTranslationError
from twintube.fmu.model import Model
from twintube.fmu.platforms import PLATFORMS, Kind, PlatformError, known

Progress = Callable[[str], None]
XML = archive.XML
REFUSALS = (binaries.CompilerError, StaleTranslationError, PlatformError, licences.LicenceError, archive.DateError)


class BuildError(UserError, RuntimeError):
    """The FMU could not be built; the message says why."""


def identity(content: dict[str, bytes]) -> str:
    """A GUID that follows from the content."""
    listed = json.dumps(sorted((name, hashlib.sha256(data).hexdigest()) for name, data in content.items()))
    return "{" + str(uuid.uuid5(uuid.NAMESPACE_URL, listed)) + "}"


def native_content(model: Model, platforms: Sequence[str], date: str, progress: Progress) -> dict[str, bytes]:
    """Model description, sources and libraries by their path inside the FMU."""
    texts = sources.model_sources(model, "")
    guid = identity({name: text.encode() for name, text in texts.items()})
    texts |= {"model.h": sources.identity(model, guid)}
    libraries = binaries.binaries(texts, model.name, platforms, progress)
    xml = description.described_model(
        model, guid, date, sources.capabilities(model), [sources.COMPILED], sources.LOG_CATEGORIES
    )
    return {XML: xml} | {f"sources/{name}": text.encode() for name, text in texts.items()} | libraries


def contents(damper: Damper, kind: Kind, platforms: Sequence[str], date: str, progress: Progress) -> dict[str, bytes]:
    """All files of the FMU by their path, the model description first, the others by name."""
    if kind == "native":
        content = native_content(description.damper_model(damper), platforms, date, progress)
    else:
        progress("Python sources")
        content = python_kind.content(damper)
        content["documentation/externalDependencies.txt"] = documentation.NEEDS_PYTHON.encode()
        content[XML] = description.described(
            damper, identity(content), date, python_kind.CAPABILITIES, [], sources.LOG_CATEGORIES
        )
    progress("reference run, documentation, licences")
    icon = (sources.FOLDER / "model.png").read_bytes()
    content |= {
        "model.png": icon,
        terminals.FILE: terminals.terminals(),
        terminals.ICON: icon,
        "documentation/index.html": documentation.page(damper, kind).encode(),
    }
    content |= licences.files(kind, platforms) | related.files(damper)
    return in_order(content)


def in_order(content: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files by name, the model description first."""
    return {XML: content[XML], **dict(sorted(content.items()))}


def validated(fmu: Path) -> None:
    """Raise BuildError with whatever fmpy's validation says."""
    from fmpy.validation import validate_fmu

    remarks = validate_fmu(str(fmu))
    if remarks:
        raise BuildError("the FMU is not valid: " + "; ".join(remarks))


def target_file(output: Path | str | None, name: str) -> Path:
    """The file to write: `output`, or a file in this folder; raises OSError where nothing can be written there."""
    target = Path(output) if output is not None else Path.cwd()
    if target.suffix.lower() != ".fmu":
        target = target / f"{name}.fmu"
    if target.is_dir():
        raise IsADirectoryError(f"{target}: is a folder, must be a file")
    parent = next(folder for folder in target.absolute().parents if folder.exists())
    try:
        with tempfile.TemporaryFile(dir=parent):
            pass
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(target)) from None
    return target


def build_fmu(
    damper: Damper | str | Path,
    output: Path | str | None = None,
    kind: Kind = "native",
    platforms: Sequence[str] = tuple(PLATFORMS),
    progress: Callable[[str], None] | None = None,
) -> Path:
    """Build and validate the FMU of a damper; `output` is a file or a folder, by default the current one.

    `damper` may be the name or the file of a parameter set. `kind` is "native" or "python". `platforms` are those that a
    native FMU gets libraries for. `progress` is called with a few words before each step. The environment variable
    SOURCE_DATE_EPOCH fixes the date; all other bytes follow from damper, kind and platforms. Nothing is left behind if it
    fails. Raises BuildError, ParameterError, and OSError where the output cannot be written.
    """
    damper, progress = load(damper), progress or (lambda text: None)
    target = target_file(output, model_name(damper))
    inadmissible = problems(damper.parameters)
    if inadmissible:
        raise BuildError(f"{damper.name}: " + "; ".join(inadmissible))
    try:
        content = contents(damper, kind, known(platforms), archive.build_date(), progress)
    except REFUSALS as error:
        raise BuildError(str(error)) from error
    written(target, content, progress)
    return target


def written(target: Path, content: Mapping[str, bytes], progress: Progress) -> None:
    """Validate the FMU and write it; raises BuildError."""
    with tempfile.TemporaryDirectory() as folder:
        fresh = Path(folder) / target.name
        archive.write(fresh, content)
        progress("validation by fmpy")
        validated(fresh)
        with replacing(target) as part:
            shutil.copyfile(fresh, part)
