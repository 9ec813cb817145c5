"""Signals are read as they were written, and what is wrong in a file is said by name and place."""

import json
import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from twintube import ParameterError
from twintube.data.formats import Format, Raw
from twintube.driving import signals as signals_file
from twintube.driving.channels import CHANNELS
from twintube.driving.columns import BARE
from twintube.driving.sheet import data_sheet
from twintube.driving.signals import KEY, Signals, from_frame, read
from twintube.driving.writing import write
from twintube.errors import InputError
from twintube.readers.tables import parquet
from twintube.vehicle.cars import load_car

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
    (tmp_path / "drive.json").write_text("{}")
    with pytest.raises(InputError, match=re.escape("the ending .json: must be one of .parquet, .pq, .mf4, .csv")):
        read(tmp_path / "drive.json")


def test_a_file_says_its_units(signals: Signals, tmp_path: Path) -> None:
    write(signals, tmp_path / "drive.parquet")
    schema = pq.read_schema(tmp_path / "drive.parquet")
    assert {name: schema.field(name).metadata[b"unit"].decode() for name in CHANNELS} == {
        name: channel.unit for name, channel in CHANNELS.items()
    }
    assert set(json.loads(schema.metadata[KEY.encode()])) == {"car", "drive", "channels", "labels"}


LENGTHS = {"wheelbase_m": 2.7, "wheel_radius_m": 0.31}
# By channel without its unit: what one of the unit in a file is in that of the channel.
OTHERS = {
    "time": ("ms", 1e-3), "wheel_speed": ("km/h", 1.0 / 3.6 / 0.31), "accel": ("g", 9.80665), "yaw_rate": ("°/s", np.pi / 180),
    "steering_angle": ("deg", np.pi / 180), "brake_pressure": ("bar", 1e5), "wheel_accel": ("m/s²", 1.0),
    "body_accel_z": ("m/s^2", 1.0), "ambient_temperature": ("°C", 1.0),
}  # fmt: skip


def table(signals: Signals) -> dict[str, np.ndarray]:
    return {"time_s": signals.time, **signals.values}


def in_other_units(signals: Signals) -> dict[str, tuple[str, np.ndarray]]:
    """By bare name the unit and the values."""
    found = {}
    for bare, name in BARE.items():
        unit, size = next(OTHERS[each] for each in sorted(OTHERS, key=len, reverse=True) if bare.startswith(each))
        found[bare] = unit, table(signals)[name] / size
    return found


def text(rows: Sequence[Sequence[object]], delimiter: str, decimal: str) -> str:
    cells = [[repr(float(x)).replace(".", decimal) if isinstance(x, float) else str(x) for x in row] for row in rows]
    return "\n".join(delimiter.join(row) for row in cells)


def same(found: Signals, signals: Signals) -> None:
    assert set(found.values) == set(signals.values)
    np.testing.assert_allclose(found.time, signals.time, atol=1e-12)
    for name, values in signals.values.items():
        np.testing.assert_allclose(found.values[name], values, rtol=1e-12)


@pytest.mark.parametrize(("delimiter", "decimal"), [(",", "."), (";", ","), (";", "."), ("\t", ",")])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "cp1252"])
def test_text_is_read_in_its_units_and_writing(
    signals: Signals, tmp_path: Path, delimiter: str, decimal: str, encoding: str
) -> None:
    named = in_other_units(signals)
    heads = [f"{bare} [{unit}]" for bare, (unit, _) in named.items()]
    body = [[*map(float, row), "D"] for row in zip(*(values for _, values in named.values()), strict=True)]
    path = tmp_path / "drive.csv"
    rows = [["Fahrzeug", "Länge"], ["1", "2"], [*heads, "Gear"], *body]
    path.write_text(text(rows, delimiter, decimal), encoding=encoding)
    same(read(path, LENGTHS), signals)


def test_units_may_stand_in_a_row_of_their_own(signals: Signals, tmp_path: Path) -> None:
    named = in_other_units(signals)
    body = [list(map(float, row)) for row in zip(*(values for _, values in named.values()), strict=True)]
    path = tmp_path / "drive.txt"
    path.write_text(text([list(named), [unit for unit, _ in named.values()], *body], ";", ","), encoding="utf-8")
    same(read(path, LENGTHS), signals)


