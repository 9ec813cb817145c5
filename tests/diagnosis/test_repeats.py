"""Noise that was read too small does not repeat; an error of the model does."""

from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.measurement.edges import with_noise
from twintube.diagnosis.measurement.repeats import only_noise


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


def test_records_without_like_oscillations_tell_nothing() -> None:
    errors = problem(0.0, 1.0)
    assert not only_noise(errors.with_records([replace(r, cycle=np.full(len(r.cycle), -1)) for r in errors.records]))
