"""Binary records, read by a child process: whatever a damaged file does to its library, this process goes on."""

import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from twintube import readers
from twintube.common.extras import extra_of
from twintube.data.findings import UnreadableError
from twintube.data.formats import EMPTY, Format, Raw
from twintube.data.read.sheets import Cells, read_sheet
from twintube.readers import is_hdf5, kind_of

PROGRAM = ("-P", "-m", "twintube.readers")
PACKAGE = Path(readers.__file__).parents[2]  # where the child finds it
SECONDS, BYTES_PER_SECOND = 30.0, 5e6  # of processor time that a child may take: to start, and for its files
BUSY = 20.0  # times that long by the clock: other work on the machine makes no file damaged
MOST_DEATHS = 5  # children that may end on a file before the others are not tried any more
# The child's libraries would start threads for each core, which take address space.
ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "ARROW_NUM_THREADS": "1", "PYTHONFAULTHANDLER": ""}


def is_binary(path: Path) -> bool:
    """Whether a process of its own reads the file."""
    kind = kind_of(path)
    return kind is not None and kind.reader != "text"


def check_package(path: Path) -> None:
    """Raise UnreadableError if the package is missing that reads the file."""
    kind = kind_of(path)
    package = "h5py" if kind is not None and kind.reader == "matlab" and is_hdf5(path) else kind.package if kind else ""
    if package and find_spec(package) is None:
        what = f"'twintube[{extra_of(package)}]'"
        raise UnreadableError(f"{path.suffix} files need the package {package.replace('_', '-')}: pip install {what}")


def read_binary(files: Sequence[tuple[Path, Format]]) -> Iterator[Raw | UnreadableError]:
    """The columns of each file, or why there are none, in their order; the files must exist and have their package."""
    waiting = list(range(len(files)))
    deaths = 0
    with tempfile.TemporaryDirectory(prefix="twintube_") as name:
        folder = Path(name)
        while waiting:
            if deaths == MOST_DEATHS:
                yield from (UnreadableError(f"not read, because {deaths} files before it are damaged") for _ in waiting)
                return
            ended = child(folder, [(i, *files[i]) for i in waiting])
            while waiting and (folder / f"{waiting[0]}.json").is_file():
                i = waiting.pop(0)
                yield answer(folder, i, files[i][1])
            if waiting:
                yield UnreadableError(ended)
                waiting.pop(0)
                deaths += 1


def first_rows(path: Path, count: int) -> dict[str, list[Cells]]:
    """The first rows of each sheet of a workbook, by its name; raises UnreadableError."""
    with tempfile.TemporaryDirectory(prefix="twintube_") as name:
        folder = Path(name)
        ended = child(folder, [(0, path, Format())], first_rows=count)
        file = folder / "0.json"
        said: dict[str, Any] = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {"error": ended}
    if "error" in said:
        raise UnreadableError(said["error"])
    rows: dict[str, list[Cells]] = said["rows"]
    return rows


def child(folder: Path, files: list[tuple[int, Path, Format]], first_rows: int | None = None) -> str:
    """Let a child read the files into `folder`; what to say of the first one without an answer."""
    requests = [(i, str(path.absolute()), request(form) | {"first_rows": first_rows}) for i, path, form in files]
    (folder / "requests.json").write_text(json.dumps(requests), encoding="utf-8")
    seconds = SECONDS + sum(path.stat().st_size for _, path, _ in files) / BYTES_PER_SECOND
    with subprocess.Popen(
        [sys.executable, *PROGRAM, str(folder), f"{seconds:.0f}"],
        stdin=subprocess.PIPE,  # stays open: the child ends when it closes
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=os.environ
        | ENVIRONMENT
        | {"PYTHONPATH": os.pathsep.join(filter(None, (str(PACKAGE), os.environ.get("PYTHONPATH"))))},
    ) as process:
        try:
            code = process.wait(timeout=BUSY * seconds)
        except subprocess.TimeoutExpired:
            return f"reading took more than {BUSY * seconds:.0f} s: the file is damaged, or the machine is too busy"
        finally:
            process.kill()
    if code >= 0:
        return f"the file is damaged: its reader ended with status {code}"
    known = code in [-number for number in signal.Signals]
    by = signal.Signals(-code).name if known else f"signal {-code}"
    if by == "SIGXCPU":
        return f"the file is damaged: reading took more than {seconds:.0f} s of processor time"
    return f"the file is damaged: its reader ended by {by}"


def request(form: Format) -> dict[str, Any]:
    """What dataset.toml says about the file; `wanted` are the names that it asks for, None where it does not say."""
    names = [channel.column for channel in form.channels.values() if channel.column is not None]
    wanted = [*form.columns.values(), *names] if isinstance(form.columns, dict) else None
    return {"wanted": wanted, "sheet": form.sheet, "group": form.group, "first_rows": None}


def answer(folder: Path, number: int, form: Format) -> Raw | UnreadableError:
    """What the child read from a file, which has as many samples as the longest of the wanted columns."""
    said = json.loads((folder / f"{number}.json").read_text(encoding="utf-8"))
    if "error" in said:
        return UnreadableError(said["error"])
    if "sheet" in said:
        try:
            return read_sheet(said["rows"][said["sheet"]], said["sheet"], said["sheets"], form)
        except UnreadableError as error:
            return error
    file = folder / f"{number}.npz"
    columns: dict[str, Any] = {}
    with np.load(file, allow_pickle=False) as arrays:
        for i, name in enumerate(said["names"]):
            values = arrays[f"c{i}"]
            empty = arrays.get(f"e{i}")
            if values.dtype.kind == "U":
                columns[name] = values.tolist()
                continue
            # A list shows which cells hold nothing; a NaN of an array is a value of the file.
            columns[name] = [None if e else v for v, e in zip(values, empty, strict=True)] if np.any(empty) else values
    file.unlink()
    wanted = request(form)["wanted"]
    longest = max((len(values) for name, values in columns.items() if wanted is None or name in wanted), default=0)
    return Raw(columns, range(longest), "sample", said["units"], said["refused"], nothing=said["nothing"] or EMPTY)
