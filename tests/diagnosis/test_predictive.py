"""An answer explains the records one by one, or says which it does not."""

from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from tests.diagnosis.look_alikes import look_alikes
from twintube.common.arrays import Array
from twintube.dampers import load
from twintube.data import LoadedDataset, Record
from twintube.diagnosis import Answer, answer
from twintube.diagnosis.changes import UNKNOWN, Hypothesis
from twintube.diagnosis.contract import as_json
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.predictive import chance
from twintube.report.diagnosis.page import lines

SPEEDS = (0.3, 0.6, 1.0)  # [m/s]
GROOVE, WIDE = 0.01, 0.004  # [m]


@pytest.fixture(scope="module")
def good() -> list[Record]:
    return small.records(speeds=SPEEDS)


def answered(records: list[Record], effect: str = "valve_wear") -> Answer:
    dataset = LoadedDataset("Small", load("SA8", as_published=True), records, [])
    return answer(dataset, catalogue=look_alikes(effect))


def test_noise_has_any_chance_alike() -> None:
    rng = np.random.default_rng(1)
    several = np.array([chance(rng.standard_t(numbers().freedom, 500)) for _ in range(1000)])
    assert np.quantile(several, [0.1, 0.5, 0.9]) == pytest.approx([0.1, 0.5, 0.9], abs=0.05)
    assert chance(2.0 * rng.standard_t(numbers().freedom, 500)) < 1e-6


def test_single_intervals_are_named_with_their_times_and_change_no_answer(good: list[Record]) -> None:
    force = good[1].force.copy()
    force[[300, 700]] = 0.0
    force[500] += 2000.0
    found = answered([good[0], replace(good[1], force=force), good[2]])
    assert (found.verdict, found.changes and found.changes.hypotheses[0].name) == ("measurement_fault", "none")
    (fault,) = found.faults
    assert (fault.effect, fault.records) == ("dropouts", (good[1].name,))
    assert f"{good[1].time[500]:.2f}" in fault.explanation
    assert "drops out or spikes" in lines(found)[0]
    assert as_json(found)["causes"][0]["effect"] == "dropouts"


def test_a_step_at_another_moment_is_told_and_is_no_fault_of_the_channel() -> None:
    """In one oscillation of a damper without preload: where nothing else does so, no hypothesis has it."""
    records = small.records(speeds=SPEEDS, levels=(small.DEGRADED,))
    force = records[2].force.copy()
    at = len(force) // 2 + int(np.argmax(np.abs(np.diff(force[len(force) // 2 :]))))
    late = slice(at + 1, at + 4)
    force[late] = force[at]
    found = answered([*records[:2], replace(records[2], force=force)])
    assert found.faults == ()
    (remark,) = (x for x in found.remarks if "steps at another moment" in x)
    assert remark.startswith(f"{records[2].name} at {records[2].time[at]:.1f}"[:-1])


def with_a_groove(record: Record) -> Array:
    """The force of a piston that passes a worn place of the tube."""
    return np.where(np.abs(record.stroke - GROOVE) < WIDE, 0.6 * record.force, record.force)


def test_what_no_hypothesis_has_is_unexplained_with_the_record(good: list[Record]) -> None:
    found = answered([good[0], good[1], replace(good[2], force=with_a_groove(good[2]))])
    assert found.verdict == "unexplained"
    assert found.unexplained.startswith(f"{good[2].name}: ")
    assert found.extended is None
    assert as_json(found)["causes"] == []


def test_every_record_of_a_good_damper_is_explained_and_a_free_change_is_not_judged_by_them(good: list[Record]) -> None:
    found = answered(good)
    assert found.unlike == ()
    assert found.changes is not None
    several = (Hypothesis(UNKNOWN, UNKNOWN, 100.0, 1.0), *found.changes.hypotheses)
    assert replace(found, changes=replace(found.changes, hypotheses=several)).verdict == "unexplained"
