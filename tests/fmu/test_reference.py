"""The reference run inside the FMU is reproduced by who replays its input."""

import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.util import read_csv
from numpy.typing import NDArray

from twintube.demo.damper_fmu import DamperFmu
from twintube.fmu.related import FOLDER


@pytest.fixture
def run(sa8_fmu: Path, tmp_path: Path) -> tuple[NDArray[np.void], NDArray[np.void]]:
    """Input and reference, one row per communication point."""
    with zipfile.ZipFile(sa8_fmu) as archive:
        files = [archive.extract(f"{FOLDER}/{name}.csv", tmp_path) for name in ("input", "reference")]
    given, expected = (read_csv(file) for file in files)
    assert (given["time"] == expected["time"]).all()
    return given, expected


def test_stepping_meets_the_reference_to_the_bit(sa8_fmu: Path, run: tuple[NDArray[np.void], NDArray[np.void]]) -> None:
    """Row `i` of the input is set before the step from `time[i]`; row `i` of the reference holds then, before that step."""
    given, expected = run
    with DamperFmu(sa8_fmu) as damper:
        for (_, stroke, velocity), (_, force, k_degr) in zip(given, expected, strict=True):
            found = damper.outputs()
            assert (found["force"], found["k_degr"]) == (force, k_degr)
            damper.step(stroke, velocity, 1e-3)
        assert damper.messages == []
    assert np.ptp(expected["force"]) > 1000


def test_fmpy_simulates_the_reference(sa8_fmu: Path, run: tuple[NDArray[np.void], NDArray[np.void]]) -> None:
    given, expected = run
    result = fmpy.simulate_fmu(str(sa8_fmu), input=given, output=["force", "k_degr"], output_interval=1e-3,
                               stop_time=given["time"][-1])  # fmt: skip
    np.testing.assert_allclose(result["time"], expected["time"], rtol=0, atol=1e-9)
    # fmpy sets the first input before the initialization, the reference starts at rest: row 0 differs, and only that one.
    # It interpolates the input at rounded times, hence the tolerance.
    for name, tolerance in (("force", 1e-6), ("k_degr", 1e-9)):
        assert result[name][1:] == pytest.approx(expected[name][1:], abs=tolerance)
