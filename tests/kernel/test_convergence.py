"""The result converges as the step shrinks."""

import numpy as np
import pytest

from tests.eight import EIGHT
from twintube.dampers import load
from twintube.engine.simulate import work_between
from twintube.rig.signals import harmonic_block

LEVELS = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)


@pytest.mark.parametrize("name", EIGHT)
@pytest.mark.parametrize("velocity", [0.05, 0.131, 0.524, 1.048, 1.572, 2.0])
def test_steps_of_1_and_a_tenth_of_a_millisecond_agree_in_work(name: str, velocity: float) -> None:
    coarse, fine = harmonic_block(velocity, dt=1e-3), harmonic_block(velocity, dt=1e-4)
    for level in LEVELS:
        state = load(name, as_published=True).with_(oil_level=level, gas_preload=0)
        a = work_between(state, coarse.stroke, coarse.velocity, coarse.marks)
        b = work_between(state, fine.stroke, fine.velocity, fine.marks)
        assert np.all(np.abs(a / b - 1) <= 0.01), level


def observed_order(name: str, level: float, velocity: float) -> float:
    """Order of convergence of the work per oscillation, from steps of 4, 2, 1, 0.5 ms against 0.02 ms."""
    state = load(name, as_published=True).with_(oil_level=level, gas_preload=0)
    steps = np.array([4e-3, 2e-3, 1e-3, 5e-4])
    exact_block = harmonic_block(velocity, dt=2e-5)
    exact = work_between(state, exact_block.stroke, exact_block.velocity, exact_block.marks)
    errors = []
    for dt in steps:
        block = harmonic_block(velocity, dt=float(dt))
        errors.append(np.abs(work_between(state, block.stroke, block.velocity, block.marks) / exact - 1).mean())
    return float(np.polyfit(np.log(steps), np.log(errors), 1)[0])


def test_work_converges_with_second_order() -> None:
    """The split makes volumes exact within a step; what is left is the trapezoid of force and thresholds."""
    orders = [observed_order(name, level, 1.572) for name in ("SA1", "SA3", "SA8") for level in (0.5, 0.9)]
    assert np.mean(orders) > 1.7
    assert min(orders) > 1.3
