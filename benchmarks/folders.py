"""Where a long benchmark keeps its work."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory


@contextmanager
def folder_of(keep: Path | None) -> Iterator[Path]:
    """The folder of a run, which is removed at the end where it is not to be kept."""
    if keep is not None:
        yield keep
        return
    with TemporaryDirectory() as folder:
        yield Path(folder)
