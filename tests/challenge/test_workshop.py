"""The workshop: each case once in a block of seeds, strengths of practice that show, and folders in every format."""

from collections import Counter
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from twintube.dampers import load
from twintube.data import load_dataset
from worlds.bench.files import LAYOUTS
from worlds.bench.plan import Record
from worlds.challenge import workshop
from worlds.challenge.generate import Hidden, logged, needs
from worlds.challenge.plan import Bench, Order, bench_for, motion
from worlds.challenge.practice import CASES, NOTHING, PRACTICE, SINGLES, case_of, formulation, strength
from worlds.model.run import Run, begun, copied, finished, sampled

DAMPER = load("SA8", as_published=True)


@cache
def plain(level: float) -> Run:
    order = Order("amplitude", 1.31, 0.045, 0.05, 2, 5.0, 0.0, False, 3, 1)
    return finished(begun(Record("r", 0, "harmonic", level, level == 1.0, 23.0, 0.0), motion(order, 1e-3, 3.0), DAMPER))


@cache
def some_bench(asked: frozenset[str] = frozenset({"degraded", "sine"})) -> Bench:
    return replace(bench_for(asked, False, np.random.default_rng(4)), largest=2000.0)


def run(cause: str, name: str, level: float, x: float | None = None, **constants: object) -> Run:
    item, rng = formulation(cause, name), np.random.default_rng(1)
    size = strength(rng, some_bench(), cause, name) if x is None else x
    step = Hidden(item, size, {**item.draw(rng, some_bench()), "carried": False, "file": 0, "state": 0.5, **constants}).step
    base = plain(level)
    return finished(begun(base.record, base.motion, DAMPER) if item.stage == "setup" else copied(base), [step])


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def work(some: Run) -> float:
    """Energy [J] that the damper takes up."""
    return float(np.trapezoid(some.force * some.parts["velocity"], some.time))


def test_of_a_block_of_seeds_every_case_is_hidden_once() -> None:
    every, n = Counter(CASES), len(CASES)
    assert every[()] == NOTHING
    for first in (1, 1 + n):
        assert Counter(case_of(seed) for seed in range(first, first + n)) == every
    assert [case_of(seed) for seed in range(1, 1 + n)] != [case_of(seed) for seed in range(1 + n, 1 + 2 * n)]


@pytest.mark.parametrize(("cause", "name"), [case[0] for case in SINGLES], ids=lambda word: word)
def test_every_strength_of_practice_shows(cause: str, name: str) -> None:
    change = 0.0
    for level in (0.5, 1.0):
        told = run(cause, name, level)
        assert np.isfinite(told.force).all()
        change += rms(told.force - plain(level).force) + 1e6 * rms(told.stroke - plain(level).stroke)
        change += (told.unit != (1.0, 1.0)) + (told.stretch != 1.0) + (told.force_time is not None)
    assert change > 0.5


def test_all_names_are_of_a_cause_of_their_own() -> None:
    assert {cause for case in CASES for cause, _ in case} == set(PRACTICE)
    assert all(needs([formulation(*part)]) is not None for case in CASES for part in case)


def test_a_warm_damper_does_less_work_and_its_gas_presses_more() -> None:
    warm = run("oil_temperature", "warm", 1.0, 30.0)
    assert work(warm) < 0.998 * work(plain(1.0))
    assert np.mean(warm.parts["gas"]) / np.mean(plain(1.0).parts["gas"]) == pytest.approx(1.0 + 30.0 / 296.15)


def test_a_clamp_pulls_with_its_acceleration_and_takes_no_work() -> None:
    base, loose = plain(1.0), run("clamp_inertia", "clamp", 1.0, 4.0)
    pull = loose.force - base.force
    assert pull == pytest.approx(4.0 * np.gradient(base.motion.velocity, base.time))
    assert abs(np.trapezoid(pull * base.motion.velocity, base.time)) < 1e-3 * work(base)


def test_a_wrong_rate_is_in_the_times_of_all_channels() -> None:
    fast, bench = run("time_base", "header", 1.0, 0.05, sign=1.0), some_bench()
    told = [
        logged(sampled(r, bench.recorder), r, bench, sigma=1.0, step=0.1, rng=np.random.default_rng(1))
        for r in (plain(1.0), fast)
    ]
    assert told[1]["time [s]"] == pytest.approx(1.05 * told[0]["time [s]"])
    assert np.array_equal(told[1]["force [N]"], told[0]["force [N]"])


@pytest.mark.slow  # campaigns at full rate
def test_a_dataset_is_readable_and_repeats(tmp_path: Path) -> None:
    seed = next(seed for seed in range(1, 60) if case_of(seed) == (("force_offset", "all"),))
    truths = [workshop(seed, tmp_path / name) for name in "ab"]
    assert truths[0] == truths[1] and truths[0]["causes"] == ["force_offset"] and truths[0]["format"] in LAYOUTS
    for file in (tmp_path / "a" / "dataset").iterdir():
        assert file.read_bytes() == (tmp_path / "b" / "dataset" / file.name).read_bytes()
    assert all(np.ptp(record.stroke) > 0.01 for record in load_dataset(tmp_path / "a" / "dataset").records)
