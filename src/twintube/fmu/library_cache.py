"""Compiled libraries kept between builds: in a folder of this user alone, every file next to its digest.

A library goes into FMUs that others execute, so a damaged file is deleted and compiled again.
"""

import hashlib
from pathlib import Path

from twintube.common.caches import cache_folder
from twintube.common.files import write_bytes, write_text

VOUCHED = ".sha256"
KEPT = 400  # libraries of about 50 kB; the oldest are deleted beyond


def folder() -> Path:
    """Where libraries are kept."""
    return cache_folder("libraries")


def digest(path: Path) -> str:
    """SHA-256 of a file; empty where it cannot be read."""
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return ""


def vouched(file: Path) -> bool:
    """Whether the digest next to a file is that of the file."""
    current = digest(file)
    try:
        return current != "" and file.with_name(file.name + VOUCHED).read_text(encoding="ascii") == current
    except (OSError, UnicodeDecodeError):
        return False


def vouch(file: Path) -> None:
    """Put the digest next to a file."""
    write_text(file.with_name(file.name + VOUCHED), digest(file))


def stored(key: str) -> bytes | None:
    """The library of a key; None where it is missing or damaged."""
    path = folder() / key
    if vouched(path):
        return path.read_bytes()
    path.unlink(missing_ok=True)
    return None


def store(key: str, data: bytes) -> None:
    """Keep a library; with a full disk nothing happens."""
    cache = folder()
    try:
        write_bytes(cache / key, data)
        vouch(cache / key)
        libraries = sorted((path for path in cache.iterdir() if not path.suffix), key=lambda path: path.stat().st_mtime)
        for path in libraries[:-KEPT]:
            path.unlink(missing_ok=True)
            path.with_name(path.name + VOUCHED).unlink(missing_ok=True)
    except OSError:
        return
