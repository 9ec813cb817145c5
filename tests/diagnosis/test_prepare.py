"""Records prepared for comparison: what noise is, what is compared, and what sampling leaves open."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.diagnosis import small
from twintube.common.arrays import Array
from twintube.data import Record
from twintube.diagnosis.measurement.edges import alone, with_edges, with_noise
from twintube.diagnosis.records.noise import averaging_noise, correlation, neighbour_noise, noise
from twintube.diagnosis.records.prepare import kicks, prepared
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.records.thinning import thin
from twintube.diagnosis.rules import RULES
from twintube.fitting.intervals import impulse

SIGMA = 4.0  # [N]


@pytest.fixture(scope="module")
def runs() -> list[small.Run]:
    return [small.run(speed, turns=10) for speed in (0.3, 1.0)]


def resampled(r: small.Run, per_turn: float, steep: float = 0.0, seed: int = 1) -> Record:
    """The run with `steep` [N] more at reversals and white noise, at `per_turn` samples per oscillation."""
    time = np.arange(0.0, r.time[-1], 2 * np.pi * small.AMPLITUDE / r.speed / per_turn)
    stroke, velocity, force = (r.at(x, time) for x in (r.stroke, r.velocity, r.force))
    force = force + steep * np.tanh(velocity / 1e-3) + SIGMA * np.random.default_rng(seed).standard_normal(len(time))
    return replace(
        small.record(r), time=time, stroke=stroke, velocity=velocity, force=force, usable=np.ones(len(time), dtype=bool)
    )


def per_sample(record: PreparedRecord) -> float:
    """Noise [N] of a single sample, from that of the intervals."""
    return float(np.sqrt(np.median(record.noise**2 * record.samples)))


def test_intervals_keep_the_impulse_of_the_force(runs: list[small.Run]) -> None:
    record = small.record(runs[0])
    ready = prepared(record, 0.1, 23.0)
    whole = impulse(record.time, record.force)
    assert len(ready.time) < len(record.time) / 2
    assert np.sum(np.diff(ready.time) * ready.force[1:]) == pytest.approx(whole[-1], rel=1e-9)
    assert ready.samples.sum() == len(record.time)


def test_noise_is_that_of_the_samples_wherever_they_lie_on_a_steep_force(runs: list[small.Run]) -> None:
    """The number of samples per oscillation is not whole: each oscillation is sampled at phases of its own."""
    sizes = {}
    for steep in (0.0, 300.0):
        problem = small.problem([resampled(r, 157.37, steep) for r in runs])
        sizes[steep] = [per_sample(record) for record in with_noise(problem).records]
        # The force itself does not repeat at these phases, only the model's errors do.
        assert all(per_sample(record) > 1.3 * SIGMA for record in problem.records)
    assert all(0.7 * SIGMA < size < 1.1 * SIGMA for size in (*sizes[0.0], *sizes[300.0]))
    assert sizes[300.0] == pytest.approx(sizes[0.0], rel=0.15)


def driven(stroke: Array, time: Array) -> tuple[Record, Array, np.ndarray]:
    """A record of a stroke (n,) [m] with dry friction alone, and the times of its intervals that a kick spoils."""
    velocity = np.gradient(stroke, time)
    record = Record(
        "driven", "driven.csv", "harmonic", 1.0, True, None, None, time, stroke, 100.0 * np.sign(velocity), velocity,
        "measured", None, (),
    )  # fmt: skip
    at = thin(record)[0]
    return record, time[at], kicks(record, at)


def test_a_change_of_speed_is_a_kick_and_a_triangle_is_none() -> None:
    """A triangle turns with equal speeds; a rig that changes its speed at once is not compared up to the next reversal."""
    time = np.linspace(0.0, 6.0, 3001)
    triangle = 0.045 * 2 / np.pi * np.arcsin(np.sin(2 * np.pi * time - np.pi / 2))
    record, _, spoilt = driven(triangle, time)
    assert not spoilt.any()
    assert prepared(record, 0.1, 23.0).judged.mean() > 0.95
    assert not driven(-0.045 * np.cos(2 * np.pi * time), time)[2].any()
    # A slow ramp to the middle, at 1 s a sine at full velocity, at 1.25 s its first reversal.
    kick = np.where(time < 1.0, 0.045 * (time - 1.0), 0.045 * np.sin(2 * np.pi * (time - 1.0)))
    record, ends, spoilt = driven(kick, time)
    assert 0.95 < ends[spoilt].min() <= 1.03
    assert 1.2 < ends[spoilt].max() <= 1.3
    assert not prepared(record, 0.1, 23.0).judged[spoilt].any()


def test_a_coarsely_sampled_sine_has_no_kicks() -> None:
    time = np.arange(0.0, 10.0, 0.05)
    assert not driven(-0.045 * np.cos(2 * np.pi * time), time)[2].any()


def test_what_another_moment_changes_is_open_at_a_step_and_not_on_a_slope() -> None:
    slope = 50.0 * np.abs(np.sin(np.linspace(0.0, 20.0, 400)))
    assert np.all(alone(slope) < 0.15 * slope.max())
    jumped = slope.copy()
    jumped[200:202] += 800.0  # a step lies in two intervals
    assert alone(jumped)[200:202] == pytest.approx(jumped[200:202] - slope[198], abs=15.0)
    assert np.array_equal(np.flatnonzero(alone(jumped) > 100.0), [200, 201])


def test_samples_that_are_not_usable_are_not_compared(runs: list[small.Run]) -> None:
    record = small.record(runs[0])
    usable = np.ones(len(record.time), dtype=bool)
    usable[500:520] = False
    ready = prepared(replace(record, usable=usable), 0.1, 23.0)
    inside = (ready.time >= record.time[500]) & (ready.time <= record.time[519])
    assert inside.any() and not ready.judged[inside].any()


def test_what_a_fill_leaves_open_at_a_jump_is_no_misfit() -> None:
    """The fill is off by as much as is known of it: the force jumps a bit earlier in every oscillation."""
    runs = [small.run(v, small.DEGRADED + RULES.open_level, slow=2) for v in (0.3, 0.6, 1.0)]
    records = [replace(small.record(r, noise=0.0), oil_level=small.DEGRADED) for r in runs]
    bare = with_noise(small.problem(records))
    known = with_edges(bare)
    missed = np.abs(bare.errors({})) > 0.01 * bare.spread(np.array([record.peak for record in bare.records]))
    assert (missed & (bare.weight > 0)).sum() > 5
    misfits = [p.misfits(p.residual({})) for p in (bare, known)]
    assert np.all(misfits[1] < misfits[0] / 2)
    assert misfits[1].max() < 1.5


def seen(force: Array, held: NDArray[np.int64]) -> tuple[float, float]:
    """Noise of a sample and correlation of neighbours, from all intervals."""
    calm = np.ones(len(force), dtype=bool)
    alike = correlation(force, held, calm, RULES.coloured_alone)
    return neighbour_noise(force, held, calm, alike), alike


def coloured(alike: float, seed: int, count: int = 1500) -> Array:
    """Noise of standard deviation 1 whose neighbours have a correlation."""
    fresh = np.random.default_rng(seed).standard_normal(count)
    noise = fresh.copy()
    for i in range(1, count):
        noise[i] = alike * noise[i - 1] + np.sqrt(1.0 - alike**2) * fresh[i]
    return noise


@pytest.mark.parametrize("alike", [0.0, 0.5, 0.8])
def test_noise_whose_neighbours_are_alike_is_not_taken_too_small(alike: float) -> None:
    """Of a random motion no oscillation repeats; its noise is seen from neighbours alone."""
    held = np.full(1500, 1000)
    several = [seen(coloured(alike, seed), held) for seed in range(12)]
    # By second differences alone it would be 0.6 at a correlation of 0.5, and 0.33 at 0.8.
    assert 0.75 < float(np.median([size * averaging_noise(held[:1], c)[0] for size, c in several])) < 1.25


def test_white_noise_beside_does_not_hide_the_colour() -> None:
    """A force channel with memory, and the rest of a stroke's noise: neighbours alone ask for too little noise."""
    held, sizes = np.full(1500, 3), []
    for seed in range(8):
        samples = coloured(0.85, seed, 4501)
        ends = np.arange(0, 4501, 3)
        sums = np.add.reduceat(samples[:-1], ends[:-1]) - 0.5 * samples[ends[:-1]] + 0.5 * samples[ends[1:]]
        means = sums / 3.0 + 0.3 * coloured(0.0, 100 + seed)
        size, c = seen(means, held)
        sizes.append(size * float(averaging_noise(held[:1], c)[0]) / float(np.std(means)))
    assert 0.8 < float(np.median(sizes)) < 1.15


