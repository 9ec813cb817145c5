"""Noise that was read too small does not repeat; an error of the model does."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from tests.diagnosis import small
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.measurement.edges import with_noise
from twintube.diagnosis.measurement.repeats import only_noise, repeating
from twintube.diagnosis.rules import RULES


def problem(wrong: float, scale: float) -> Problem:
    """A fluid force that is off by the share `wrong`, and noise that was read `scale` of what it is."""
    records = small.records(lambda r: r.force + wrong * r.fluid, (0.3, 0.6, 1.0), (small.INTACT,))
    read = with_noise(small.problem(records))
    return read.with_records([replace(r, noise=scale * r.noise) for r in read.records])


@pytest.mark.parametrize(("wrong", "scale", "noise"), [(0.0, 1.0, True), (0.0, 0.8, True), (0.01, 1.0, False)])
def test_an_error_repeats_and_noise_does_not(wrong: float, scale: float, noise: bool) -> None:
    """Of 1 % of the fluid force an error of 0.7 % of the largest force is left, 1.4 times the noise."""
    errors = problem(wrong, scale)
    assert only_noise(errors) == noise


def test_an_error_far_above_the_noise_is_none_of_it() -> None:
    assert not only_noise(problem(0.0, 0.5))


@pytest.mark.parametrize(("wrong", "noise"), [(0.0, True), (0.01, False)])
def test_without_like_oscillations_the_same_motion_shows_it(wrong: float, noise: bool) -> None:
    assert only_noise(without_oscillations(problem(wrong, 1.0))) == noise


def test_noise_with_memory_does_not_come_again_with_the_motion() -> None:
    """Much of it is in a neighbouring interval again, none where the same motion comes again."""
    errors = without_oscillations(problem(0.0, 1.0))
    rng = np.random.default_rng(3)
    for record in errors.records:
        noise = lfilter([1.0], [1.0, -0.8], rng.standard_normal(len(record.time)))
        assert noise[1:] @ noise[:-1] > 0.6 * noise @ noise
        assert abs(repeating(record, noise)) < 0.25 * np.mean(noise**2)
        assert repeating(record, record.velocity) > 0.9 * np.mean(record.velocity**2)


def test_short_records_without_like_oscillations_tell_nothing() -> None:
    errors = without_oscillations(problem(0.0, 1.0))
    few = [replace(r, judged=np.arange(len(r.time)) < 2 * RULES.motion_apart) for r in errors.records]
    assert not only_noise(errors.with_records(few))


def without_oscillations(errors: Problem) -> Problem:
    return errors.with_records([replace(r, cycle=np.full(len(r.cycle), -1)) for r in errors.records])
