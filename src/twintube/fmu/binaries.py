"""The libraries of an FMU: those that were compiled once, with GUID and start values put in."""

import struct
from collections.abc import Mapping, Sequence

from twintube.fmu import signature
from twintube.fmu.standards import Standard
from twintube.native.units import KEY, MARK, LibraryError, Unit, library

GUID = 64  # bytes
PAGE = 14  # bits of the alignment of a part of a universal file
MACHINES = {"x86_64-darwin": (0x01000007, 3), "aarch64-darwin": (0x0100000C, 0)}


def complete(unit: Unit, standard: Standard) -> tuple[str, ...]:
    """The platforms that all libraries are there for; raises LibraryError where there is none."""
    found = tuple(
        folder for folder, (_, parts) in standard.platforms.items() if all(unit.path(part).is_file() for part in parts)
    )
    if not found:
        raise LibraryError("no library is there: `python -m twintube.native` makes that of this machine")
    return found


def filled(data: bytes, guid: str, starts: Sequence[float]) -> bytes:
    """A library with its values in place: behind mark and key, as `struct values` of `unit.h` has them."""
    at = data.index(MARK) + len(MARK) + KEY
    values = struct.pack(f"<{GUID}s{len(starts)}d", guid.encode(), *starts)
    return data[:at] + values + data[at + len(values) :]


def universal(parts: Mapping[str, bytes]) -> bytes:
    """One file for several processors: a header with the place of each, as Apple's lipo writes it."""
    head, body, at = b"", b"", 1 << PAGE
    for platform, data in parts.items():
        head += struct.pack(">IIIII", *MACHINES[platform], at, len(data), PAGE)
        padded = data + b"\0" * (-len(data) % (1 << PAGE))
        body += padded
        at += len(padded)
    head = struct.pack(">II", 0xCAFEBABE, len(parts)) + head
    return head + b"\0" * ((1 << PAGE) - len(head)) + body


def binary(unit: Unit, platform: str, guid: str, starts: Sequence[float]) -> bytes:
    """The library for a platform, ready to be loaded; raises LibraryError."""
    data = filled(library(unit, platform), guid, starts)
    return signature.signed(data) if platform in MACHINES else data


def binaries(
    unit: Unit, name: str, guid: str, starts: Sequence[float], platforms: Mapping[str, tuple[str, Sequence[str]]]
) -> dict[str, bytes]:
    """The libraries by their path inside the FMU; `platforms` have endings and parts. Raises LibraryError."""
    libraries = {}
    for folder, (ending, parts) in platforms.items():
        made = {part: binary(unit, part, guid, starts) for part in parts}
        whole = universal(made) if len(made) > 1 else next(iter(made.values()))
        libraries[f"binaries/{folder}/{name}.{ending}"] = whole
    return libraries
