"""Files with rates of their own are joined, and what does not belong together is said with its place."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from rolling import SHEET, rolling
from typer.testing import CliRunner

from twintube.cli import app
from twintube.driving.features import table
from twintube.driving.joining import join
from twintube.driving.signals import Signals, read
from twintube.errors import InputError

CAR = {"wheelbase_m": SHEET["wheelbase_m"], "wheel_radius_m": SHEET["wheel_radius_m"]}
Columns = dict[str, np.ndarray]


def parts(drive: Signals) -> dict[str, Columns]:
    """Wheel speeds of a bus whose messages jitter, and slower inertial signals."""
    random = np.random.default_rng(3)
    jitter = drive.time + 0.003 * random.uniform(-1.0, 1.0, len(drive))
    slow = drive.time[::4].copy()
    inertial = ("accel_x_m_per_s2", "accel_y_m_per_s2", "yaw_rate_rad_per_s")
    return {
        "can.csv": {"time_s": jitter}
        | {name: np.interp(jitter, drive.time, x) for name, x in drive.values.items() if "wheel" in name},
        "imu.csv": {"time_s": slow} | {name: drive.values[name][::4] for name in inertial},
    }


def written(folder: Path, files: dict[str, Columns]) -> list[Path]:
    for name, columns in files.items():
        np.savetxt(
            folder / name, np.column_stack(list(columns.values())), "%.7f", ",", header=",".join(columns), comments=""
        )
    return [folder / name for name in files]


def test_two_rates_and_jitter_give_the_features_of_one_raster(tmp_path: Path) -> None:
    drive = rolling()
    again = join(written(tmp_path, parts(drive)), CAR)
    assert again.interval == pytest.approx(drive.interval, rel=1e-3) and set(again.values) < set(drive.values)
    one, other = table(drive)[0], table(again)[0]
    # A line between samples of 100 Hz takes a tenth of the power at 15 Hz.
    assert all(
        one[name] == pytest.approx(other[name], abs=0.15) for name in one if name.startswith(("speed_hop", "speed_side"))
    )


def test_the_command_writes_a_drive(tmp_path: Path) -> None:
    files = written(tmp_path, parts(rolling(seconds=30.0)))
    (tmp_path / "car.toml").write_text('name = "c"\n[body]\nwheelbase = "2.8 m"\n[front_tyre]\nradius = "0.3 m"\n')
    output = tmp_path / "drive.parquet"
    arguments = ["join", *map(str, files), "--car", str(tmp_path / "car.toml"), "--output", str(output)]
    run = CliRunner().invoke(app, arguments)
    assert run.exit_code == 0, run.output
    assert read(output).car["wheelbase_m"] == 2.8


def later(files: dict[str, Columns]) -> None:
    files["imu.csv"]["time_s"] = files["imu.csv"]["time_s"] + 1e6


def back(files: dict[str, Columns]) -> None:
    files["can.csv"]["time_s"][2000:] -= 5.0


def forth(files: dict[str, Columns]) -> None:
    files["imu.csv"]["time_s"][500:] += 5.0


def lost(files: dict[str, Columns]) -> None:
    files["can.csv"] = {name: np.delete(x, slice(1000, 1010)) for name, x in files["can.csv"].items()}


def twice(files: dict[str, Columns]) -> None:
    files["can.csv"]["accel_x_m_per_s2"] = np.ones(len(files["can.csv"]["time_s"]))


def no_yaw(files: dict[str, Columns]) -> None:
    del files["imu.csv"]["yaw_rate_rad_per_s"]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (later, r"can.csv from .* s; imu.csv from 1e\+06 to .* s: must be of one drive and one clock, and share 90%"),
        (back, r"can.csv: time_s, sample 2001: .*, a clock that steps back: the times must increase by at most 31.2 ms"),
        (forth, r"imu.csv: time_s, sample 501: .*, a gap, or a clock that jumps: .* at most 500 ms; cut the file there"),
        (lost, r"can.csv: time_s, sample 1001: .*, a gap, or a clock that jumps"),
        (twice, r"accel_x_m_per_s2: is in can.csv and in imu.csv: must be in one file"),
        (no_yaw, r"missing: yaw_rate_rad_per_s"),
    ],
)
def test_what_does_not_belong_together_is_said(
    tmp_path: Path, change: Callable[[dict[str, Columns]], None], says: str
) -> None:
    files = parts(rolling())
    change(files)
    with pytest.raises(InputError, match=says):
        join(written(tmp_path, files), CAR)
