"""Records of any format as columns: text in this process, binary files in a child."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TypeVar

from twintube.common.reading import ReadError, check_regular
from twintube.data.findings import UnreadableError
from twintube.data.formats import Format, Raw
from twintube.data.read.binary import check_package, is_binary, read_binary
from twintube.data.read.text import TextReader
from twintube.readers import KINDS, kind_of

T = TypeVar("T")
Outcome = Raw | UnreadableError | OSError


def read_raw(path: Path, form: Format) -> Raw:
    """The columns of a file; raises UnreadableError and OSError."""
    (outcome,) = read_all([(path, form)])
    if isinstance(outcome, Exception):
        raise outcome
    return outcome


def read_all(files: Sequence[tuple[Path, Format]]) -> Iterator[Outcome]:
    """The columns of each file or why there are none, in their order; one child reads all binary ones."""
    refused = [outcome(partial(refuse, path, form)) for path, form in files]
    binary = read_binary([file for file, no in zip(files, refused, strict=True) if no is None and is_binary(file[0])])
    reader = TextReader()
    for (path, form), no in zip(files, refused, strict=True):
        if no is not None:
            yield no
        else:
            yield next(binary) if is_binary(path) else outcome(partial(reader.read, path, form))


def outcome(read: Callable[[], T]) -> T | UnreadableError | OSError:
    """What is read, or the error that says why it is not."""
    try:
        return read()
    except MemoryError:
        return UnreadableError("the file needs more memory than there is")
    except ReadError as error:
        return UnreadableError(f"cannot be read: {error}")
    except (UnreadableError, OSError) as error:
        return error


def refuse(path: Path, form: Format) -> None:
    """Raise UnreadableError, ReadError or OSError where a file is not even opened."""
    kind, ending = kind_of(path), path.suffix.lower()
    if kind is None:
        raise UnreadableError(f"unknown format {ending!r}, must be one of {', '.join(KINDS)}")
    if form.block is not None and not kind.cells:
        raise UnreadableError(f"block = {form.block}: is for several tables in a text file, not for {ending}")
    if isinstance(form.columns, list) and not kind.cells:
        raise UnreadableError(
            "columns: a list is for text and workbooks without header, here it must be a table: header = its name"
        )
    check_regular(path, kind.most)
    with path.open("rb"):
        pass  # a file without permission says so itself
    check_package(path)