def test_times_of_a_text_may_be_stamps(signals: Signals, tmp_path: Path) -> None:
    stamps = [f"2026-05-13T16:04:{x:09.6f}" for x in signals.time]
    body = zip(stamps, *(values.tolist() for values in signals.values.values()), strict=True)
    rows = [["time", *signals.values], *body]
    path = tmp_path / "drive.csv"
    path.write_text(text(rows, ",", "."), encoding="utf-8")
    same(read(path, LENGTHS), signals)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("yaw_rate_rad_per_s", "yaw_rate", r"yaw_rate: no unit: must be like 'yaw_rate \[1/min\]', or yaw_rate_rad_per_s"),
        ("yaw_rate_rad_per_s", "yaw_rate [Hz]", "yaw_rate .Hz.: unit 'Hz': must be one of rad/s, deg/s"),
        ("yaw_rate_rad_per_s", "yaw_rate_rad_per_s [deg/s]", "in deg/s, rad/s: must be in one unit"),
        ("yaw_rate_rad_per_s", "gierrate", "missing: yaw_rate_rad_per_s"),
        ("body_accel_z_m_per_s2", "accel_x [g]", "'accel_x_m_per_s2' and 'accel_x .g.': are the same channel"),
        ("time_s", "t", "missing: time_s"),
    ],
)
def test_a_wrong_column_of_a_text_is_said(signals: Signals, tmp_path: Path, old: str, new: str, message: str) -> None:
    path = tmp_path / "drive.csv"
    rows = [[new if name == old else name for name in table(signals)], *zip(*table(signals).values(), strict=True)]
    path.write_text(text(rows, ",", "."), encoding="utf-8")
    with pytest.raises(InputError, match="drive.csv: .*" + message):
        read(path, LENGTHS)


def test_a_wrong_cell_of_a_text_is_said_with_its_row(signals: Signals, tmp_path: Path) -> None:
    path = tmp_path / "drive.csv"
    rows = [list(table(signals)), *map(list, zip(*table(signals).values(), strict=True))]
    rows[5][1] = "x"
    path.write_text(text(rows, ",", "."), encoding="utf-8")
    with pytest.raises(InputError, match=r"drive.csv: row 6, column 'wheel_speed_fl_rad_per_s': 'x' is not a finite number"):
        read(path, LENGTHS)
    path.write_text("a,b\n1,2\n3,4\n", encoding="utf-8")
    with pytest.raises(InputError, match="none of its first 4 rows names the channels"):
        read(path, LENGTHS)


@pytest.mark.parametrize("times", ["column", "index", "stamps", "differences"])
def test_a_table_of_pandas_is_a_drive(signals: Signals, times: str) -> None:
    frame = pd.DataFrame(table(signals))
    if times != "column":
        frame = frame.set_index("time_s")
        later = pd.to_timedelta(signals.time, unit="s")
        frame.index = {"index": frame.index, "stamps": pd.Timestamp("2026-05-13") + later, "differences": later}[times]
    same(from_frame(frame, LENGTHS), signals)
    assert from_frame(frame, LENGTHS).car == LENGTHS


def test_a_parquet_file_of_pandas_needs_the_car_beside(signals: Signals, tmp_path: Path, in_process: None) -> None:
    path = tmp_path / "drive.parquet"
    pd.DataFrame(table(signals)).to_parquet(path)
    assert dict(read(path).car) == {} and dict(read(path, LENGTHS).car) == LENGTHS
    same(read(path, LENGTHS), signals)


def test_a_file_and_what_is_given_beside_are_of_one_car(signals: Signals, tmp_path: Path, in_process: None) -> None:
    path = tmp_path / "drive.parquet"
    write(signals, path)
    assert read(path, LENGTHS).car == {"name": "a car", **LENGTHS}
    with pytest.raises(InputError, match=r"car.wheelbase_m = 2.7 m in the file, 3.1 m is given: must be the same car"):
        read(path, {"wheelbase_m": 3.1})


def test_a_wheel_in_km_per_h_needs_its_radius(signals: Signals) -> None:
    frame = {"time_s": signals.time} | {
        name.replace("rad_per_s", "").rstrip("_") + " [km/h]" if "wheel_speed" in name else name: values
        for name, values in signals.values.items()
    }
    with pytest.raises(
        InputError, match=r"car.wheel_radius_m is not known: give --car FILE, in which \[front_tyre\] has radius"
    ):
        from_frame(frame, {"wheelbase_m": 2.7})


def test_texts_in_a_table_of_pandas_are_refused(signals: Signals) -> None:
    with pytest.raises(InputError, match=r"time_s: .*must be numbers"):
        from_frame(table(signals) | {"time_s": np.array(["a"] * 200)}, LENGTHS)


def test_the_data_sheet_is_read_from_a_car_file(tmp_path: Path) -> None:
    path = tmp_path / "van.toml"
    path.write_text('name = "van"\n[body]\nwheelbase = "2.7 m"\n[front_tyre]\nradius = "310 mm"\n')
    assert data_sheet(path) == {"name": "van"} | LENGTHS
    whole = load_car("passat_b8").whole
    assert data_sheet("passat_b8")["track_rear_m"] == whole["rear_axle"]["track"]
    path.write_text('[body]\nwheelbase = "27 m"\nheigth = 1\n')
    with pytest.raises(ParameterError) as error:
        data_sheet(path)
    for part in ("van.toml: ", "wheelbase = 27 m", "heigth", "[front_tyre] radius is missing: must be from 0.1 to 1 m"):
        assert part in str(error.value)
