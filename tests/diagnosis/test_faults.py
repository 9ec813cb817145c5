"""Faults that are put right before anything is fitted: a turned sign, of all files or of some, and a wrong unit."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.dampers import load
from twintube.data import DataError, Record
from twintube.diagnosis.measurement.faults import read, unit_error
from twintube.engine.simulate import simulate


@pytest.fixture(scope="module")
def good() -> list[Record]:
    return small.records()


@pytest.mark.parametrize("turned", [(), (1,), (0, 2), (0, 1, 2, 3)])
def test_forces_of_the_other_sign_are_turned_file_by_file(
    good: list[Record], tmp_path: Path, turned: tuple[int, ...]
) -> None:
    records = [replace(r, force=-r.force) if i in turned else r for i, r in enumerate(good)]
    data, fault = read(small.write(records, tmp_path))
    by_name = {record.name: record for record in data.records}
    for record in good:
        np.testing.assert_allclose(by_name[record.name].force, record.force, rtol=0, atol=1e-3)
    assert (fault is not None) == bool(turned)
    if fault is not None:
        assert (fault.effect, fault.factor) == ("sign_flip", -1.0)
        assert set(fault.records) == {good[i].name for i in turned}
        assert all((good[i].name in fault.explanation) == (len(turned) < len(good)) for i in turned)


def test_a_file_with_another_defect_is_not_read_by_turning_it(good: list[Record], tmp_path: Path) -> None:
    folder = small.write([replace(good[0], force=-good[0].force), *good[1:]], tmp_path)
    (folder / good[1].file).write_text("time [s],stroke [mm]\n0,0\n")
    with pytest.raises(DataError, match=good[1].file):
        read(folder)


@pytest.mark.parametrize("count", [1, None], ids=["a file", "all files"])
def test_forces_too_small_for_newtons_are_read_as_kilonewtons(good: list[Record], tmp_path: Path, count: int | None) -> None:
    several = [replace(r, force=1e-3 * r.force) for r in good[:count]]
    data, fault = read(small.write([*several, *good[len(several) :]], tmp_path))
    assert fault is not None and (fault.effect, fault.factor) == ("unit_error", 1e3)
    assert set(fault.records) == {r.name for r in several}
    forces = {r.name: r.force for r in data.records}
    assert all(np.abs(forces[r.name] - r.force).max() < 1e-3 * np.abs(r.force).max() for r in good)


def test_a_channel_of_noise_is_no_kilonewton(good: list[Record], tmp_path: Path) -> None:
    noise = np.random.default_rng(3).normal(0.0, 0.5, len(good[0].force))
    with pytest.raises(DataError, match="it does not move"):
        read(small.write([replace(good[0], force=noise), *good[1:]], tmp_path))


@pytest.mark.parametrize(("factor", "unit"), [(1e-3, "kN for N"), (1 / 4.4482216, "lbf for N")])
def test_a_wrong_unit_of_the_force_is_named_and_put_right(good: list[Record], factor: float, unit: str) -> None:
    fault, right = unit_error(small.problem([replace(r, force=factor * r.force) for r in good]))
    assert fault is not None
    assert (fault.effect, fault.title) == ("unit_error", f"Unit of the force: {unit}")
    assert fault.factor == pytest.approx(1 / factor)
    assert right.measured == pytest.approx(small.problem(good).measured)


def test_a_calibration_is_no_wrong_unit(good: list[Record]) -> None:
    for gain in (0.7, 1.0, 1.4):
        problem = small.problem([replace(r, force=gain * r.force) for r in good])
        assert unit_error(problem) == (None, problem)
    stroke = [replace(r, stroke=1.05 * r.stroke, velocity=1.05 * r.velocity) for r in good]
    assert unit_error(small.problem(stroke))[0] is None
    assert np.isfinite(small.problem(stroke).measured).all()


@pytest.mark.parametrize("count", [2, 3])
def test_most_records_in_another_unit_are_put_right(good: list[Record], count: int) -> None:
    """Too many to be odd records, and too few for the channel: a rig whose display was switched during the campaign."""
    pounds = [replace(r, force=r.force / 4.4482216) for r in good[:count]]
    fault, right = unit_error(small.problem([*pounds, *good[count:]]))
    assert fault is not None and (fault.effect, fault.title) == ("unit_error", "Unit of the force: lbf for N")
    assert fault.records == tuple(r.name for r in pounds)
    true = small.problem(good)
    assert right.measured == pytest.approx(true.measured)


def test_inches_of_some_files_are_known_though_the_others_would_leave_the_tube(good: list[Record]) -> None:
    some = [replace(r, stroke=r.stroke / 25.4) for r in good[:2]]
    fault, right = unit_error(small.problem([*some, *good[2:]]))
    assert fault is not None and (fault.title, fault.channel) == ("Unit of the stroke: in for mm", "stroke")
    assert fault.records == tuple(r.name for r in some)
    assert max(np.abs(r.stroke).max() for r in right.records) == pytest.approx(
        max(np.abs(r.stroke).max() for r in good), rel=0.01
    )


def test_a_damper_that_lost_most_of_its_force_holds_no_other_unit(good: list[Record]) -> None:
    weak = [replace(r, force=0.4 * r.force) for r in good[:2]]
    assert unit_error(small.problem([*weak, *good[2:]]))[0] is None


def test_strokes_like_those_of_the_other_files_are_in_their_unit(good: list[Record]) -> None:
    """Of a damper that lost its oil a tenth of the stroke explains what force is left, but the rig moved as before."""
    left = [
        replace(r, force=simulate(load("SA8", as_published=True), 0.1 * r.stroke, 0.1 * r.velocity, r.time).force)
        for r in good[:2]
    ]
    assert unit_error(small.problem([*left, *good[2:]]))[0] is None


def test_a_record_that_no_unit_explains_holds_no_other_unit(good: list[Record]) -> None:
    """Of a damper that ran dry in one record a tenth of the force is nearer to what is left, and explains nothing."""
    dry = np.random.default_rng(2).normal(0.0, 0.01 * np.abs(good[1].force).max(), len(good[1].force))
    problem = small.problem([good[0], replace(good[1], force=dry), *good[2:]])
    assert unit_error(problem) == (None, problem)
