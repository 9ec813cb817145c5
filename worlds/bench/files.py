"""A dataset as loggers and people write it (docs/measured_data.md), and the truth beside it."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
import pyarrow
import pyarrow.parquet
import tomlkit
from scipy.io import savemat

from twintube.common.arrays import Array
from twintube.common.files import replacing, write_text
from twintube.dampers import Damper, to_toml

Columns = Mapping[str, Array]  # by header: "time [s]", "stroke [mm]", "force [N]", and more
# Of a logger, in those units; of the force so many that kilonewtons written as newtons still have their noise.
DIGITS: Final = {"time": 7, "stroke": 5, "force": 4, "velocity": 3, "temperature": 1}
PARAMETERS: Final = "damper.toml"
BASIC: Final = (TIME := "time [s]", STROKE := "stroke [mm]", FORCE := "force [N]")


@dataclass(frozen=True)
class Layout:
    """How a logger writes a record: `names` by header are those in the file and the factor of the values, in its order."""

    suffix: str = ".csv"
    delimiter: str = ","
    decimal: str = "."
    head: tuple[str, ...] = ()  # lines above the names
    units: str = ""  # line below them
    names: Mapping[str, tuple[str, float]] = field(default_factory=dict)
    entries: Mapping[str, Any] = field(default_factory=dict)  # more of dataset.toml
    rows: bool = False  # JSON by rows

    def named(self, columns: Columns) -> dict[str, Array]:
        """The columns under their names in the file, rounded; with `names` none of time, stroke and force but these."""
        order = [*self.names, *(name for name in columns if name not in self.names and not (self.names and name in BASIC))]
        found = {}
        for header in order:
            if header in columns:
                name, factor = self.names.get(header, (header, 1.0))
                digits = DIGITS[header.split()[0]] - round(math.log10(abs(factor)))
                found[name] = np.round(factor * columns[header], digits)
        return found

    def manifest(self, columns: Columns) -> dict[str, Any]:
        """What dataset.toml must say about the files."""
        own = {header: name for header, (name, _) in self.names.items() if "[" not in name and header in columns}
        said = {"delimiter": self.delimiter, "decimal": self.decimal, "skip_rows": len(self.head), "columns": own}
        usual = {"delimiter": ",", "decimal": ".", "skip_rows": 0, "columns": {}}
        return {key: value for key, value in said.items() if value != usual[key]} | dict(self.entries)

    def write(self, path: Path, columns: Columns) -> None:
        """Write a record."""
        table = self.named(columns)
        with replacing(path) as part:
            if self.suffix == ".parquet":
                pyarrow.parquet.write_table(pyarrow.table(table), part)
            elif self.suffix == ".mat":
                log, _, _ = next(iter(table)).partition(".")
                inner = {name.rpartition(".")[2]: values for name, values in table.items()}
                savemat(part, inner if log in inner else {log: inner})
            else:
                part.write_text(self.text(table), encoding="utf-8", newline="\n")

    def text(self, table: dict[str, Array]) -> str:
        """The record as text."""
        if self.suffix == ".json":
            if self.rows:
                return json.dumps({"columns": list(table), "data": np.column_stack(list(table.values())).tolist()})
            units = {name.split()[0]: name.split("[")[1][:-1] for name in table}
            return json.dumps({"units": units, **{name.split()[0]: values.tolist() for name, values in table.items()}})
        rows = zip(*([repr(value) for value in values.tolist()] for values in table.values()), strict=True)
        lines = [self.delimiter.join(row) for row in rows]
        if self.decimal != ".":
            lines = [line.replace(".", self.decimal) for line in lines]
        return "\n".join([*self.head, self.delimiter.join(table), *([self.units] if self.units else []), *lines]) + "\n"


MILLISECONDS: Final = {TIME: ("time [ms]", 1e3), STROKE: (STROKE, 1.0), FORCE: (FORCE, 1.0)}
LAYOUTS: Final[Mapping[str, Layout]] = {
    "csv": Layout(),
    "german": Layout(delimiter=";", decimal=","),
    "tabs": Layout(".txt", "\t"),
    "tsv": Layout(".tsv", "\t", names=MILLISECONDS),
    "parquet": Layout(".parquet"),
    "csv_german": Layout(delimiter=";", decimal=",", units="s;N;mm",
                         names={TIME: ("Zeit", 1.0), FORCE: ("Kraft", 1.0), STROKE: ("Weg", 1.0)}),
    "csv_kilo": Layout(names={TIME: (TIME, 1.0), FORCE: ("force [kN]", 1e-3), STROKE: ("stroke [m]", 1e-3)}),
    "csv_volts": Layout(names={TIME: (TIME, 1.0), STROKE: (STROKE, 1.0), FORCE: ("AI1 [V]", 1 / 500.0)},
                        entries={"channels": {"force": {"column": "AI1 [V]", "scale": "500 N/V"}}}),
    # Without times; the rig's force is positive in compression.
    "csv_clock": Layout(names={STROKE: (STROKE, 1.0), FORCE: (FORCE, -1.0)}, entries={"force_sign": -1}),
    "txt": Layout(".txt", "\t", head=("Servo bench 3, channel log", "operator KW")),
    "machine": Layout(".csv", "\t", head=("Damper test bench", "Test type\tcyclic", "Channels\tall", ""), names={
        TIME: ("Time (s)", 1.0), STROKE: ("Displacement (mm)", 1.0), FORCE: ("Load (N)", 1.0),
        "temperature [degC]": ("Temp (degC)", 1.0)}),
    "json": Layout(".json"),
    "json_rows": Layout(".json", rows=True),
    "mat": Layout(".mat", names={TIME: ("t", 1.0), STROKE: ("s_mm", 1.0), FORCE: ("F_N", 1.0)}),
    "mat_struct": Layout(".mat", names={TIME: ("log.t", 1.0), STROKE: ("log.x", 1.0), FORCE: ("log.F", 1.0)}),
}  # fmt: skip


def in_milliseconds(layout: Layout) -> Layout:
    """The same with times in milliseconds."""
    return replace(layout, names=MILLISECONDS)


def write_dataset(
    folder: Path, title: str, damper: str | Damper, layout: Layout, records: Sequence[tuple[str, dict[str, Any], Columns]]
) -> None:
    """Write records, each a name, its entries and its columns, and dataset.toml, which comes last.

    A damper that is no name is written as a parameter file: what it says of freed gas is not that of the named one.
    """
    folder.mkdir(parents=True, exist_ok=True)
    columns = records[0][2]
    if isinstance(damper, Damper):
        write_text(folder / PARAMETERS, to_toml(damper))
    named = PARAMETERS if isinstance(damper, Damper) else damper
    document: dict[str, Any] = {"title": title, "damper": named, **layout.manifest(columns)}
    if layout.names and TIME not in layout.names:
        times = columns[TIME]
        document["sample_rate_Hz"] = float(f"{(len(times) - 1) / float(times[-1] - times[0]):.6g}")
    for name, _, table in records:
        layout.write(folder / (name + layout.suffix), table)
    document["record"] = [{"file": name + layout.suffix, **entries} for name, entries, _ in records]
    write_text(folder / "dataset.toml", tomlkit.dumps(document))


def write_truth(folder: Path, truth: dict[str, Any]) -> None:
    """Write truth.json, the last file of a dataset that is being made; numbers to six digits."""
    rounded = json.loads(json.dumps(truth), parse_float=lambda text: float(f"{float(text):.6g}"))
    write_text(folder / "truth.json", json.dumps(rounded, indent=1) + "\n")


def told(world: str, seed: int, damper: str, causes: Sequence[str], *, kind: str, more: Mapping[str, Any]) -> dict[str, Any]:
    """The entries of truth.json; `kind` is none, effect, fault or outside, of a pair that of its causes."""
    outside = "outside:" if kind == "outside" else ""  # before the name of a cause that no catalogue has
    filled = "oil_level_error" in causes  # another fill than the file states, whatever it is called
    return {
        **more, "world": world, "seed": seed, "damper": damper, "kind": "state" if filled and len(causes) == 1 else kind,
        "causes": [outside + name for name in causes], "also_fits": ["state"] * filled,
    }  # fmt: skip
