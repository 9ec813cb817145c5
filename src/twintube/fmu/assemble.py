"""Build the damper as an FMI 2.0 co-simulation FMU: parameter set -> FMU -> validated -> written."""

import hashlib
import json
import shutil
import tempfile
import uuid
import zipfile
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from importlib.metadata import distribution
from pathlib import Path

from twintube.dampers import Damper
from twintube.files import replacing
from twintube.fmu import binaries, description, documentation, python_kind, reference, sources
from twintube.fmu.description import model_name
from twintube.fmu.equations import StaleTranslationError
from twintube.fmu.platforms import PLATFORMS, Kind


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
        "model.png": (sources.FOLDER / "model.png").read_bytes(),
        "documentation/index.html": documentation.page(damper, kind).encode(),
        "documentation/licenses/license.txt": licence(),
        **{f"extra/twintube/{name}": text.encode() for name, text in reference.files(damper).items()},
    }


def licence() -> bytes:
    """The text of this package's licence."""
    text = distribution("twintube").read_text("licenses/LICENSE")
    if text is None:
        raise BuildError("the installed package twintube has no licence file; install it again")
    return text.encode()


def validated(fmu: Path) -> None:
    """Raise BuildError with whatever fmpy's validation says."""
    from fmpy.validation import validate_fmu

    found = validate_fmu(str(fmu))
    if found:
        raise BuildError("the FMU is not valid: " + "; ".join(found))


def build_fmu(
    damper: Damper,
    output: Path | str | None = None,
    kind: Kind = "native",
    platforms: Sequence[str] = tuple(PLATFORMS),
    progress: Callable[[str], None] = lambda text: None,
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
    except (binaries.CompilerError, StaleTranslationError) as error:
        raise BuildError(str(error)) from error
    with tempfile.TemporaryDirectory() as folder:
        fresh = Path(folder) / target.name
        with zipfile.ZipFile(fresh, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, data in content.items():
                archive.writestr(name, data)
        validated(fresh)
        with replacing(target) as part:
            shutil.copyfile(fresh, part)
    return target
