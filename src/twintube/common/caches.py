"""Folders for what can be made again: in the user's cache, or where there is none in a temporary folder of this user alone.

In a container there may be no home, or none that can be written, and the user may be a number without a name.
"""

import atexit
import logging
import os
import shutil
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import platformdirs

from twintube.errors import UserError

PACKAGE = "twintube"
NOWHERE = "no folder for temporary files: set TMPDIR to one that you can write"


def writable(folder: Path) -> bool:
    """Whether files can be made in a folder; it is made where it is missing."""
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def private(folder: Path) -> bool:
    """Whether a folder can be written and belongs to this user, who alone may change it; made where it is missing."""
    if not writable(folder):
        return False
    if os.name != "posix":
        return True
    try:
        if {folder.lstat().st_uid, folder.stat().st_uid} != {os.getuid()}:
            return False
        if folder.stat().st_mode & 0o022:
            folder.chmod(0o700)
    except OSError:
        return False
    return True


def usual() -> Path | None:
    """The user's cache; None where nothing says where it is or it cannot be used."""
    try:
        folder = Path(platformdirs.user_cache_dir(PACKAGE))
    except RuntimeError:  # no HOME, and no name for the user's number
        return None
    return folder if folder.is_absolute() and private(folder) else None


def temporary() -> Path:
    """A folder of this user among the temporary files, found again by the next process; raises UserError."""
    try:
        above = Path(tempfile.gettempdir())
    except OSError:
        raise UserError(NOWHERE) from None
    named = above / f"twintube-{os.getuid() if os.name == 'posix' else 'cache'}"
    return named if private(named) else of_this_process()


@cache
def of_this_process() -> Path:
    """A new folder that goes with the process: that of the usual name belongs to somebody else."""
    folder = Path(tempfile.mkdtemp(prefix="twintube_"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def roots() -> Iterator[Path]:
    """Where this user's caches may be, the usual place first."""
    folder = usual()
    if folder is not None:
        yield folder
    yield temporary() / PACKAGE
    yield of_this_process() / PACKAGE


def cache_folder(name: str) -> Path:
    """A folder of this user alone for files of one kind, which can be written; raises UserError where there is none."""
    for root in roots():
        if private(root / name):
            return root / name
    raise UserError(NOWHERE)


def lend() -> None:
    """Where the user's cache cannot be used, let other libraries keep theirs beside ours: pictures and their fonts."""
    if usual() is None:
        os.environ["XDG_CACHE_HOME"] = str(temporary())
        os.environ.setdefault("MPLCONFIGDIR", str(cache_folder("matplotlib")))
        # Else the list of fonts, which has to be made anew in each run, is announced on a slow machine.
        logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)
