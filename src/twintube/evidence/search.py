"""Evidence of a mechanism: its best strengths, and the volume about them (Laplace; MacKay 2003, chapter 27)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import norm

from twintube.common.arrays import Array
from twintube.evidence.bench import Bench
from twintube.evidence.frame import Evidence, Frame
from twintube.evidence.mechanisms import Mechanism
from twintube.evidence.numbers import NUMBERS
from twintube.evidence.sizes import USUAL, Sizes

# Numerics.
TRIED = (
    0.05,
    0.3,
    1.5,
    5.0,
)  # coordinates of a strength from which the best is sought: beyond lies a millionth of its prior
ROUNDS = 5  # of strengths and sizes of the model's own errors in turn
EVALUATIONS = 12
MOVED = (0.5, 0.8, 0.95, 1.05, 1.25, 2.0)  # times a strength, that are tried beside an optimum
BETTER = 1.0  # twice the logarithm of the odds that is worth another search
SLOPE = 0.02  # step of a derivative, of the coordinate
NO_FORCE = 1e-9  # [N] a change that is rounding


@dataclass(frozen=True)
class Found:
    """A mechanism with its best strengths."""

    mechanism: Mechanism
    log_z: float
    at: Array  # (k,) coordinates
    values: dict[str, float]
    spread: dict[str, float]  # standard deviations
    evidence: Evidence
    force: Array  # (n,) [N]


class Search:
    """Mechanisms in the samples `acting` (n,) of a bench; in the others nothing happens."""

    def __init__(self, bench: Bench, frame: Frame, acting: Array, more: Array | None = None) -> None:
        self.bench, self.frame, self.more = bench, frame, more
        self.acting = acting
        self.base = bench.forces({})
        self.none = frame.evidence(bench.measured - self.base)

    def force(self, mechanism: Mechanism, u: Array) -> Array:
        """Forces (n,) [N] with the strengths at the coordinates (k,)."""
        return np.asarray(np.where(self.acting, self.bench.forces(mechanism.values(u)), self.base))

    def found(self, m: Mechanism, near: Found | None = None) -> Found:
        """The best strengths of a mechanism, and its evidence; sought from those that were found `near`."""
        m = m.about(self.bench.usual)
        u, evidence = self.begun(m) if near is None else (near.at, self.none)
        for _ in range(ROUNDS):
            u, before = self.optimum(m, evidence.sizes, u), evidence.sizes
            evidence = self.frame.evidence(self.bench.measured - self.force(m, u), before)
            if evidence.sizes == before and np.array_equal(moved := self.moved(m, evidence.sizes, u), u):
                break
            u = u if evidence.sizes != before else moved
        force = self.force(m, u)
        J = self.slopes(m, evidence.sizes, u)
        H = J.T @ J + np.eye(len(u))
        spread = np.sqrt(np.diag(np.linalg.inv(H)))
        log_z = self.inexact(force, evidence) - 0.5 * float(u @ u) - 0.5 * float(np.linalg.slogdet(H)[1])
        # Of a strength that cannot be negative only the part of the volume above zero counts, and twice its density.
        log_z += sum(
            np.log(2.0) + norm.logcdf(x / sd) for s, x, sd in zip(m.strengths, u, spread, strict=True) if s.kind == "half"
        )
        sd = {s.name: abs(s.value(x + d) - s.value(x - d)) / 2.0 for s, x, d in zip(m.strengths, u, spread, strict=True)}
        return Found(m, float(log_z), u, m.values(u), sd, evidence, force)

    def inexact(self, force: Array, evidence: Evidence) -> float:
        """Evidence of forces (n,) [N] with a law of the mechanism that is exact, or off as laws are: each as likely."""
        change = force - self.base
        if not np.any(np.abs(change) > NO_FORCE):
            return evidence.log_z
        columns = off_its_law(self.bench, change)
        off = self.frame.evidence(np.column_stack([self.bench.measured - force, columns]), evidence.sizes)
        return float(np.logaddexp(evidence.log_z, off.log_z) - np.log(2.0))

    def begun(self, m: Mechanism) -> tuple[Array, Evidence]:
        """Coordinates (k,) and their evidence, near the best.

        Errors of the model as large as without a cause may explain all that a strength does but the best one. So it is
        sought with errors of the usual size, too.
        """
        several = []
        for sizes in dict.fromkeys((self.none.sizes, USUAL)):
            u = self.optimum(m, sizes, self.start(m, sizes))
            several.append((u, self.frame.evidence(self.bench.measured - self.force(m, u), sizes)))
        return max(several, key=lambda one: one[1].log_z - 0.5 * float(one[0] @ one[0]))

    def start(self, m: Mechanism, sizes: Sizes) -> Array:
        """The coordinates (k,) from which the best are sought, with given sizes of the model's own errors."""
        low, high = m.ends
        k = len(m.strengths)
        unit = np.eye(k)
        acting = [i for i, s in enumerate(m.strengths) if s.kind in ("half", "normal")]
        signs = [(1.0,) if low[i] >= 0.0 else (1.0, -1.0) for i in range(k)]
        tried = [unit[i] * sign * x for i in acting for x in TRIED for sign in signs[i]]
        if len(acting) == 2:
            i, j = acting
            tried += [unit[i] * a * x + unit[j] * b * x for x in TRIED for a in signs[i] for b in signs[j]]
        for i in set(range(k)) - set(acting):
            tried += [t + unit[i] * x for t in tried for x in (-1.0, 1.0)]
        tried = [np.clip(t, low, high) for t in [np.zeros(k), *tried]]
        return np.asarray(tried[int(np.argmin(self.costs(m, sizes, tried)))])

    def moved(self, m: Mechanism, sizes: Sizes, u: Array) -> Array:
        """Better coordinates (k,) farther off: where forces step, derivatives do not show the way (Kolda et al. 2003)."""
        several = [
            u,
            *(
                np.clip(u + (by - 1.0) * x * unit, *m.ends)
                for x, unit in zip(u, np.eye(len(u)), strict=True)
                for by in MOVED
            ),
        ]

        costs = self.costs(m, sizes, several)
        best = int(np.argmin(costs))
        return several[best] if costs[best] < costs[0] - BETTER else u

    def costs(self, m: Mechanism, sizes: Sizes, several: Sequence[Array]) -> list[float]:
        """Twice the negative logarithm of the posterior at coordinates (k,), up to a constant."""

        def cost(u: Array) -> float:
            r = self.residuals(m, sizes, u)
            return float(r @ r)

        return list(self.bench.threads.map(cost, several))

    def residuals(self, m: Mechanism, sizes: Sizes, u: Array) -> Array:
        """Whose sum of squares is twice the negative logarithm of the posterior, up to a constant."""
        errors = self.bench.measured - self.force(m, u)
        return np.concatenate([self.frame.residuals(errors[:, None], sizes)[:, 0], u])

    def slopes(self, m: Mechanism, sizes: Sizes, u: Array) -> Array:
        """Derivatives (q, k) of the errors, whose inner products are those under the model."""
        return self.frame.residuals(self.derivatives(m, u), sizes)

    def derivatives(self, m: Mechanism, u: Array) -> Array:
        """Derivatives (n, k) [N] of the forces by the coordinates (k,)."""
        low, high = m.ends

        def one(i: int) -> Array:
            step = SLOPE * max(abs(u[i]), 0.1)
            a, b = u.copy(), u.copy()
            a[i], b[i] = max(low[i], u[i] - step), min(high[i], u[i] + step)
            return np.asarray((self.force(m, a) - self.force(m, b)) / (b[i] - a[i]))

        return np.column_stack(list(self.bench.threads.map(one, range(len(u)))))

    def optimum(self, m: Mechanism, sizes: Sizes, u: Array) -> Array:
        """The most probable coordinates (k,) with given sizes of the model's own errors."""
        low, high = m.ends
        edge = 1e-6 * (high - low)
        done = least_squares(
            lambda x: self.residuals(m, sizes, x), np.clip(u, low + edge, high - edge),
            lambda x: np.vstack([self.slopes(m, sizes, x), np.eye(len(x))]),
            bounds=(low, high), max_nfev=EVALUATIONS, ftol=1e-4, xtol=1e-4,
        )  # fmt: skip
        return np.asarray(done.x)


def off_its_law(bench: Bench, change: Array) -> Array:
    """What a mechanism that changes forces by (n,) [N] may do besides (n, k), of size one: it is more or less, smoothly."""
    hats = np.column_stack([np.interp(np.abs(bench.v), bench.law.knots, row) for row in np.eye(len(bench.law.knots))])
    z, t = bench.z / bench.law.span, bench.elapsed / max(1e-9, float(bench.elapsed.max()))
    sides = [hats @ bench.law.mixing * (side * change)[:, None] for side in (bench.v >= 0.0, bench.v < 0.0)]
    along = np.column_stack([change * z, change * t, change * (1.5 * z**2 - 0.5)])
    return np.asarray(NUMBERS.law_of_cause * np.hstack([*sides, along]))
