"""Signals of a drive written to Parquet and ASAM MDF 4."""

import json
from pathlib import Path

import numpy as np

from twintube.common.files import replacing
from twintube.driving.channels import CHANNELS, TIME
from twintube.driving.signals import KEY, Signals, check_suffix


def write(signals: Signals, path: str | Path) -> None:
    """Write signals as Parquet or MDF 4, by the ending, whole or not at all; raises InputError, OSError."""
    path = Path(path)
    check_suffix(path)
    text = json.dumps(signals.known(), allow_nan=False)
    with replacing(path) as part:
        (write_mdf if path.suffix.lower() == ".mf4" else write_parquet)(signals, part, text)


def write_parquet(signals: Signals, path: Path, text: str) -> None:
    """Columns in the order of CHANNELS behind the time."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    columns = {TIME: signals.time} | {name: signals.values[name] for name in CHANNELS if name in signals.values}
    units = {TIME: "s"} | {name: channel.unit for name, channel in CHANNELS.items()}
    fields = [pa.field(name, pa.float64(), metadata={"unit": units[name]}) for name in columns]
    schema = pa.schema(fields, metadata={KEY: text})
    pq.write_table(pa.table([pa.array(values) for values in columns.values()], schema=schema), path, compression="zstd")


def write_mdf(signals: Signals, path: Path, text: str) -> None:
    """One channel group, the text as an attachment."""
    from asammdf import MDF, Signal

    with MDF(version="4.10") as file:
        file.append(
            [
                Signal(np.array(values), np.array(signals.time), CHANNELS[name].unit, name, comment=CHANNELS[name].meaning)
                for name, values in signals.values.items()
            ],
            comment=KEY,
            common_timebase=True,
        )
        file.attach(text.encode(), file_name=f"{KEY}.json", mime="application/json")
        file.save(path, overwrite=True, compression=2)
