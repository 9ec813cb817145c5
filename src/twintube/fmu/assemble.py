"""Build the damper as a co-simulation FMU of FMI 2.0 or 3.0: parameter set -> FMU -> validated -> written."""

from __future__ import annotations

import hashlib
import json
import tempfile
import uuid
from collections.abc import Mapping, Sequence
from pathlib import Path

from twintube.common.files import replacing
from twintube.core.checks import problems
from twintube.dampers import Damper, load
from twintube.errors import UserError
from twintube.fmu import (
    archive,
    binaries,
    description,
    description3,
    documentation,
    licences,
    python_kind,
    related,
    sources,
    terminals,
)
from twintube.fmu.description import model_name
from twintube.fmu.model import Model
from twintube.fmu.platforms import Fmi, Kind, PlatformError, known
from twintube.fmu.schema import SchemaError, valid
from twintube.fmu.standards import STANDARDS
from twintube.native.units import SOURCES, LibraryError

XML = archive.XML
REFUSALS = (LibraryError, sources.StaleTableError, PlatformError, SchemaError, archive.DateError)


class BuildError(UserError, RuntimeError):
    """The FMU could not be built; the message says why."""


def identity(content: dict[str, bytes]) -> str:
    """A GUID that follows from the content."""
    listed = json.dumps(sorted((name, hashlib.sha256(data).hexdigest()) for name, data in content.items()))
    return "{" + str(uuid.uuid5(uuid.NAMESPACE_URL, listed)) + "}"


def chosen_platforms(model: Model, platforms: Sequence[str] | None, fmi: Fmi) -> tuple[str, ...]:
    """The named platforms, by default those that there are libraries for; raises PlatformError and LibraryError."""
    if platforms is not None:
        return known(platforms, fmi)
    return binaries.complete(sources.unit_of(model, STANDARDS[fmi]), STANDARDS[fmi])


def native_content(model: Model, platforms: Sequence[str], date: str, fmi: Fmi = 2) -> dict[str, bytes]:
    """Model description, sources and libraries by their path inside the FMU."""
    standard = STANDARDS[fmi]
    texts = sources.model_sources(model, "", standard)
    guid = identity({name: text.encode() for name, text in texts.items()})
    texts |= {"model.h": sources.identity(model, guid, standard)}
    content = {f"sources/{name}": text.encode() for name, text in texts.items()}
    unit, starts = sources.unit_of(model, standard), sources.starts(model, standard)
    chosen = {name: standard.platforms[name] for name in platforms}
    content |= binaries.binaries(unit, model.name, guid, starts, chosen)
    if fmi == 2:
        capabilities = sources.capabilities(model)
        xml = description.described_model(
            model, guid, date, capabilities, sources=[standard.compiled], categories=sources.LOG_CATEGORIES
        )
    else:
        xml = description3.described_model(model, guid, date, sources.LOG_CATEGORIES)
        content[description3.BUILD] = description3.build_description(model)
    return content | {XML: xml}


def contents(damper: Damper, kind: Kind, platforms: Sequence[str] | None, *, date: str, fmi: Fmi) -> dict[str, bytes]:
    """All files of the FMU by their path, the model description first, the others by name."""
    if kind == "native":
        model = description.damper_model(damper)
        chosen = chosen_platforms(model, platforms, fmi)
        content = native_content(model, chosen, date, fmi)
    else:
        chosen = known(platforms, fmi)
        content = python_kind.content(damper)
        content["documentation/externalDependencies.txt"] = documentation.NEEDS_PYTHON.encode()
        content[XML] = description.described(
            damper, identity(content), date, python_kind.CAPABILITIES, sources=[], categories=sources.LOG_CATEGORIES
        )
    icon = (SOURCES / "model.png").read_bytes()
    if fmi == 2:
        content["model.png"] = icon
    content |= {
        terminals.FILE: terminals.terminals(),
        terminals.ICON: icon,
        "documentation/index.html": documentation.page(damper, kind, fmi).encode(),
    }
    content |= licences.files(kind, chosen, STANDARDS[fmi]) | related.files(damper)
    return in_order(content)


def in_order(content: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files by name, the model description first."""
    return {XML: content[XML], **dict(sorted(content.items()))}


def file_name(name: str, fmi: Fmi) -> str:
    """The file name of a model's FMU without its ending: FMUs of two versions of FMI may lie in one folder."""
    return name if fmi == 2 else f"{name}_fmi{fmi}"


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
    platforms: Sequence[str] | None = None,
    *,
    fmi: Fmi = 2,
) -> Path:
    """Build and validate the FMU of a damper; `output` is a file or a folder, by default the current one.

    `damper` may be the name or the file of a parameter set. `kind` is "native" or "python"; only native FMUs are of FMI 3.0.
    `platforms` are those that a native FMU gets libraries for, by default all of the version `fmi`, 2 or 3,
    that the package has libraries for. The environment variable SOURCE_DATE_EPOCH fixes the date; all other bytes
    follow from damper, kind, platforms and version. Nothing is left behind if it fails. Raises BuildError, ParameterError,
    and OSError where the output cannot be written.
    """
    damper = load(damper)
    target = target_file(output, file_name(model_name(damper), fmi))
    if kind == "python" and fmi != 2:
        raise BuildError(f"fmi = {fmi}, kind = python: the Python kind is built for FMI 2 only; build the native kind")
    inadmissible = problems(damper.parameters)
    if inadmissible:
        raise BuildError(f"{damper.name}: " + "; ".join(inadmissible))
    try:
        content = contents(damper, kind, platforms, date=archive.build_date(), fmi=fmi)
        written(target, content, fmi)
    except REFUSALS as error:
        raise BuildError(str(error)) from error
    return target


def written(target: Path, content: Mapping[str, bytes], fmi: Fmi) -> None:
    """Check the model description by the standard's schema and write the FMU; raises SchemaError."""
    valid(content[XML], fmi)
    with replacing(target) as part:
        archive.write(part, content)
