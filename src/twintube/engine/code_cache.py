"""Compiled code kept between runs: in a folder of this user alone, every file with its digest beside it.

Machine code that is read from disk is executed, so a file that is damaged, or that nobody vouches for, is deleted and
compiled anew.
"""

import hashlib
from dataclasses import dataclass
from functools import wraps
from pathlib import Path
from types import ModuleType
from typing import Any

from twintube.common.caches import cache_folder
from twintube.common.files import write_text

VOUCHED = ".sha256"


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


@dataclass(frozen=True)
class CodeCache:
    """The source of a generated module, and numba's files of it."""

    path: Path

    @classmethod
    def open(cls, name: str, text: str) -> "CodeCache":
        """The module's file with exactly `text`, and no compiled file that does not have its digest next to it."""
        path = cache_folder("kernel") / f"{name}.py"
        if digest(path) != hashlib.sha256(text.encode()).hexdigest():
            write_text(path, text)
        cache = cls(path)
        for file in cache.compiled():
            if not vouched(file):
                file.unlink(missing_ok=True)
        return cache

    def compiled(self) -> list[Path]:
        """Numba's files of the module: indices and machine code."""
        folder = self.path.parent / "__pycache__"
        return [file for ending in ("nbi", "nbc") for file in folder.glob(f"{self.path.stem}.*.{ending}")]

    def seal(self) -> None:
        """Put the digests next to all compiled files; what a process killed before that leaves is compiled anew."""
        for file in self.compiled():
            if not vouched(file):
                vouch(file)

    def seal_after_compiling(self, module: ModuleType) -> None:
        """Let the functions of the module seal the cache whenever a call has compiled something."""
        for name, function in list(vars(module).items()):
            if name.startswith("run_"):
                setattr(module, name, self.sealing(function))

    def sealing(self, function: Any) -> Any:
        """A compiled function that seals the cache after a call with new types."""

        @wraps(function.py_func)
        def call(*arguments: Any) -> Any:
            known = len(function.signatures)
            result = function(*arguments)
            if len(function.signatures) > known:
                self.seal()
            return result

        return call
