"""A sign is turned only where the model, too, explains the record then; records in another unit are named among others."""

from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.diagnosis.measurement.faults import Fault, both_turned, really_turned, right_signs, scaled
from twintube.diagnosis.measurement.odd import odd_records


@pytest.fixture(scope="module")
def runs() -> list[small.Run]:
    return [small.run(speed, turns=8) for speed in (0.2, 0.3, 0.5, 0.7, 1.0)]


def test_a_sign_that_does_not_help_the_model_is_turned_back(runs: list[small.Run]) -> None:
    records = [small.record(r, seed=i) for i, r in enumerate(runs)]
    problem = small.problem(records)
    fault = Fault("sign_flip", "", "", -1.0, records=(records[0].name,))
    kept, same = really_turned(fault, problem)
    assert kept is fault
    assert np.array_equal(same.records[0].force, problem.records[0].force)
    wrong = problem.with_records([scaled(problem.records[0], -1.0, 1.0), *problem.records[1:]])
    dropped, back = really_turned(fault, wrong)
    assert dropped is None
    assert np.array_equal(back.records[0].force, problem.records[0].force)
    assert np.all(back.records[0].noise >= 0.0) and back.records[0].peak > 0.0


def test_a_record_in_another_unit_is_named_beside_others_that_are_not_quite_right(runs: list[small.Run]) -> None:
    records = [small.record(r, seed=i) for i, r in enumerate(runs)]
    records = [replace(r, force=r.force * (1.0 + 0.02 * i)) for i, r in enumerate(records)]  # no model is right within noise
    records[2] = replace(records[2], force=records[2].force / 9.80665)
    problem = small.problem(records)
    fault, others = odd_records(problem)
    assert fault is not None and len(others.records) == 4
    assert fault.records == (problem.records[2].name,)


def test_a_turned_stroke_is_told_from_a_turned_force(runs: list[small.Run]) -> None:
    records = [small.record(r, seed=i) for i, r in enumerate(runs)]
    problem = small.problem(records)
    names = tuple(record.name for record in problem.records)
    # The data door turns the forces of a record whose stroke has the other sign.
    door = problem.with_records([scaled(r, -1.0, -1.0) for r in problem.records])
    fault, right = really_turned(Fault("sign_flip", "", "The force channel", -1.0, records=names), door)
    assert fault is not None
    assert (fault.channel, fault.title) == ("stroke", "Sign of the stroke channel")
    assert "stroke channel" in fault.explanation
    for turned, record in zip(right.records, problem.records, strict=True):
        assert np.array_equal(turned.stroke, record.stroke) and np.array_equal(turned.force, record.force)
        assert turned.top_speed == record.top_speed


def test_a_record_whose_work_does_not_tell_its_sign_is_turned_with_the_others(runs: list[small.Run]) -> None:
    problem = small.problem([small.record(r, seed=i) for i, r in enumerate(runs)])
    silent, *others = problem.records
    door = problem.with_records([scaled(silent, -1.0, 1.0), *others])
    fault, right = really_turned(Fault("sign_flip", "", "", -1.0, records=tuple(r.name for r in others)), door)
    assert fault is not None and set(fault.records) == {r.name for r in problem.records}
    assert fault.explanation == "The force channel has the other sign."
    assert np.array_equal(right.records[0].force, silent.force)


@pytest.mark.parametrize("level", [small.INTACT, small.DEGRADED])
def test_both_channels_of_the_other_sign_are_named_and_put_right(level: float) -> None:
    several = [small.record(small.run(speed, level, turns=6), seed=i) for i, speed in enumerate((0.2, 0.5, 0.9))]
    problem = small.problem(several)
    assert both_turned(problem) == (None, problem)
    wrong = problem.with_records([scaled(r, -1.0, -1.0) for r in problem.records])
    fault, right = right_signs(None, wrong)
    assert fault is not None
    assert (fault.effect, fault.channel, set(fault.records)) == ("sign_flip", "both", {r.name for r in problem.records})
    for turned, record in zip(right.records, problem.records, strict=True):
        assert np.array_equal(turned.stroke, record.stroke) and np.array_equal(turned.force, record.force)


def test_only_records_whose_signs_differ_are_turned(runs: list[small.Run]) -> None:
    problem = small.problem([small.record(r, seed=i) for i, r in enumerate(runs)])
    first, *others = problem.records
    fault, _ = both_turned(problem.with_records([scaled(first, -1.0, -1.0), *others]))
    assert fault is not None and fault.records == (first.name,) and first.name in fault.explanation


def test_a_damper_without_gas_and_most_of_its_oil_is_not_called_turned() -> None:
    """Said to be intact: its forces are as unlike the model's with either sign."""
    runs = [small.run(speed, 0.3, turns=6) for speed in (0.3, 0.8)]
    records = [replace(small.record(r, seed=i), oil_level=1.0, gas_preload=True) for i, r in enumerate(runs)]
    assert both_turned(small.problem(records))[0] is None
