"""All parameters together: differential evolution until its generation lies in the deepest valley, then least squares.

The error has many valleys, and kinks where a phase runs out. A population finds the valley but is slow on its floor; least
squares is quick there but mostly ends in another valley from a random start. So each does what it is good at.
"""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from twintube.common.arrays import Array
from twintube.fitting.least_squares import bounded, derivatives
from twintube.identification.objective import Objective
from twintube.identification.optimise import Best, minimise

# A few percent of cavitation per stroke empty a chamber within a block: the search looks more closely at small shares.
POWERS = {"Y_Co_cav": 3.0, "Y_Re_cav": 3.0}
VALLEYS = 4  # members of the last generation that least squares begins at: they need not all lie in the deepest valley
ROUNDS = 4  # of reweighting
EVALUATIONS = 15  # most of a round
ENDS = 1e-4  # relative change at which a round ends
SETTLED = 1e-3  # relative gain of a round at which the reweighting ends
INSIDE = 1e-6  # share of the range by which a least squares begins inside it


class Scale:
    """Parameters (k,) as points of the unit cube, and back."""

    def __init__(self, objective: Objective) -> None:
        self.low, self.high = objective.bounds.T
        self.power = np.array([POWERS.get(name, 1.0) for name in objective.names])

    def natural(self, U: Array) -> Array:
        """Parameters of points of the cube."""
        values: Array = self.low + (self.high - self.low) * U**self.power
        return values

    def cube(self, x: Array) -> Array:
        """Points of the cube of parameters within their ranges."""
        points: Array = (np.clip((x - self.low) / (self.high - self.low), 0.0, 1.0)) ** (1 / self.power)
        return points


def search(
    objective: Objective,
    size: tuple[int, int],
    *,
    method: str,
    seed: int,
    journal: Path | None = None,
    progress: Callable[[float], None] | None = None,
) -> Best:
    """A search by a single optimiser over the scaled parameters, with `size` population and generations."""
    scale = Scale(objective)
    best = minimise(
        lambda U: objective(scale.natural(U)), np.tile([0.0, 1.0], (len(objective.names), 1)), method=method,
        population=size[0], generations=size[1], seed=seed, journal=journal, progress=progress,
    )  # fmt: skip
    return Best(scale.natural(best.x), best.error, best.trace, best.evaluations, scale.natural(best.last))


def together(
    objective: Objective,
    size: tuple[int, int],
    *,
    seed: int,
    starts: Sequence[Array] = (),
    journal: Path | None = None,
    progress: Callable[[float], None] | None = None,
) -> Best:
    """Differential evolution of `size` population and generations, then least squares from its best and from `starts`."""
    best = search(objective, size, method="de", seed=seed, journal=journal, progress=progress)
    x, error, trace, evaluations = best.x, best.error, best.trace.tolist(), best.evaluations
    for start in (*best.last[:VALLEYS], *starts):
        end, reached, used = floor(objective, start)
        evaluations += used
        if reached < error:
            x, error = end, reached
        trace.append(error)
        if progress is not None:
            progress(error)
    return Best(x, error, np.array(trace), evaluations, x[None])


def floor(objective: Objective, x: Array) -> tuple[Array, float, int]:
    """The local optimum (k,) of the objective near x (k,), its error and the evaluations.

    The error is a sum of root mean squares r. With r0 at the point of departure, (r^2/r0 + r0)/2 is nowhere below r and
    touches it there: least squares of rows divided by r0^(1/2) lowers the sum, and repeated it ends where the sum is least.
    """
    scale, used = Scale(objective), 0
    u, error = scale.cube(x), float(objective(x[None])[0])
    if not np.isfinite(error):
        return x, error, 1
    for _ in range(ROUNDS):
        weights = [np.sqrt(1 / max(float(np.sqrt(np.mean(e**2))), 1e-12) / e.size) for e in objective.misfits(x[None])]

        def rows(U: Array, weights: Sequence[float] = tuple(weights)) -> Array:
            nonlocal used
            used += len(U)
            return np.hstack([e * w for e, w in zip(objective.misfits(scale.natural(U)), weights, strict=True)])

        end, _ = bounded(
            lambda u, rows=rows: rows(u[None])[0],  # type: ignore[misc]
            lambda u, rows=rows: derivatives(rows, u, np.zeros(len(u)), np.ones(len(u))),  # type: ignore[misc]
            np.clip(u, INSIDE, 1 - INSIDE), EVALUATIONS, ENDS,
        )  # fmt: skip
        reached = float(objective(scale.natural(end)[None])[0])
        used += 2
        if reached >= error:
            break
        gain = 1 - reached / error
        u, x, error = end, scale.natural(end), reached
        if gain < SETTLED:
            break
    return x, error, used + 1
