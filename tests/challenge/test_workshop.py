"""Datasets of the workshop: a strength of nothing does nothing, causes have their signs, and the folder is readable."""

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from twintube.dampers import load
from twintube.data import load_dataset
from twintube.engine.simulate import simulate
from worlds.bench.motions import joined, swing
from worlds.bench.plan import Motion, Record
from worlds.model.march import Mount
from worlds.model.run import Run, Step, begun, finished
from worlds.workshop import write
from worlds.workshop.catalogue import CASES, case_of
from worlds.workshop.plan import Wish, plan_day
from worlds.workshop.sizes import SIZES

DAMPER = load("SA8", as_published=True)
DT = 1.0 / 4000.0
MOTION = joined([swing(0.05, 0.04, 1, DT), swing(0.786, 0.04, 4, DT)])


FAST = joined([swing(0.05, 0.04, 1, DT), swing(1.31, 0.04, 4, DT)])


def run(key: str, fill: float = 0.5, motion: Motion = MOTION, **values: Any) -> Run:
    steps = SIZES[key].steps(values) if key else []
    return finished(begun(Record("r", 0, "harmonic", fill, fill == 1.0, 20.0, 0.0), motion, DAMPER), steps)


PLAIN = {(level, id(motion)): run("", level, motion) for level in (0.5, 1.0) for motion in (MOTION, FAST)}


def plain(level: float, motion: Motion = MOTION) -> Run:
    return PLAIN[level, id(motion)]


def rms(values: object) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def work(some: Run) -> float:
    """Energy [J] that the damper takes up."""
    return float(np.trapezoid(some.force * some.parts["velocity"], some.time))


def test_nothing_hidden_is_the_models_force() -> None:
    model = simulate(DAMPER.with_(oil_level=0.5, gas_preload=0), MOTION.stroke, MOTION.velocity, MOTION.time)
    assert np.array_equal(plain(0.5).force, np.asarray(model.force))


NOTHING: dict[str, dict[str, Any]] = {
    "warm_oil": {"kelvin": 0.0}, "oil_column": {"stiffness": 1e12}, "late_valves": {"stroke": 1e-12},
    "mixing": {"length": 1e-12}, "scale": {"rebound": 0.0, "compression": 0.0}, "bleed": {"rebound": 0.0, "compression": 0.0},
    "preload": {"ratio": 1.0}, "residual": {"pressure": 0.0, "exponent": 1.0}, "play": {"play": 0.0},
    "rubber_stop": {"onset": 0.05, "at_10mm": 1e3, "power": 1.5}, "side_load": {"extra": 0.0}, "all_levels": {"shift": 0.0},
    "bent_rod": {"extra": 0.0, "overhang": 0.1}, "foam_front": {"front": 0.0}, "dissolving": {"rate": 0.0}, "film": {},
    "offset": {}, "delay": {},
}  # fmt: skip


@pytest.mark.parametrize("key", NOTHING)
def test_a_strength_of_nothing_does_nothing(key: str) -> None:
    for level in (0.5, 1.0):
        assert rms(run(key, level, **NOTHING[key]).force - plain(level).force) < 1e-5 * rms(plain(level).force)


def test_a_hard_mount_is_none() -> None:
    hard = finished(begun(plain(0.5).record, MOTION, DAMPER), [Step("setup", lambda r: setattr(r, "mount", Mount(1e12)))])
    assert rms(hard.force - plain(0.5).force) < 1e-3 * rms(plain(0.5).force)


def test_causes_have_their_signs() -> None:
    """Less work with warm oil and worn valves, more with friction; more gas pushes the rod out."""
    for level in (0.5, 1.0):
        some: list[tuple[str, dict[str, float]]] = [
            ("warm_oil", {"kelvin": 30.0}), ("scale", {"rebound": 0.2, "compression": 0.0}),
            ("bleed", {"rebound": 0.1, "compression": 0.0}), ("heating", {"capacity": 100.0, "cooling": 200.0}),
        ]  # fmt: skip
        some += [("late_valves", {"stroke": 8e-3})] if level == 1.0 else []  # without oil there is no force at the reversal
        for key, values in some:
            assert work(run(key, level, **values)) < 0.998 * work(plain(level)), key
        for key, values in (("side_load", {"extra": 100.0}), ("bent_rod", {"extra": 100.0, "overhang": 0.2})):
            assert work(run(key, level, **values)) > 1.005 * work(plain(level)), key
    assert np.mean(run("preload", 1.0, ratio=1.6).force) < np.mean(plain(1.0).force) - 10.0
    assert np.mean(run("residual", pressure=2e5, exponent=1.2).force) < np.mean(plain(0.5).force) - 10.0


