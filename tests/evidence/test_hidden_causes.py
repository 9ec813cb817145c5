"""Without a reference: what the model lacks is among what is named, and nothing is named where nothing is hidden."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from tests.diagnosis import small
from twintube import diagnose
from twintube.arrays import Array
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.evidence import answer
from twintube.evidence.contract import as_json
from twintube.report.answered import lines, write_report

SPEEDS = (0.3, 0.6, 1.0)  # [m/s]


def worn_valves(r: small.Run) -> Array:
    return r.force - np.where(r.velocity > 0.0, 0.2, 0.1) * r.fluid


def late_fluid(r: small.Run) -> Array:
    kept = float(np.exp(-(r.time[1] - r.time[0]) / 0.006))
    return np.asarray(r.force - r.fluid + lfilter([1.0 - kept], [1.0, -kept], r.fluid))


def more_friction(r: small.Run) -> Array:
    return np.asarray(r.force + 90.0 * np.tanh(r.velocity / 0.005))


def moved_zero(r: small.Run) -> Array:
    return r.force + 80.0


def heavy_clamp(r: small.Run) -> Array:
    return np.asarray(r.force + 4.0 * np.gradient(r.velocity, r.time))


HIDDEN: dict[str, small.Formula] = {
    "valve_wear": worn_valves,
    "fluid_lag": late_fluid,
    "side_load_friction": more_friction,
    "force_offset": moved_zero,
    "clamp_inertia": heavy_clamp,
}


@pytest.mark.parametrize("cause", HIDDEN)
def test_a_hidden_cause_is_among_what_is_named(cause: str) -> None:
    records = small.records(HIDDEN[cause], SPEEDS)
    found = answer(LoadedDataset("Small", load("SA8", as_published=True), records, []))
    assert cause in {h.name for h in found.named}
    assert found.verdict != "none"


def test_nothing_is_named_where_nothing_is_hidden() -> None:
    found = answer(LoadedDataset("Small", load("SA8", as_published=True), small.records(speeds=SPEEDS), []))
    assert found.verdict == "none"
    assert found.extended is None


def test_a_wrong_unit_is_put_right_and_told(tmp_path: Path) -> None:
    """The whole way from files: kN where the file says N."""
    records = [replace(r, force=1e-3 * r.force) for r in small.records(speeds=SPEEDS)]
    found = diagnose(small.write(records, tmp_path / "bench"))
    assert found.verdict == "measurement_fault"
    assert [(fault.effect, fault.factor) for fault in found.faults] == [("unit_error", 1000.0)]
    assert as_json(found)["credible_set"][0] == "unit_error"
    assert any("kN for N" in line for line in lines(found))
    write_report(found, tmp_path)
    assert "kN for N" in (tmp_path / "report.html").read_text(encoding="utf-8")
