"""The interpreter and the library run the same source: same bits."""

import numpy as np
import pytest

from tests.eight import EIGHT
from twintube.dampers import load
from twintube.engine.simulate import simulate
from twintube.rig.signals import harmonic_block


@pytest.mark.parametrize("name", EIGHT)
def test_interpreted_and_compiled_agree_to_the_bit(name: str) -> None:
    damper = load(name, as_published=True)
    block = harmonic_block(1.572, dt=2e-3)
    for level in damper.measured_levels:
        state = damper.with_(oil_level=level, gas_preload=0, delta_D=1.3)
        fast = simulate(state, block.stroke, block.velocity)
        slow = simulate(state, block.stroke, block.velocity, interpreted=True)
        for column, values in fast.columns.items():
            assert np.array_equal(values, slow.columns[column], equal_nan=True), column
