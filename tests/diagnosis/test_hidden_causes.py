"""Without a reference: what the model lacks is among what is named, and nothing is named where nothing is hidden."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.diagnosis import small
from twintube import diagnose
from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.diagnosis import answer
from twintube.diagnosis.base import Base
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.changes import mechanisms
from twintube.diagnosis.contract import as_json
from twintube.diagnosis.fills import as_filled
from twintube.diagnosis.put_right import put_right
from twintube.diagnosis.questions import bench_of
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.search import Search
from twintube.report.diagnosis.page import lines, page

SPEEDS = (0.3, 0.6, 1.0)  # [m/s]


def moved_zero(r: small.Run) -> Array:
    """Not towards that of a load cell that was set to zero with the damper in it."""
    return r.force - 80.0


def heavy_clamp(r: small.Run) -> Array:
    return np.asarray(r.force + 4.0 * np.gradient(r.velocity, r.time))


def search_in(bench: Bench) -> Search:
    """The search in the fill as stated."""
    fill = as_filled(bench, "as_stated")
    return Base(bench, np.ones(len(bench.z), dtype=bool), fill).search(fill)


HIDDEN: dict[str, small.Formula] = {
    "force_offset": moved_zero,
    "clamp_inertia": heavy_clamp,
}
# By default a zero is found since a reference, in test_changes.py, and in a small catalogue, in test_heavy.py.
CAUSES = [pytest.param("force_offset", marks=pytest.mark.slow), "clamp_inertia"]


@pytest.mark.parametrize("cause", CAUSES)
def test_a_hidden_cause_is_among_what_is_named(cause: str) -> None:
    records = small.records(HIDDEN[cause], SPEEDS)
    found = answer(LoadedDataset("Small", load("SA8", as_published=True), records, []))
    assert cause in {h.name for h in found.named}
    assert found.verdict != "none"


def test_nothing_is_named_where_nothing_is_hidden() -> None:
    found = answer(LoadedDataset("Small", load("SA8", as_published=True), small.records(speeds=SPEEDS), []))
    assert found.verdict == "none"
    assert found.extended is None
    budget = found.budget()
    assert budget is not None
    assert not [line.name for line in budget.lines if line.finding and line.force > budget.noise]


def test_a_delay_that_suits_no_cause_is_not_held_against_one() -> None:
    """A stop makes the force look late; with the cause beside it, the same delay is not there."""
    damper = load("SA8", as_published=True)
    stopped = damper.with_(F_stop_co=300.0, onset_co=0.037)
    runs = [small.run(speed, damper=stopped) for speed in (0.3, 1.0)]
    records = [small.record(r, seed=i) for i, r in enumerate(runs)]
    measured = put_right(LoadedDataset("Small", damper, records, []), None, lambda step: None)
    assert measured.problem.usual["channel_delay"] > 1e-3
    bench = bench_of(measured, records)
    (stop,) = (m for m in mechanisms(bench) if m.way == "compression")
    found = search_in(bench).again(search_in(bench).found(stop))
    assert found.values["F_stop_co"] == pytest.approx(300.0, rel=0.05)


def test_a_cause_far_larger_than_expected_is_found() -> None:
    """A clock that is wrong by five of its standard deviations: at the end of a record the force is half a stroke late."""
    damper = load("SA8", as_published=True)
    runs = [small.run(speed, turns=30) for speed in (0.6, 1.0)]
    late = [np.interp(0.995 * r.time, r.time, r.force) for r in runs]
    records = [small.record(r, force, seed=i) for i, (r, force) in enumerate(zip(runs, late, strict=True))]
    bench = Bench(damper, prepare(LoadedDataset("Small", damper, records, [])))
    (clock,) = (m for m in mechanisms(bench) if m.way == "clock_error")
    search = search_in(bench)
    found = search.again(search.found(clock))
    assert found.log_z > search.none.log_z + 100.0
    assert found.values["clock_error"] == pytest.approx(0.005, rel=0.02)


def test_a_wrong_unit_is_put_right_and_told(tmp_path: Path) -> None:
    """The whole way from files: kN where the file says N."""
    records = [replace(r, force=1e-3 * r.force) for r in small.records(speeds=SPEEDS)]
    found = diagnose(small.write(records, tmp_path / "bench"), catalogue=["force_gain", "valve_wear"])
    assert found.verdict == "measurement_fault"
    assert [(fault.effect, fault.factor) for fault in found.faults] == [("unit_error", 1000.0)]
    assert as_json(found)["credible_set"][0] == "unit_error"
    assert any("kN for N" in line for line in lines(found))
    page(found).write(tmp_path)
    assert "kN for N" in (tmp_path / "report.html").read_text(encoding="utf-8")
