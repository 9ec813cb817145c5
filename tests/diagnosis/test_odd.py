"""Single records that do not belong to the others are named, with the fault of their own if a fault explains them."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.dampers import load
from twintube.data import Record
from twintube.diagnosis.measurement.edges import with_edges, with_noise
from twintube.diagnosis.measurement.faults import Fault
from twintube.diagnosis.measurement.odd import odd_records
from twintube.diagnosis.measurement.zeros import zero_drift

ODD = 2  # the number of the record that is changed


@pytest.fixture(scope="module")
def good() -> list[Record]:
    return small.records(speeds=(0.1, 0.3, 0.6, 1.0, 1.3))


def judged(records: list[Record]) -> tuple[Fault | None, list[str]]:
    fault, rest = odd_records(with_edges(with_noise(small.problem(records))))
    return fault, [record.name for record in rest.records]


def changed(records: list[Record], change: Callable[[Record], Record]) -> list[Record]:
    return [change(r) if i == ODD else r for i, r in enumerate(records)]


def test_no_record_of_a_good_dataset_is_odd(good: list[Record]) -> None:
    assert judged(good) == (None, [r.name for r in good])


@pytest.mark.parametrize(
    ("kind", "value", "change"),
    [
        ("force_offset", 60.0, lambda r: replace(r, force=r.force + 60.0)),
        ("unit_error", 1000.0, lambda r: replace(r, force=1e-3 * r.force)),
    ],
)
def test_a_fault_of_a_single_file_is_named(
    good: list[Record], kind: str, value: float, change: Callable[[Record], Record]
) -> None:
    fault, rest = judged(changed(good, change))
    assert fault is not None
    assert (fault.effect, fault.records) == (kind, (good[ODD].name,))
    assert fault.factor == pytest.approx(value, rel=0.03)
    assert good[ODD].name in fault.explanation
    assert rest == [r.name for i, r in enumerate(good) if i != ODD]


@pytest.mark.parametrize(
    ("channel", "gain", "change"),
    [
        ("force", 1.3, lambda r: replace(r, force=1.3 * r.force)),
        ("stroke", 1.1, lambda r: replace(r, stroke=1.1 * r.stroke, velocity=1.1 * r.velocity)),
    ],
)
def test_a_single_file_of_another_gain_may_be_of_another_setting(
    good: list[Record], channel: str, gain: float, change: Callable[[Record], Record]
) -> None:
    fault, rest = judged(changed(good, change))
    assert fault is not None
    assert (fault.effect, fault.records, fault.channel) == ("odd_record", (good[ODD].name,), channel)
    assert fault.factor == pytest.approx(gain, abs=fault.spread)
    assert 0.0 < fault.spread < 0.1 * abs(gain - 1.0)
    assert f"its {channel} times {gain:g}" in fault.explanation
    assert rest == [r.name for i, r in enumerate(good) if i != ODD]


def test_a_record_of_another_preload_is_odd_however_its_zero_may_differ(good: list[Record]) -> None:
    """A damper with another gas force: nearly a constant, of which a zero takes most away, and a spring."""
    records = changed(good, lambda r: replace(r, force=r.force - 55.0 - 600.0 * r.stroke))
    problem, _ = zero_drift(with_edges(with_noise(small.problem(records))))
    fault, _ = odd_records(problem.with_drift(3.0))
    assert fault is not None and (fault.effect, fault.records) == ("odd_record", (good[ODD].name,))


def test_a_record_is_odd_by_its_gain_where_most_intervals_have_little_force(
    good: list[Record], monkeypatch: pytest.MonkeyPatch
) -> None:
    """As in a random motion: by its mean error it would belong to the others, and its gain would be named."""
    monkeypatch.setattr("twintube.diagnosis.measurement.odd.differ", lambda *_: False)
    fault, _ = judged(changed(good, lambda r: replace(r, force=1.1 * r.force)))
    assert fault is not None and fault.effect == "odd_record"


@pytest.mark.parametrize("stranger", ["another damper", "another fill"])
def test_a_record_of_something_else_is_named(good: list[Record], stranger: str) -> None:
    run = (
        small.run(0.6, damper=load("SA7", as_published=True))
        if stranger == "another damper"
        else small.run(0.6, small.DEGRADED)
    )
    other = replace(small.record(run), name="stray", oil_level=1.0, gas_preload=True)
    fault, rest = judged(changed(good, lambda _: other))
    assert fault is not None
    assert (fault.effect, fault.records) == ("odd_record", ("stray",))
    assert "stray does not belong" in fault.explanation
    assert "stray" not in rest


def test_little_makes_a_record_of_the_intact_damper_odd(good: list[Record]) -> None:
    """As of another damper: its force has no step that a fill would move. With less oil, foam may act in a single record."""

    def turned_up(r: Record) -> Record:
        return replace(r, force=r.force + 0.02 * abs(r.force).max() * (2.0 * abs(r.force / r.force.max()) - 1.0))

    fault, _ = judged(changed(good, turned_up))
    assert fault is not None and (fault.effect, fault.records) == ("odd_record", (good[ODD].name,))
    degraded = [small.record(small.run(speed, small.DEGRADED)) for speed in (0.3, 0.6, 1.0)]
    assert judged([*good, degraded[0], turned_up(degraded[1]), degraded[2]])[0] is None


def test_a_constant_of_all_records_without_their_gas_makes_none_of_them_odd(good: list[Record]) -> None:
    """Some gas may be left in these; where one of them lacks the constant, it is a zero of the others."""
    slow, medium, fast = [small.record(small.run(speed, small.DEGRADED)) for speed in (0.3, 0.6, 1.0)]
    shifted = [replace(r, force=r.force + 60.0) for r in (slow, medium)]
    assert judged([*good, *shifted])[0] is None
    fault, _ = judged([*good, *shifted, fast])
    assert fault is not None and (fault.effect, fault.records) == ("force_offset", tuple(r.name for r in shifted))


def test_what_is_wrong_in_most_records_makes_none_of_them_odd(good: list[Record]) -> None:
    assert judged([replace(r, force=1.3 * r.force) for r in good])[0] is None


def test_a_zero_of_a_good_load_cell_makes_no_slow_record_odd(good: list[Record]) -> None:
    """3 % of a slow record's own force are less than 0.5 % of the campaign's largest."""
    largest = max(abs(r.force).max() for r in good)
    slow = small.record(small.run(0.02), noise=0.001, seed=9)
    shifted = replace(slow, force=slow.force + 0.004 * largest)
    assert 0.004 * largest > 0.02 * abs(slow.force).max()
    assert judged([*good, shifted])[0] is None


def test_an_error_in_few_intervals_makes_no_odd_record(good: list[Record]) -> None:
    """A cause that moves a step may act in a single record."""
    degraded = [small.record(small.run(speed, small.DEGRADED)) for speed in (0.6, 1.0)]
    step = abs(degraded[0].time - degraded[0].time.mean()) < 0.02 * np.ptp(degraded[0].time)
    moved = replace(degraded[0], force=degraded[0].force + np.where(step, 0.5 * abs(degraded[0].force).max(), 0.0))
    assert judged([*good, moved, degraded[1]])[0] is None
    everywhere = replace(degraded[0], force=1.15 * degraded[0].force)
    fault, _ = judged([*good, everywhere, degraded[1]])
    assert fault is not None


def test_another_fill_of_a_single_record_is_named_with_its_size(good: list[Record]) -> None:
    """It moves a step of the force, in few intervals; a leak would have to lose a tenth of the oil at that velocity alone."""
    degraded = [small.record(small.run(speed, small.DEGRADED, slow=2)) for speed in (0.3, 0.6, 1.0)]
    other = replace(small.record(small.run(0.6, 0.45, slow=2)), name=degraded[1].name, oil_level=small.DEGRADED)
    fault, rest = judged([*good, degraded[0], other, degraded[2]])
    assert fault is not None
    assert (fault.effect, fault.name, fault.records) == ("odd_record", "oil_level", (other.name,))
    assert fault.factor == pytest.approx(0.45, abs=0.003)
    assert "as with 45 % oil, recorded with 56 %" in fault.explanation
    assert other.name not in rest
