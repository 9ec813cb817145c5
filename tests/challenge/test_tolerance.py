"""What a bench leaves open hides what looks like it, and nothing else."""

from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest

from twintube.common.arrays import Array
from worlds.bench import faults
from worlds.bench.plan import rms
from worlds.challenge.catalogue import CAUSES
from worlds.challenge.generate import attempt, beyond_bench, runs_of, with_hidden
from worlds.challenge.oil import level_wrong
from worlds.challenge.plan import Bench, bench_for
from worlds.challenge.tolerance import FILL, GAIN, SHIFTS, ZERO, Tolerances, beyond, effects, late_samples, tolerances
from worlds.model.run import Run, Step, begun, copied, finished

TIME = np.linspace(0.0, 1.0, 500)
FORCES = [1000.0 * np.sin(2 * np.pi * f * TIME) for f in (3.0, 5.0)]


def late(samples: float) -> list[Array]:
    """What a delay changes."""
    return [np.interp(TIME - samples * TIME[1], TIME, F) - F for F in FORCES]


STRAIGHT = Tolerances([np.zeros(500), np.zeros(500)], FORCES, [late(shift) for shift in SHIFTS], 1000.0)


@pytest.mark.parametrize(
    "change",
    [
        [np.full(500, 0.9 * ZERO * 1000.0), np.full(500, -0.5 * ZERO * 1000.0)],
        [0.9 * GAIN * F for F in FORCES],
        late(0.45),
    ],
    ids=["a zero in each record", "a gain", "a delay"],
)
def test_what_a_channel_may_do_is_hidden(change: list[Array]) -> None:
    assert rms(beyond(change, STRAIGHT)) < 1e-3 * rms(change)
    more = beyond([3.0 * c for c in change], STRAIGHT)
    assert rms(more) > 1.5 * rms(change), "three times as much is not"


def test_what_no_channel_does_is_left_whole() -> None:
    change = [3.0 * np.sign(np.sin(2 * np.pi * 41.0 * TIME)) for _ in FORCES]
    assert rms(beyond(change, STRAIGHT)) == pytest.approx(rms(change), rel=0.01)


def test_steps_hide_what_happens_where_they_are() -> None:
    steps = np.where(TIME > 0.5, 20.0, 0.0)
    change = np.where(np.arange(500) % 2, 12.0, -12.0)
    rest = np.concatenate(beyond([change, change], replace(STRAIGHT, steps=[steps, steps])))
    early = np.tile(TIME <= 0.5, 2)
    assert rms([rest[~early]]) < 0.05 * rms([rest[early]])


def test_steps_that_a_part_of_a_sample_moves_to_the_next_are_hidden_by_that_part_alone() -> None:
    square = [np.where(np.sin(2 * np.pi * f * TIME + 0.1) > 0.0, 1000.0, -1000.0) for f in (3.0, 5.0)]
    fine = np.linspace(0.0, 1.0, 50 * 499 + 1)

    def moved(samples: float) -> list[Array]:
        several = [np.where(np.sin(2 * np.pi * f * fine + 0.1) > 0.0, 1000.0, -1000.0) for f in (3.0, 5.0)]
        return [np.interp(TIME - samples * TIME[1], fine, s) - np.interp(TIME, fine, s) for s in several]

    bench = Tolerances([np.zeros(500), np.zeros(500)], square, [moved(shift) for shift in SHIFTS], 1000.0)
    part, whole = moved(0.35), moved(1.5)
    assert rms(part) > 0.0 and rms(beyond(part, bench)) < 1e-3 * rms(part)
    assert rms(beyond(whole, bench)) > 0.5 * rms(whole)


@cache
def campaign() -> tuple[Bench, list[Run]]:
    for seed in range(20):
        bench = bench_for(frozenset({"degraded", "sine"}), False, np.random.default_rng(seed))
        if len(bench.records) <= 6:
            break
    bench = replace(bench, largest=2000.0)
    return bench, [finished(run) for run in runs_of(bench, 3.0)]


def test_a_fill_is_hidden_up_to_its_tolerance() -> None:
    bench, plain = campaign()
    open_ = tolerances(plain, bench)
    left = []
    for fill in (FILL, 30 * FILL):
        step = Step("setup", partial(level_wrong, x=fill, c={"sign": -1.0}))
        runs = [finished(begun(run.record, run.motion, bench.damper), [step]) for run in plain]
        changes = effects(runs, plain, bench)
        left.append(rms(beyond(changes, open_)) / rms(changes))
    assert left[0] < 1e-6 and left[1] > 0.3


def test_of_two_causes_the_lesser_decides() -> None:
    rng = np.random.default_rng(20)  # a campaign of six short records
    single = attempt([CAUSES["side_load_friction"].formulations[0]], None, rng)
    weak = replace(single.causes[0], strength=1e-6 * single.causes[0].strength)
    runs = with_hidden(single.plain, [single.causes[0].step, weak.step], single.bench)
    both = replace(single, causes=[*single.causes, weak], runs=runs)
    assert beyond_bench(single) > 0.0
    assert beyond_bench(both) < 1e-3 * beyond_bench(single)


@pytest.mark.parametrize("samples", [0.2, 1.7])
def test_a_delay_is_read_in_samples_of_the_bench(samples: float) -> None:
    bench, plain = campaign()
    delayed = [
        finished(copied(run), [Step("sensors", partial(faults.late, force=samples / bench.recorder.fs))]) for run in plain
    ]
    assert late_samples(delayed, plain, bench) == pytest.approx(
        samples, rel=0.1
    )  # a force that turns within the delay changes less
    assert late_samples(plain, plain, bench) == 0.0, "nothing is late"
