"""Hostile inputs by kind: what is written to a folder, the command that reads it, and a part of the answer."""

import os
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from tests.data.conftest import RECORD, as_csv, good
from twintube.dampers import load, to_toml

DAMPER = to_toml(load("SA8"))
CAR = (Path(__file__).parents[2] / "src" / "twintube" / "vehicle" / "cars" / "passat_b8.toml").read_text(encoding="utf-8")
STUDY = 'dampers = ["SA8"]\noil_level = [0.6]\nvelocity = 0.5\n'
HEAD = 'title = "Test"\ndamper = "SA8"\n'
ROWS = "".join(f"{i * 0.002:g},{i % 50},{i % 50}\n" for i in range(100))
CSV = "time [s],stroke [mm],force [N]\n" + ROWS
ESC = "\x1b[31m"
Content = str | bytes | Callable[[Path], None]


@dataclass(frozen=True)
class Hostile:
    """One input: `arguments` of the command line with {} for the folder, files by name, a part of the message."""

    arguments: tuple[str, ...]
    message: str
    files: dict[str, Content] = field(default_factory=dict)

    def write(self, folder: Path) -> list[str]:
        """Write the files; the command's arguments."""
        for name, content in self.files.items():
            path = folder / name
            if callable(content):
                content(path)
            else:
                path.write_bytes(content.encode() if isinstance(content, str) else content)
        return [argument.format(folder) for argument in self.arguments]


def fifo(path: Path) -> None:
    os.mkfifo(path)


def record(content: Content, message: str, name: str = "a.csv") -> Hostile:
    """A record of `twintube simulate`."""
    return Hostile(("simulate", "SA8", "--record", f"{{}}/{name}", "--output", "{}/out.csv"), message, {name: content})


def dataset(content: Content, message: str, head: str = "", name: str = "a.csv") -> Hostile:
    """A record of a dataset, with `head` at the top of dataset.toml."""
    return Hostile(("check", "{}"), message, {name: content, "dataset.toml": f"{HEAD}{head}\n{RECORD.format(name)}"})


def manifest(toml: Content, message: str) -> Hostile:
    """A dataset.toml of a good record."""
    return Hostile(("check", "{}"), message, {"a.csv": as_csv(good(301)), "dataset.toml": toml})


def damper(old: str, new: str, message: str) -> Hostile:
    """A parameter file with one part replaced."""
    assert old in DAMPER, old
    return Hostile(("dampers", "{}/mine.toml"), message, {"mine.toml": DAMPER.replace(old, new, 1)})


def file_of(kind: str, content: Content, message: str) -> Hostile:
    """A whole file of a damper, a car or a study."""
    arguments = {"damper": ("dampers", "{}/x.toml"), "car": ("ride", "SA8", "--car", "{}/x.toml"),
                 "study": ("study", "{}/x.toml", "--output", "{}/out.parquet")}[kind]  # fmt: skip
    return Hostile(arguments, message, {"x.toml": content})


def car(old: str, new: str, message: str) -> Hostile:
    """A car's file with one part replaced."""
    assert old in CAR, old
    return file_of("car", CAR.replace(old, new, 1), message)


def study(text: str, message: str, **files: Content) -> Hostile:
    """A study's file."""
    return Hostile(("study", "{}/x.toml", "--output", "{}/out.parquet"), message,
                   {"x.toml": text} | {name.replace("_", "."): content for name, content in files.items()})  # fmt: skip


def words(message: str, *arguments: str) -> Hostile:
    """Arguments alone."""
    return Hostile(arguments, message)


def header(unit: str, message: str = "is not a unit of stroke") -> Hostile:
    """A unit in a header."""
    return record(CSV.replace("[mm]", f"[{unit}]"), message)


def mat(**values: Any) -> Callable[[Path], None]:
    """A MATLAB v5 file."""

    def write(path: Path) -> None:
        from scipy.io import savemat

        savemat(path, values, do_compression=True)

    return write


def changed(place: int, byte: int) -> Callable[[Path], None]:
    """A MATLAB v5 file with one byte changed; 144 is the class of its first array."""

    def write(path: Path) -> None:
        from scipy.io import savemat

        savemat(path, {"time": np.arange(301) * 0.002, "stroke": np.arange(301.0), "force": np.arange(301.0)})
        data = bytearray(path.read_bytes())
        data[place] = byte
        path.write_bytes(data)

    return write


def hdf5(fill: Callable[[Any], None]) -> Callable[[Path], None]:
    """A MATLAB v7.3 file."""

    def write(path: Path) -> None:
        import h5py

        with h5py.File(path, "w") as file:
            fill(file)

    return write


def parquet(columns: dict[str, Any], cut: int = 0) -> Callable[[Path], None]:
    """A Parquet file, the last `cut` bytes missing."""

    def write(path: Path) -> None:
        import pyarrow as pa
        import pyarrow.parquet as pq

        pq.write_table(pa.table(columns), path)
        path.write_bytes(path.read_bytes()[: -cut or None])

    return write


def mf4(spoil: Callable[[bytearray], None]) -> Callable[[Path], None]:
    """An MDF file with bytes changed."""

    def write(path: Path) -> None:
        from asammdf import MDF, Signal

        time = np.arange(301) * 0.002
        with MDF(version="4.10") as file:
            file.append(
                [Signal(samples=np.sin(time), timestamps=time, name=name, unit="mm") for name in ("stroke", "force")]
            )
            file.save(path, overwrite=True)
        data = bytearray(path.read_bytes())
        spoil(data)
        path.write_bytes(data)

    return write
