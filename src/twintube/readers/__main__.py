"""Reads binary files in a process of its own, whose arguments are a folder and the seconds that it may take.

`requests.json` there lists number, path and request of each file: the wanted columns, and for workbooks the sheet. File i
becomes `i.npz` with the columns `c0`, `c1`, ... and `i.json` with their names, or with the rows of a sheet, or with the
message why it cannot be read. Imports nothing of `data`, which would take a second.
"""

import json
import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from twintube.readers import KINDS
from twintube.readers.columns import Columns, Request, UnreadableError
from twintube.readers.matlab import matlab
from twintube.readers.mdf import mdf
from twintube.readers.tables import json_table, parquet, workbook

MEMORY = 4 << 30  # [bytes] address space where the system can limit it
READERS: dict[str, Callable[[str, Request], Columns | dict[str, Any]]] = {
    "json": json_table, "matlab": matlab, "mdf": mdf, "parquet": parquet, "workbook": workbook,
}  # fmt: skip


def read(path: str, request: Request, target: Path) -> dict[str, Any]:
    """Read one file into `target`; what its JSON file says."""
    ending = Path(path).suffix.lower()
    try:
        columns = READERS[KINDS[ending].reader](path, request)
        if isinstance(columns, dict):
            return columns
        arrays: dict[str, Any] = {f"c{i}": np.asarray(values) for i, values in enumerate(columns.values.values())}
        arrays |= {f"e{i}": columns.empty[name] for i, name in enumerate(columns.values) if name in columns.empty}
        np.savez(target, **arrays)
    except UnreadableError as error:
        return {"error": str(error)}
    except MemoryError:
        return {"error": f"reading takes more than {MEMORY >> 30} GiB: the file is damaged or too large"}
    except Exception as error:  # the libraries raise nearly everything on a damaged file
        return {"error": f"not a readable {ending} file ({type(error).__name__}: {str(error)[:500]})"}
    return {
        "names": list(columns.values), "units": columns.units, "refused": columns.refused,
        "nothing": columns.nothing,
    }  # fmt: skip


def limit(seconds: int) -> None:
    """Limit the address space and the processor time, where the system can."""
    try:
        import resource
    except ImportError:  # Windows
        return
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    most = MEMORY if hard == resource.RLIM_INFINITY else min(MEMORY, hard)
    resource.setrlimit(resource.RLIMIT_AS, (most, hard))
    _, hard = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds if hard == resource.RLIM_INFINITY else min(seconds, hard), hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))


def end_with_parent() -> None:
    """End this process when the other end of standard input closes."""
    sys.stdin.read()  # nothing is ever written to it
    os._exit(1)


def main() -> None:
    """Answer the requests in their order."""
    limit(int(sys.argv[2]))
    threading.Thread(target=end_with_parent, daemon=True).start()
    folder = Path(sys.argv[1])
    for number, path, request in json.loads((folder / "requests.json").read_text(encoding="utf-8")):
        answer = read(path, request, folder / f"{number}.npz")
        part = folder / f"{number}.part"
        part.write_text(json.dumps(answer), encoding="utf-8")
        part.replace(folder / f"{number}.json")
    os._exit(0)  # the libraries' threads and caches need no tidying


if __name__ == "__main__":
    main()
