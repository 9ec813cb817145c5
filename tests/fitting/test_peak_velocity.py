"""The peak-velocity evaluation of sines whose force is known."""

import dataclasses
import io

import numpy as np
import pytest

from twintube.fitting.harmonic import Harmonic
from twintube.fitting.peak_velocity import COLUMNS, as_csv, as_xlsx, peak_velocities

SAMPLES, AMPLITUDE, FREQUENCY = 1000, 0.02, 2.0


def record(offset: float = 0.0, usable: bool = True) -> Harmonic:
    """Three oscillations of a damper with 3000 Ns/m in rebound and 1000 Ns/m in compression, and a spring of 5000 N/m."""
    time = np.arange(3 * SAMPLES + 1) / (SAMPLES * FREQUENCY)
    turns = 2 * np.pi * FREQUENCY
    stroke, velocity = AMPLITUDE * np.sin(turns * time) + offset, AMPLITUDE * turns * np.cos(turns * time)
    force = np.where(velocity > 0, 3000.0, 1000.0) * velocity + 5000.0 * (stroke - offset)
    marks = np.arange(4) * SAMPLES + SAMPLES // 4
    marks = marks[marks <= 3 * SAMPLES]
    return Harmonic(
        1.0, 1, time, stroke, velocity, force, marks, "sine", usable=None if usable else np.zeros(len(time), dtype=bool)
    )


def test_the_three_forces_are_those_of_the_line() -> None:
    top = AMPLITUDE * 2 * np.pi * FREQUENCY
    rebound, compression = peak_velocities([record(0.01)])
    assert (rebound.direction, compression.direction, rebound.oscillations) == ("rebound", "compression", 2)
    for row, slope in ((rebound, 3000.0), (compression, -1000.0)):
        sign = np.sign(slope)
        assert abs(row.velocity - sign * top) < 1e-4 * top
        for force in (row.at_peak, row.crossing):
            assert abs(force - slope * top) < 1e-2 * abs(slope) * top
        # The mean of a cosine from 1 down to 0.9 and back; the spring cancels out.
        edge = np.arccos(0.9)
        assert abs(row.window - slope * top * np.sin(edge) / edge) < 2e-3 * abs(slope) * top


def test_oscillations_that_say_nothing_are_left_out() -> None:
    assert peak_velocities([record(usable=False)]) == []


def test_the_table_has_a_row_for_each_direction() -> None:
    lines = as_csv(peak_velocities([record()])).splitlines()
    assert lines[0] == "record,direction,oscillations,velocity_m_s,force_peak_N,force_window_N,force_crossing_N"
    assert [line.split(",")[:2] for line in lines[1:]] == [["sine", "rebound"], ["sine", "compression"]]


def test_the_sheet_holds_the_same_as_numbers() -> None:
    pytest.importorskip("xlsxwriter")
    calamine = pytest.importorskip("python_calamine")
    rows = [dataclasses.replace(row, record="=1+1") for row in peak_velocities([record()])]
    sheet = as_xlsx(rows)
    (name,) = calamine.CalamineWorkbook.from_filelike(io.BytesIO(sheet)).sheet_names
    head, *found = calamine.CalamineWorkbook.from_filelike(io.BytesIO(sheet)).get_sheet_by_name(name).to_python()
    assert tuple(head) == COLUMNS
    for line, row in zip(found, map(dataclasses.astuple, rows), strict=True):
        assert tuple(line[:2]) == row[:2]
        assert line[2:] == pytest.approx(row[2:], rel=1e-15)  # Excel has 16 digits
    assert as_xlsx(rows) == sheet
