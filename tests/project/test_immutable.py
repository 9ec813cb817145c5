"""What is shared cannot be changed: parameters, blocks, results."""

from dataclasses import FrozenInstanceError, fields
from typing import Any

import numpy as np
import pytest

from twintube import harmonic_block, load, simulate


def arrays_of(record: Any) -> dict[str, np.ndarray]:
    """The arrays of a dataclass by name."""
    values = {item.name: getattr(record, item.name) for item in fields(record)}
    return {name: value for name, value in values.items() if isinstance(value, np.ndarray)}


def test_parameters_are_frozen_and_their_curves_too() -> None:
    damper = load("SA8")
    with pytest.raises(FrozenInstanceError):
        damper.parameters.oil_level = 7.0  # type: ignore[misc]
    other = damper.with_(F_re=[2 * force for force in damper.parameters.F_re])
    assert isinstance(other.parameters.F_re, tuple)
    assert other.parameters.F_re[0] == 2 * damper.parameters.F_re[0]
    assert load("SA8").parameters == damper.parameters


def test_blocks_and_results_are_read_only() -> None:
    block = harmonic_block(1.048)
    result = simulate(load("SA8"), block.stroke, block.velocity, block.time)
    for record in (block, result):
        arrays = arrays_of(record)
        assert len(arrays) >= 4
        for name, array in arrays.items():
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 1
            assert not array.flags.writeable, name
    assert harmonic_block(1.048) is block


def test_the_caller_s_own_arrays_stay_his() -> None:
    stroke, velocity = np.zeros(3), np.zeros(3)
    result = simulate(load("SA8", as_published=True), stroke, velocity)
    stroke[0] = 1.0
    assert result.stroke[0] == 0.0
