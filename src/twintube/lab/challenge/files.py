"""A dataset folder as a bench writes it."""

from pathlib import Path
from typing import Any

import numpy as np
import tomlkit

from twintube.arrays import Array
from twintube.files import replacing, write_text
from twintube.lab.challenge.plan import Bench
from twintube.lab.challenge.sampling import Samples

SUFFIX = {"csv": ".csv", "german": ".csv", "tabs": ".txt", "parquet": ".parquet"}


def table_of(samples: Samples, bench: Bench, unit: tuple[float, float]) -> dict[str, Array]:
    """Columns by header; `unit` are factors of force and stroke."""
    scale, name = (1e3, "time [ms]") if bench.milliseconds else (1.0, "time [s]")
    table = {
        name: np.round(scale * samples.time, 4 if bench.milliseconds else 7),
        "stroke [mm]": np.round(1e3 * unit[1] * samples.stroke, 5),
        "force [N]": np.round(unit[0] * samples.force, 4),
    }
    if bench.velocity_column:
        table["velocity [mm/s]"] = np.round(1e3 * unit[1] * samples.velocity, 3)
    if samples.temperature is not None:
        table["temperature [degC]"] = samples.temperature
    return table


def write_table(path: Path, table: dict[str, Array], form: str) -> None:
    """One record."""
    if form == "parquet":
        import pyarrow as pa
        import pyarrow.parquet as pq

        with replacing(path) as part:
            pq.write_table(pa.table(table), part)
        return
    separator = {"csv": ",", "german": ";", "tabs": "\t"}[form]
    lines = [separator.join(table)]
    columns = [[repr(x) for x in column.tolist()] for column in table.values()]
    lines += [separator.join(row) for row in zip(*columns, strict=True)]
    text = "\n".join(lines) + "\n"
    write_text(path, text.replace(".", ",") if form == "german" else text)


def write_dataset(folder: Path, bench: Bench, title: str, records: list[tuple[Samples, tuple[float, float]]]) -> None:
    """All records and dataset.toml, which comes last."""
    document = tomlkit.document()
    document["title"] = title
    document["damper"] = bench.damper.name
    if bench.format == "german":
        document["delimiter"], document["decimal"] = ";", ","
    if bench.format == "tabs":
        document["delimiter"] = "\t"
    tables = tomlkit.aot()
    volume = bench.damper.parameters.V_oil
    for record, (samples, unit) in zip(bench.records, records, strict=True):
        file = record.name + SUFFIX[bench.format]
        write_table(folder / file, table_of(samples, bench, unit), bench.format)
        entry: dict[str, Any] = {"file": file, "measurement": record.measurement}
        if bench.volumes:
            entry["oil_volume_mL"] = round(1e6 * volume * record.level, 3)
        else:
            entry["oil_level"] = record.level
        entry["gas_preload"] = record.preload
        if bench.temperatures:
            entry["start_temperature_degC"] = record.temperature
        table = tomlkit.table()
        table.update(entry)
        tables.append(table)
    document["record"] = tables
    write_text(folder / "dataset.toml", tomlkit.dumps(document))