def test_oil_decides_the_work() -> None:
    assert work(run("all_levels", shift=0.06)) > work(plain(0.5))
    assert work(run("film", film=2e-6)) < work(plain(0.5))
    assert work(run("tilted", height=0.01)) != work(plain(0.5))


def test_a_leak_is_carried_to_the_next_record_of_a_state() -> None:
    steps = SIZES["film"].steps({"film": 2e-6})
    records = [Record(str(i), i, "harmonic", 1.0, True, 20.0, 20.0 * i) for i in range(2)]
    first, second = (finished(begun(record, MOTION, DAMPER), steps) for record in records)
    assert first.damper.parameters.oil_level == 1.0
    lost = 2e-6 * np.abs(np.diff(MOTION.stroke)).sum() / DAMPER.parameters.V_oil
    assert 1.0 - second.damper.parameters.oil_level == pytest.approx(lost, rel=0.1)


def test_an_oil_column_is_late_a_stop_at_the_end_and_play_leaves_the_damper_behind() -> None:
    late = run("oil_column", 1.0, stiffness=4e5)
    assert work(late) < work(plain(1.0))
    stop = run("rubber_stop", onset=0.035, at_10mm=2000.0, power=1.5)
    touched = np.abs(stop.force - plain(0.5).force) > 1.0
    assert touched.any() and stop.stroke[touched].min() > 0.035
    loose = run("play", play=1e-3)
    assert np.abs(loose.stroke - loose.parts["stroke"]).max() == pytest.approx(0.5e-3, rel=0.05)
    assert np.mean(loose.force == 0.0) > 0.02


def test_of_sixty_seeds_every_case_is_hidden_once() -> None:
    every = Counter((case.kind, case.keys) for case in CASES)
    assert len(CASES) == 60
    for first in (1, 61):
        assert Counter((case.kind, case.keys) for case in map(case_of, range(first, first + 60))) == every
    assert [case_of(seed).keys for seed in range(1, 61)] != [case_of(seed).keys for seed in range(61, 121)]


def test_every_strength_of_practice_changes_a_channel() -> None:
    assert {key for case in CASES for key in case.keys} == set(SIZES)
    day, draw = plan_day(1, Wish(states=2, low=True, wide=True)), np.random.default_rng(1)
    for key, size in SIZES.items():
        values = size.draw(draw, day) | ({"record": 1} if key == "odd" else {"level": 0.5} if key == "one_level" else {})
        values |= {"onset": 0.035} if key in ("rubber_stop", "foam_bump") else {}
        runs = [run(key, level, FAST, **values) for level in (0.5, 1.0)]
        assert all(np.isfinite(some.force).all() for some in runs), key
        change = sum(rms(some.force - plain(level, FAST).force) for some, level in zip(runs, (0.5, 1.0), strict=True))
        stretched = runs[0].stretch != 1.0 or not np.array_equal(runs[0].stroke, FAST.stroke)
        assert change > 0.01 or stretched, key


def test_a_dataset_is_readable_and_repeats(tmp_path: Path) -> None:
    truths = [write(7, tmp_path / name) for name in "ab"]
    assert truths[0] == truths[1] and truths[0]["causes"] == list(case_of(7).causes)
    for file in (tmp_path / "a" / "dataset").iterdir():
        assert file.read_bytes() == (tmp_path / "b" / "dataset" / file.name).read_bytes()
    dataset = load_dataset(tmp_path / "a" / "dataset")
    assert all(np.ptp(record.stroke) > 0.01 for record in dataset.records)
