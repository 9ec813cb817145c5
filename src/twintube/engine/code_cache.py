"""Where compiled code is kept between runs: in a folder of this user alone, every file with its digest beside it.

Machine code that is read from disk is executed, so a file that is damaged, or that nobody vouches for, is deleted and
compiled anew.
"""

import atexit
import hashlib
import os
import shutil
import tempfile
from dataclasses import dataclass
from functools import wraps
from pathlib import Path
from types import ModuleType
from typing import Any

import platformdirs

from twintube.files import write_text

VOUCHED = ".sha256"


def private(folder: Path) -> bool:
    """Whether a folder can be written and belongs to this user, who alone may change it; made where it is missing."""
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        if os.name == "posix":
            about = folder.stat(follow_symlinks=False)
            if about.st_uid != os.getuid():
                return False
            if about.st_mode & 0o022:
                folder.chmod(0o700)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def cache_folder() -> Path:
    """The user's cache, or where it cannot be written a temporary folder of this process, removed at its end."""
    folder = Path(platformdirs.user_cache_dir("twintube")) / "kernel"
    if private(folder):
        return folder
    temporary = Path(tempfile.mkdtemp(prefix="twintube_"))
    atexit.register(shutil.rmtree, temporary, ignore_errors=True)
    return temporary


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
        path = cache_folder() / f"{name}.py"
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