@pytest.mark.parametrize("alike", [0.0, 0.3, 0.7])
@pytest.mark.parametrize("held", [(1, 1), (2, 2), (1, 5)])
def test_noise_of_means_of_few_samples_whose_ends_they_share(alike: float, held: tuple[int, int]) -> None:
    """As in a sweep at a low sampling rate, where intervals hold fewer and fewer samples."""
    counts = np.linspace(held[1], held[0], 1000).round().astype(int)
    ends = np.concatenate([[0], np.cumsum(counts)])
    sizes, weighted = [], []
    for seed in range(12):
        samples = coloured(alike, seed, int(ends[-1]) + 1)
        sums = np.add.reduceat(samples[:-1], ends[:-1]) - 0.5 * samples[ends[:-1]] + 0.5 * samples[ends[1:]]
        size, c = seen(sums / counts, counts)
        sizes.append(size)
        weighted.append(float(np.std(sums / counts / averaging_noise(counts, c) / size)))
    assert 0.8 < float(np.median(sizes)) < 1.25
    assert 0.85 < float(np.median(weighted)) < 1.15


@pytest.mark.parametrize("period", [20, 50, 100])
def test_an_error_of_the_model_is_not_taken_for_coloured_noise(period: int) -> None:
    error = 2.0 * np.sin(2 * np.pi * np.arange(1500) / period)
    held = np.full(1500, 1000)
    assert seen(coloured(0.0, 1) + error, held)[1] ** 1000 < 0.15
    assert seen(error, held)[1] == 0.0


