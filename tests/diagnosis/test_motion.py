"""The motion between the samples of a rig that turns within one of them."""

import numpy as np
from scipy.interpolate import CubicSpline

from twintube.diagnosis.measurement.motion import straight_sided

SPEED, REACH, RATE = 0.8, 0.04, 128.0  # [m/s], [m], [Hz]


def test_sides_are_straight_up_to_a_sharp_turn_and_slow_strokes_stay_smooth() -> None:
    time = np.arange(0.0, 12.0, 1.0 / RATE)
    slow = REACH * np.sin(2.0 * np.pi * 0.2 * time)
    way = SPEED * (time - 10.0) / REACH
    stroke = np.where(time < 10.0, slow, REACH * 2.0 / np.pi * np.arcsin(np.sin(np.pi / 2.0 * way)))
    smooth = CubicSpline(time, stroke)
    path = straight_sided(smooth)
    assert np.allclose(path(time), stroke, atol=1e-15), "through all samples"
    before = np.linspace(1.0, 9.0, 1000)
    assert np.array_equal(path(before, 1), smooth(before, 1))
    fast = np.linspace(10.2, 11.8, 5000)
    side = np.abs((SPEED * (fast - 10.0) / REACH) % 2.0 - 1.0) > 2.0 * SPEED / RATE / REACH  # two samples from a turn
    swings = [float(np.abs(np.abs(p(fast[side], 1)) - SPEED).max()) for p in (smooth, path)]
    assert swings[0] > 0.05
    assert swings[1] < 0.001


def test_a_sine_of_many_samples_has_no_sharp_turn() -> None:
    time = np.arange(0.0, 4.0, 1.0 / RATE)
    smooth = CubicSpline(time, REACH * np.sin(2.0 * np.pi * 3.0 * time))
    assert np.array_equal(straight_sided(smooth)(time[:-1] + 0.4 / RATE, 1), smooth(time[:-1] + 0.4 / RATE, 1))
