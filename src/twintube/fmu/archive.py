"""The FMU as a zip file whose bytes follow from its content, and the date that stands in it."""

import os
import stat
import zipfile
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from xml.etree import ElementTree as ET

MODE = stat.S_IFREG | 0o644
UNIX = 3  # the system that the mode belongs to
XML = "modelDescription.xml"
EPOCH = (1980, 1, 1, 0, 0, 0)  # the first time that a zip file can hold


class DateError(ValueError):
    """SOURCE_DATE_EPOCH is not a time."""


def build_date() -> str:
    """The date of the build as FMI writes it: now, or SOURCE_DATE_EPOCH [s since 1970]; raises DateError."""
    text = os.environ.get("SOURCE_DATE_EPOCH")
    if not text:
        return f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ}"
    try:
        return f"{datetime.fromtimestamp(int(text), UTC):%Y-%m-%dT%H:%M:%SZ}"
    except (ValueError, OverflowError, OSError):
        raise DateError(f"SOURCE_DATE_EPOCH = {text}: must be a whole number of seconds since 1970") from None


def start_values(path: Path, description: str = XML) -> dict[str, float | None]:
    """Start values of all variables of an FMU by name, None where one has none; empty where the file is no FMU."""
    try:
        with zipfile.ZipFile(path) as archive:
            root = ET.fromstring(archive.read(description))
        return dict(pair for element in root.iterfind("ModelVariables/*") for pair in starts_of(element))
    except (OSError, KeyError, IndexError, ValueError, zipfile.BadZipFile, ET.ParseError):
        return {}


def starts_of(element: ET.Element) -> Iterator[tuple[str, float | None]]:
    """Name and start value of a variable of FMI 2.0 or 3.0, of an array those of its elements."""
    name = element.get("name", "")
    start = (element[0] if element.tag == "ScalarVariable" else element).get("start")
    if element.find("Dimension") is not None and start is not None:
        yield from ((f"{name}[{i}]", float(value)) for i, value in enumerate(start.split(), start=1))
    elif element.get("causality") != "independent":
        yield name, None if start is None else float(start)


def write(path: Path, content: Mapping[str, bytes]) -> None:
    """Write the files in their order, with a fixed time and readable by all."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in content.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = UNIX
            entry.external_attr = MODE << 16
            archive.writestr(entry, data)
