"""Records and manifest as loggers and people write them (formats: docs/measured_data.md of twintube)."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet
from scipy.io import savemat

from twintube.lab.workshop.cause import Array

Columns = dict[str, Array]
LAYOUTS = ("csv", "csv", "csv", "csv_german", "csv_kilo", "csv_volts", "csv_clock", "csv", "txt", "json", "json_rows", "mat",
           "parquet", "mat_struct", "txt", "tsv")  # fmt: skip


def rounded(columns: Columns) -> Columns:
    """Seconds, millimetres and newtons with the digits of a logger."""
    digits = {"time [s]": 6, "stroke [mm]": 4, "force [N]": 2}
    return {name: np.round(values, digits[name]) for name, values in columns.items()}


def text(path: Path, columns: dict[str, list[str]], delimiter: str, above: str = "", second: str = "") -> None:
    """A table of texts."""
    lines = [delimiter.join(row) for row in zip(*columns.values(), strict=True)]
    head = [above] if above else []
    head += [delimiter.join(columns)] + ([second] if second else [])
    path.write_text("\n".join([*head, *lines]) + "\n", encoding="utf-8")


def as_text(values: Array, form: str, comma: bool = False) -> list[str]:
    """Numbers as text."""
    cells = [format(value, form) for value in values.tolist()]
    return [cell.replace(".", ",") for cell in cells] if comma else cells


def csv(folder: Path, name: str, c: Columns) -> str:
    """Plain CSV."""
    forms = (".5f", ".4f", ".2f")
    text(folder / f"{name}.csv", {k: as_text(v, f) for (k, v), f in zip(c.items(), forms, strict=True)}, ",")
    return f"{name}.csv"


def csv_german(folder: Path, name: str, c: Columns) -> str:
    """Semicolons, decimal commas, German names."""
    t, s, f = c.values()
    text(folder / f"{name}.csv", {"Zeit": as_text(t, ".5f", True), "Kraft": as_text(f, ".2f", True),
         "Weg": as_text(s, ".4f", True)}, ";", second="s;N;mm")  # fmt: skip
    return f"{name}.csv"


def csv_kilo(folder: Path, name: str, c: Columns) -> str:
    """Kilonewtons and metres, other order."""
    t, s, f = c.values()
    text(folder / f"{name}.csv", {"time [s]": as_text(t, ".5f"), "force [kN]": as_text(f / 1e3, ".5f"),
         "stroke [m]": as_text(s / 1e3, ".7f")}, ",")  # fmt: skip
    return f"{name}.csv"


def csv_volts(folder: Path, name: str, c: Columns) -> str:
    """Force in volts of an amplifier with 500 N/V, to be scaled by the manifest."""
    t, s, f = c.values()
    text(folder / f"{name}.csv", {"time [s]": as_text(t, ".5f"), "stroke [mm]": as_text(s, ".4f"),
         "AI1 [V]": as_text(f / 500.0, ".5f")}, ",")  # fmt: skip
    return f"{name}.csv"


def csv_clock(folder: Path, name: str, c: Columns) -> str:
    """Without times; the manifest has the rate. The rig's force is positive in compression."""
    _, s, f = c.values()
    text(folder / f"{name}.csv", {"stroke [mm]": as_text(s, ".4f"), "force [N]": as_text(-f, ".2f")}, ",")
    return f"{name}.csv"


def txt(folder: Path, name: str, c: Columns) -> str:
    """Tabs, two lines of a logger above."""
    t, s, f = c.values()
    text(folder / f"{name}.txt", {"time [s]": as_text(t, ".5f"), "stroke [mm]": as_text(s, ".4f"),
         "force [N]": as_text(f, ".2f")}, "\t", above="Servo bench 3, channel log\noperator KW")  # fmt: skip
    return f"{name}.txt"


def tsv(folder: Path, name: str, c: Columns) -> str:
    """Tabs."""
    t, s, f = c.values()
    text(folder / f"{name}.tsv", {"time [ms]": as_text(t * 1e3, ".3f"), "stroke [mm]": as_text(s, ".4f"),
         "force [N]": as_text(f, ".2f")}, "\t")  # fmt: skip
    return f"{name}.tsv"


def json_lists(folder: Path, name: str, c: Columns) -> str:
    """Lists by name with units."""
    t, s, f = (values.tolist() for values in c.values())
    content = {"units": {"time": "s", "stroke": "mm", "force": "N"}, "time": t, "stroke": s, "force": f}
    (folder / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")
    return f"{name}.json"


def json_rows(folder: Path, name: str, c: Columns) -> str:
    """Columns and data."""
    rows = np.column_stack(list(c.values())).tolist()
    (folder / f"{name}.json").write_text(json.dumps({"columns": list(c), "data": rows}), encoding="utf-8")
    return f"{name}.json"


def mat(folder: Path, name: str, c: Columns) -> str:
    """MATLAB, one vector per channel."""
    t, s, f = c.values()
    savemat(folder / f"{name}.mat", {"t": t, "s_mm": s, "F_N": f})
    return f"{name}.mat"


def mat_struct(folder: Path, name: str, c: Columns) -> str:
    """MATLAB, a struct."""
    t, s, f = c.values()
    savemat(folder / f"{name}.mat", {"log": {"t": t, "x": s, "F": f}})
    return f"{name}.mat"


def parquet(folder: Path, name: str, c: Columns) -> str:
    """Parquet."""
    pyarrow.parquet.write_table(pyarrow.table(c), folder / f"{name}.parquet")
    return f"{name}.parquet"


WRITERS: dict[str, Callable[[Path, str, Columns], str]] = {
    "csv": csv, "csv_german": csv_german, "csv_kilo": csv_kilo, "csv_volts": csv_volts, "csv_clock": csv_clock, "txt": txt,
    "tsv": tsv, "json": json_lists, "json_rows": json_rows, "mat": mat, "mat_struct": mat_struct, "parquet": parquet,
}  # fmt: skip
READING: dict[str, list[str]] = {
    "csv_german": ['delimiter = ";"', 'decimal = ","',
                   'columns = {"time [s]" = "Zeit", "stroke [mm]" = "Weg", "force [N]" = "Kraft"}'],
    "csv_volts": ['channels = {force = {column = "AI1 [V]", scale = "500 N/V"}}'],
    "txt": ['delimiter = "\\t"', "skip_rows = 2"],
    "mat": ['columns = {"time [s]" = "t", "stroke [mm]" = "s_mm", "force [N]" = "F_N"}'],
    "mat_struct": ['columns = {"time [s]" = "log.t", "stroke [mm]" = "log.x", "force [N]" = "log.F"}'],
}  # fmt: skip


def manifest(title: str, damper: str, layout: str, rate: float, records: list[dict[str, Any]]) -> str:
    """The text of dataset.toml; a record has file, measurement, level and preload."""
    lines = [f'title = "{title}"', f'damper = "{damper}"', *READING.get(layout, [])]
    if layout == "csv_clock":
        lines += [f"sample_rate_Hz = {rate:.6g}", "force_sign = -1"]
    for record in records:
        lines += ["", "[[record]]", f'file = "{record["file"]}"', f'measurement = "{record["measurement"]}"']
        lines += [f"oil_level = {record['level']:g}", f"gas_preload = {str(record['preload']).lower()}"]
    return "\n".join(lines) + "\n"
