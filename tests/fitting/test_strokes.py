"""Strokes lose their noise and nothing else."""

import numpy as np
import pytest
from scipy.signal import butter, lfilter, sawtooth

from twintube.common.arrays import Array
from twintube.fitting.strokes import noise, quiet, turns
from twintube.rig.signals import harmonic_block

NOISE = 2e-5  # [m]


def block(v: float = 0.262, dt: float = 1e-3) -> tuple[Array, Array]:
    signal = harmonic_block(v, 0.04, dt=dt)
    return signal.time, signal.stroke


def noisy(stroke: Array, seed: int = 0) -> Array:
    return stroke + np.random.default_rng(seed).normal(0.0, NOISE, len(stroke))


def reversals(stroke: Array) -> int:
    way = np.diff(stroke)
    return int(np.count_nonzero(np.diff(np.sign(way[way != 0.0]))))


@pytest.mark.parametrize("dt", [4e-4, 1e-3, 4e-3])
@pytest.mark.parametrize("v", [0.05, 0.524, 1.572])
def test_a_clean_stroke_stays(v: float, dt: float) -> None:
    time, stroke = block(v, dt)
    assert np.array_equal(quiet(time, stroke), stroke)
    rounded = np.round(stroke, 8)
    assert np.abs(quiet(time, rounded) - stroke).max() < 1e-6


def test_a_clean_stroke_with_uneven_times_stays() -> None:
    time = np.arange(0.0, 10.0, 1e-3) + np.random.default_rng(1).uniform(-1e-4, 1e-4, 10_000)
    stroke = 0.02 * np.sin(2 * np.pi * time)
    assert np.abs(quiet(time, stroke) - stroke).max() < 1e-6


@pytest.mark.parametrize("v", [0.05, 0.262, 0.524])
def test_white_noise_goes_and_no_reversal_of_it_is_left(v: float) -> None:
    time, stroke = block(v)
    result = quiet(time, noisy(stroke))
    assert noise(noisy(stroke))[0] == pytest.approx(NOISE, rel=0.05)
    assert np.sqrt(np.mean((result - stroke) ** 2)) < 0.25 * NOISE
    assert reversals(noisy(stroke)) > 10 * reversals(stroke)
    assert reversals(result) <= reversals(stroke) + 1


def test_a_sharp_reversal_keeps_its_time_and_size() -> None:
    """Ramps of 1 mm/s: a window blind to the corner would blunt it."""
    time = np.arange(0.0, 40.0, 1e-3)
    stroke = 4e-3 * sawtooth(2 * np.pi * time / 16.0, 0.5)
    result = quiet(time, noisy(stroke))
    at = turns(result, 1e-3)[1:-1]
    assert len(at) == 4
    assert time[at] == pytest.approx([8.0, 16.0, 24.0, 32.0], abs=2 * NOISE / 1e-3)
    assert np.abs(result[at]) == pytest.approx(4e-3, abs=1.5 * NOISE)


def test_the_result_does_not_depend_on_the_sign() -> None:
    time, stroke = block()
    np.testing.assert_allclose(-quiet(time, -noisy(stroke)), quiet(time, noisy(stroke)), rtol=0, atol=1e-12)


def test_a_vibration_that_goes_on_is_motion() -> None:
    """As large as the noise and so fast that any window would take it for noise."""
    time = np.arange(0.0, 20.0, 1e-2)
    stroke = 0.012 * np.sin(2 * np.pi * time) + NOISE * np.sin(2 * np.pi * 12.3 * time)
    result = quiet(time, noisy(stroke))
    assert np.sqrt(np.mean((result - stroke) ** 2)) < 0.6 * NOISE  # without the vibration at least 0.71


def test_the_levels_of_a_coarse_channel_are_no_vibration() -> None:
    """At a steady speed their error repeats; as a speed it would pass the thresholds of foam and cavitation."""
    time, level = np.arange(0.0, 20.0, 1 / 512), 4.2e-5
    steady = 0.0445 * (2 / np.pi) * np.arcsin(np.sin(2 * np.pi * time / 3.42))
    result = quiet(time, level * np.round(steady / level))
    inside = (np.abs(steady) < 0.035) & (time > 0.1) & (time < 19.9)
    speed = np.abs(np.gradient(result, time))[inside]
    assert speed == pytest.approx(0.05205, rel=0.02)
    assert np.std(result - steady) < 0.2 * level


def test_rests_at_a_single_level_do_not_hide_the_noise() -> None:
    """A coarse channel: at rest nothing changes, and most samples of some records are of rests."""
    level = 4e-5
    stroke = np.round(block(0.05, 3e-3)[1] / level) * level
    rest = np.full(2 * len(stroke), stroke[-1])
    alone, together = noise(stroke), noise(np.concatenate([stroke, rest]))
    assert alone[0] > 0.0 and together == pytest.approx(alone, rel=0.05)


def test_a_drive_sampled_too_coarsely_is_left_alone() -> None:
    rng = np.random.default_rng(3)
    time, stroke = np.arange(0.0, 20.0, 1e-2), rng.normal(0.0, 5e-3, 2000)
    assert np.array_equal(quiet(time, stroke), stroke)


def road(rate: float, servo: float, wheel: float = 0.12) -> Array:
    """The stroke [m] of a drive of 20 s on a rig of second order up to `servo` [Hz]: body and some `wheel` [1] on a road."""
    white = np.random.default_rng(0).standard_normal(int(20.0 * rate) + 1000)
    body, hop = (lfilter(*butter(1, [0.7 * f, 1.4 * f], "bandpass", fs=rate), white) for f in (1.3, 11.0))
    stroke = lfilter(*butter(2, servo, fs=rate), body / np.std(body) + wheel * hop / np.std(hop))[1000:]
    return np.asarray(0.02 * stroke / np.abs(stroke).max())


@pytest.mark.parametrize("rate", [200.0, 500.0, 1000.0])
@pytest.mark.parametrize("wheel", [0.02, 0.05, 0.12])
def test_a_drive_is_no_noise(rate: float, wheel: float) -> None:
    """Of a random motion differences level off, too, at distances at which it does not know itself any more.

    Behind slow strokes they are small in terms of the range.
    """
    drive, slow = road(rate, 30.0, wheel), 0.012 * np.sin(2 * np.pi * np.arange(0.0, 10.0, 1.0 / rate) / 5.0)
    for stroke in (drive, np.concatenate([slow, 0.25 * (drive - drive[0])])):
        assert np.array_equal(quiet(np.arange(len(stroke)) / rate, stroke), stroke)


@pytest.mark.parametrize(("servo", "size"), [(20.0, 1e-6), (30.0, 3e-6), (30.0, 1e-5)])
def test_noise_of_a_drive_is_seen_though_the_motion_follows_close(servo: float, size: float) -> None:
    stroke = road(1000.0, servo)
    white = np.random.default_rng(5).normal(0.0, size, len(stroke))
    assert noise(stroke + white) == (pytest.approx(size, rel=0.1), 1)
    left = quiet(np.arange(len(stroke)) / 1000.0, stroke + white) - stroke
    assert np.std(np.diff(left)) < 0.7 * np.std(np.diff(white))


def test_few_samples_are_left_alone() -> None:
    time = np.arange(5.0)
    assert np.array_equal(quiet(time, time), time)
