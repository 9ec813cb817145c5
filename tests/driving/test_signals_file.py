"""Signals are read as they were written, and what is wrong in a file is said by name and place."""

import json
import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from twintube.data.formats import Format, Raw
from twintube.data.read.binary_child import parquet
from twintube.driving import signals as signals_file
from twintube.driving.channels import CHANNELS
from twintube.driving.signals import KEY, Signals, read, write
from twintube.errors import InputError

YAW = "yaw_rate_rad_per_s"
SPEED = "wheel_speed_fl_rad_per_s"


@pytest.fixture
def signals() -> Signals:
    random = np.random.default_rng(1)
    values = {name: random.uniform(0.0, 1.0, 200) for name in CHANNELS}
    return Signals(np.arange(200) * 0.01, values, {"name": "a car", "wheelbase_m": 2.7}, {"id": 7}, {}, {"oil_level": 0.4})


@pytest.mark.parametrize("ending", ["parquet", "mf4"])
def test_what_is_written_is_read(signals: Signals, tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"drive.{ending}"
    write(signals, path)
    again = read(path)
    np.testing.assert_array_equal(again.time, signals.time)
    assert again.known() == signals.known() and set(again.values) == set(CHANNELS)
    for name, values in signals.values.items():
        np.testing.assert_array_equal(again.values[name], values)


@pytest.fixture
def in_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """The reader's own process takes a second a file."""

    def reading(files: Sequence[tuple[Path, Format]]) -> Iterator[Raw]:
        for path, _ in files:
            columns = parquet(str(path), {})
            values = {
                name: [None if e else v for v, e in zip(x, columns.empty[name], strict=True)]
                if columns.empty[name].any()
                else x
                for name, x in columns.values.items()
            }
            yield Raw(values, range(len(values["accel_x_m_per_s2"])))

    monkeypatch.setattr(signals_file, "read_binary", reading)


def renamed(table: pa.Table, old: str, new: str) -> pa.Table:
    return table.rename_columns([new if name == old else name for name in table.column_names])


def changed(table: pa.Table, name: str, row: int, value: float | None) -> pa.Table:
    values = table[name].to_pylist()
    values[row] = value
    return table.set_column(table.column_names.index(name), name, pa.array(values, pa.float64()))


def about(table: pa.Table, text: str) -> pa.Table:
    return table.replace_schema_metadata({KEY: text})


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda t: t.drop_columns([YAW]), f"missing: {YAW}$"),
        (lambda t: renamed(t, YAW, "yaw_rate_deg_per_s"), f"missing: {YAW} .*'yaw_rate_deg_per_s'"),
        (lambda t: renamed(t, "time_s", "timestamp"), "missing: time_s"),
        (lambda t: pa.concat_tables([t.slice(0, 50), t.slice(80)]), "a gap of 0.31 s after 0.49 s: must be at most"),
        (
            lambda t: pa.concat_tables([t.slice(100, 50), t.slice(0, 50)]),
            "sample 51: 0 s after 1.49 s: the times must increase",
        ),
        (lambda t: changed(t, SPEED, 3, np.nan), f"time 0.03 s: {SPEED} = nan"),
        (lambda t: changed(t, SPEED, 3, None), f"{SPEED}, sample 4: no value"),
        (lambda t: changed(t, SPEED, 3, 401.0), f"time 0.03 s: {SPEED} = 401 rad/s: must be a number from 0 to 400"),
        (lambda t: changed(t, "time_s", 5, np.inf), "time_s, sample 6: must be a number"),
        (lambda t: t.slice(0, 1), "1 samples, at least 2"),
        (lambda t: about(t, "{"), f"metadata {KEY}: not JSON"),
        (lambda t: about(t, "[]"), "must be a table"),
        (lambda t: about(t, '{"car": 1}'), "car: must be a table"),
        (lambda t: about(t, '{"car": {"wheelbase_m": "long"}}'), "car.wheelbase_m = 'long': must be a number"),
        (lambda t: about(t, '{"car": {"wheelbase_m": 99}}'), "car.wheelbase_m = 99 m: must be"),
    ],
)
def test_what_is_wrong_is_said(signals: Signals, tmp_path: Path, edit: Callable[[pa.Table], pa.Table], message: str) -> None:
    path = tmp_path / "drive.parquet"
    write(signals, path)
    pq.write_table(edit(pq.read_table(path)), path)
    with pytest.raises(InputError, match=message) as error:
        read(path)
    assert str(error.value).startswith("drive.parquet: ") and "\n" not in str(error.value)


def test_columns_beside_the_channels_are_left_out(signals: Signals, tmp_path: Path, in_process: None) -> None:
    path = tmp_path / "drive.parquet"
    write(signals, path)
    table = pq.read_table(path)
    pq.write_table(table.append_column("gear", pa.array(np.ones(200))), path)
    assert set(read(path).values) == set(CHANNELS)


def test_a_damaged_file_and_another_format_are_refused(signals: Signals, tmp_path: Path) -> None:
    path = tmp_path / "drive.parquet"
    path.write_bytes(b"PAR1")
    with pytest.raises(InputError, match=r"drive\.parquet: not a readable"):
        read(path)
    with pytest.raises(InputError, match=re.escape("must be one of .parquet")):
        write(signals, tmp_path / "drive.csv")
    assert not (tmp_path / "drive.csv").exists()


def test_a_file_says_its_units(signals: Signals, tmp_path: Path) -> None:
    write(signals, tmp_path / "drive.parquet")
    schema = pq.read_schema(tmp_path / "drive.parquet")
    assert {name: schema.field(name).metadata[b"unit"].decode() for name in CHANNELS} == {
        name: channel.unit for name, channel in CHANNELS.items()
    }
    assert set(json.loads(schema.metadata[KEY.encode()])) == {"car", "drive", "channels", "labels"}
