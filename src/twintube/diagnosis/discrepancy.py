"""The model's own error D: what a damper's law is off, smooth in speed and stroke, each direction by itself, and late.

It goes with the fluid force, and so with the oil that is left. Hats over the logarithm of the speed carry a Gaussian
process; their correlation is that of a squared exponential.
"""

from dataclasses import dataclass

import numpy as np

from twintube.common.arrays import Array
from twintube.diagnosis.memory import lagged
from twintube.diagnosis.numbers import numbers

KNOTS = np.array([0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2])  # [m/s] octaves of the speed
FINE = np.array([0.035, 0.07, 0.14, 0.28, 0.57, 1.13])  # [m/s] between them


@dataclass(frozen=True)
class Discrepancy:
    """The basis of D for the speeds that records reach; `columns` are scaled so that its size is a share of the force."""

    knots: Array  # (q,) [m/s]
    span: float  # [m] largest stroke
    floor: float  # [N] force below which D does not shrink with it

    @property
    def mixing(self) -> Array:
        """Root (q, q) of the correlation of neighbouring knots."""
        octaves = np.log2(np.maximum(self.knots, KNOTS[1] / 2.0))
        apart = octaves[:, None] - octaves
        correlation = np.exp(-0.5 * (apart / numbers().law_octaves) ** 2) + 1e-9 * np.eye(len(octaves))
        return np.linalg.cholesky(correlation)

    def size(self, speed: Array, fluid: Array, turn: Array) -> Array:
        """The force (n,) [N] of which D is a share: none at rest, and not less than drawings allow for."""
        return np.asarray(np.sign(speed) * np.minimum(1.0, np.abs(speed) / KNOTS[1]) * np.hypot(fluid, self.floor * turn))

    def own(self, stroke: Array, speed: Array, fluid: Array, turn: Array) -> Array:
        """Contributions (n, m) [N] of size one that a record has for itself, up to its largest speed."""
        knots = self.knots[: max(3, int(np.searchsorted(self.knots, float(np.abs(speed).max()))) + 1)]
        hats = np.column_stack([np.interp(np.abs(speed), knots, row) for row in np.eye(len(knots))])
        size, z = self.size(speed, fluid, turn), stroke / self.span
        return np.hstack([hats * (side * size * p)[:, None] for side in (speed >= 0.0, speed < 0.0) for p in (1.0, z)])

    def columns(self, stroke: Array, speed: Array, fluid: Array, time: Array, turn: Array) -> Array:
        """Contributions (n, k) [N] of size one to a force whose fluid part is `fluid` [N] at the times [s].

        `turn` (n,) [1] says how the fluid force goes with the oil.
        """
        hats = np.column_stack([np.interp(np.abs(speed), self.knots, row) for row in np.eye(len(self.knots))]) @ self.mixing
        inner = np.unique(np.concatenate([self.knots, FINE[self.knots[-1] > FINE]]))
        rows = np.eye(len(inner))[np.isin(inner, FINE)]
        between = np.column_stack([np.interp(np.abs(speed), inner, row) for row in rows])
        z = stroke / self.span
        along = [np.ones_like(z), *(numbers().law_stroke * p for p in (z, 1.5 * z**2 - 0.5, 2.5 * z**3 - 1.5 * z))]
        size = self.size(speed, fluid, turn)
        passed, gone = (np.abs(np.diff(x, prepend=x[0])) for x in (time, stroke))
        late = [lagged(fluid, np.exp(-passed / tau)) - fluid for tau in numbers().law_lags]
        late += [lagged(fluid, np.exp(-gone / way)) - fluid for way in numbers().law_ways]
        parts: list[Array] = []
        for side in (speed >= 0.0, speed < 0.0):
            parts += [hats * (side * size * p)[:, None] for p in along]
            parts += [between * (side * size * numbers().law_knee)[:, None], (side * size * numbers().law_whole)[:, None]]
            parts += [(side * x / numbers().law_late)[:, None] for x in late]
        return np.hstack(parts)


def degraded(stroke: Array, speed: Array, loss: Array) -> Array:
    """Contributions (n, 6) [N] of size one to a loss of force (n,) [N]: it is larger or smaller, and comes gradually."""
    gone = np.abs(np.diff(stroke, prepend=stroke[0]))
    several = [numbers().loss * loss, *(lagged(loss, np.exp(-gone / way)) - loss for way in numbers().law_ways)]
    return np.column_stack([side * some for side in (speed >= 0.0, speed < 0.0) for some in several])


def discrepancy(speeds: Array, span: float, floor: float) -> Discrepancy:
    """The basis up to the largest of some speeds [m/s]."""
    inside = int(np.searchsorted(KNOTS, float(np.max(np.abs(speeds))))) + 1
    return Discrepancy(KNOTS[: max(3, inside)], span, floor)


def late(stroke: Array, time: Array, change: Array) -> Array:
    """Contributions (n, k) [N] of size one to a force that changes by (n,) [N]: the change comes later."""
    gone, passed = (np.abs(np.diff(x, prepend=x[0])) for x in (stroke, time))
    several = [np.exp(-gone / way) for way in numbers().cause_ways] + [np.exp(-passed / lag) for lag in numbers().cause_lags]
    return np.column_stack([lagged(change, kept) - change for kept in several])