def test_a_hum_is_not_taken_for_coloured_noise() -> None:
    """It comes again: what gains from interval to interval is small again some way apart."""
    hum = 5.0 * np.sin(2 * np.pi * 50.0 * np.arange(1500) / 400.0)
    alike = seen(hum + coloured(0.0, 4), np.ones(1500, dtype=np.int64))[1]
    assert alike == 0.0


def test_noise_is_no_larger_than_the_errors_it_is_seen_in() -> None:
    """Steps of a few intervals make neighbours differ, and look coloured; most errors are small."""
    error = 0.3 * coloured(0.0, 3)
    error[::6] += 20.0
    error[1::6] += 15.0
    held = np.full(1500, 10)
    size = seen(error * np.sqrt(9.5) / 10, held)[0]
    assert size < 1.6 * float(np.median(np.abs(error - np.median(error))))


@pytest.mark.parametrize("turns", [1, 8])
def test_noise_is_read_where_the_steps_of_the_model_leave_nothing_open(turns: int) -> None:
    """By neighbours, where no oscillation repeats, and by repeats."""
    (ready,) = small.problem([small.record(small.run(0.3, turns=turns, slow=2))]).records
    error = 0.5 * coloured(0.0, 5, len(ready.time))
    steps = np.arange(len(error)) % 12 < 6
    alone = noise(ready, error)
    error[steps] *= 20.0
    open_there = replace(ready, noise=alone, edges=np.where(steps, 10.0, 0.0))
    assert float(np.median(noise(ready, error))) > 2.0 * float(np.median(alone))
    assert float(np.median(noise(open_there, error))) < 1.3 * float(np.median(alone))


def test_rounding_is_no_larger_than_the_errors_that_hold_it() -> None:
    """Where the force moves through the steps of a coarse channel, their errors average out over an interval."""
    step = 20.0
    fine = small.record(small.run(0.3), noise=0.0)
    rounded = replace(fine, force=step * np.round(fine.force / step))
    problem = with_noise(small.problem([rounded]))
    (ready,) = problem.records
    assert ready.resolution == pytest.approx(step)
    error = problem.errors({})[ready.judged]
    assert float(np.median(ready.noise)) < 1.6 * float(np.std(error))
    assert float(np.std(error)) < step / np.sqrt(12.0)


def test_the_colour_of_noise_is_that_of_the_channel() -> None:
    """Of a record in which it does not show, too: a mean of many samples has more of it than of white noise."""
    several = [small.record(small.run(v, turns=6, slow=2), noise=0.0) for v in (0.3, 0.6, 1.0)]
    noisy = [replace(r, force=r.force + 5.0 * coloured(0.9, i, len(r.force))) for i, r in enumerate(several)]
    problem = with_noise(small.problem(noisy))
    assert len({record.colour for record in problem.records}) == 1
    assert problem.records[0].colour > 0.5
    slow = [problem.misfits(problem.residual({})).max(), with_noise(small.problem(several)).records[0].colour]
    assert slow[0] < 2.0 and slow[1] < 0.5
