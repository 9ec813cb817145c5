"""Cycles of a stroke, in a record that is not yet known to be sound."""

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array


def cycle_starts(stroke: Array) -> NDArray[np.int64]:
    """Samples at which the stroke rises through the middle of its range, each after a way down below a tenth of it."""
    middle, half = (stroke.max() + stroke.min()) / 2, float(np.ptp(stroke)) / 2
    side = np.where(stroke > middle, 1, np.where(stroke < middle - 0.1 * half, -1, 0))
    known = np.flatnonzero(side)
    up = (side[known][1:] > 0) & (side[known][:-1] < 0)
    return known[1:][up]
