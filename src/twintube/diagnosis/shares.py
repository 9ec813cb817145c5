"""Evidence of every share of the gas preload, from a simulation with one of them.

The gas force goes with its share in a straight line. So the errors with another share follow without a simulation, and so
does what a load cell reads that was set to zero with the damper in it. What the gas does to the fluid force, cavitation, is
that of the simulated share.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.sizes import Sizes

SHARES = np.linspace(0.0, 1.0, 51)  # of the nominal gas pressure; numerics
RIGHT, TARED = range(2)  # the zero of the load cell, and one that was set with the damper in it


@dataclass(frozen=True)
class Zeroed:
    """Logarithm (2, s) of the evidence of each share, its zero right and tared, as likely as they are before the records."""

    log_z: Array
    sizes: Sizes

    @property
    def either(self) -> Array:
        """Of both zeros (s,)."""
        return np.asarray(np.logaddexp(*self.log_z))


def log_share(tared: bool) -> float:
    """Logarithm of the probability that the load cell was set to zero with the damper in it, or was not."""
    return float(np.log(numbers().tared if tared else 1.0 - numbers().tared))


def nearest(share: float) -> int:
    """The place of a share among all."""
    return int(np.abs(SHARES - share).argmin())


def ways(bench: Bench, which: NDArray[np.bool_]) -> Array:
    """Forces (n, 3) [N] of gas, and of a tared zero with its friction, in the records `which` (r,).

    The first is what all of the preload adds where oil is full, the others see `Bench.tared`.
    """
    ends = []
    for share in (0.0, 1.0):
        states = bench.states.copy()
        states[which, 1] = share
        ends.append(bench.full(states)[0])
    return np.column_stack([ends[1] - ends[0], bench.tared(np.zeros(len(bench.z)), which, 1.0)])


def log_z(inner: Array, log_det: float, share: float) -> Array:
    """Logarithm (2, s) of the evidence of all shares, from inner products (4, 4) of errors at one `share` and of `ways`."""
    same = np.ones_like(SHARES)
    right = np.stack([same, share - SHARES, 0.0 * SHARES])
    tared = np.stack([same, share - SHARES, SHARES])
    crossed, spread = inner[:3, 3], 1.0 + float(inner[3, 3])
    rubbed = inner[:3, :3] - np.outer(crossed, crossed) / spread
    squares = [np.einsum("is,ij,js->s", c, m, c) for c, m in ((right, inner[:3, :3]), (tared, rubbed))]
    return np.stack([
        -0.5 * squares[RIGHT] - log_det + log_share(False),
        -0.5 * squares[TARED] - log_det - 0.5 * np.log(spread) + log_share(True),
    ])  # fmt: skip


class Asked:
    """Errors at a share and the ways of the gas (n, 4) [N], of which some sizes are asked."""

    def __init__(self, frame: Frame, values: Array, share: float) -> None:
        self.frame, self.values, self.share = frame, values, share
        self.whitened: dict[int, list[Array]] = {}
        self.inner: dict[Sizes, Array] = {}

    def at(self, sizes: Sizes) -> Array:
        """Logarithm (2, s) of the evidence of all shares at some sizes."""
        i, frame = sizes.lasting_at, self.frame
        if sizes not in self.inner:
            if i not in self.whitened:
                self.whitened[i] = frame.whitened(self.values, i)
            reduced = frame.reduced(self.whitened[i], sizes)
            pulled = frame.pulled(reduced, sizes)
            log_det = frame.integrated(sizes).log_det + float(np.log(np.diag(frame.factor(sizes))).sum())
            self.inner[sizes] = log_z(reduced.errors - pulled.T @ pulled, log_det, self.share)
        return self.inner[sizes]

    def integrated(self, start: Sizes, most: Sizes) -> Zeroed:
        """Evidence with the sizes integrated out about their best, sought from `start` up to `most`."""

        def at(sizes: Sizes) -> Array:
            return self.at(sizes) + sizes.log_prior

        def largest(sizes: Sizes) -> float:
            return float(at(sizes).max())

        best = start
        while (better := max(best.beside(most), key=largest)) != best and largest(better) > largest(best):
            best = better
        return Zeroed(np.logaddexp.reduce([at(sizes) for sizes in best.beside(most)]), best)
