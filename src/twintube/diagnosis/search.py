"""Evidence of a mechanism: its best strengths and fill, and the volume about them (Laplace; MacKay 2003, chapter 27)."""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import lsq_linear
from scipy.stats import norm

from twintube.common.arrays import Array
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.discrepancy import late
from twintube.diagnosis.found import NOTHING, Fill, Found, Trial
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.heavy import beyond, evidence, reweighted
from twintube.diagnosis.mechanisms import Mechanism
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.sizes import USUAL, Sizes

# Numerics.
TRIED = (0.05, 0.3, 1.5, 5.0)  # coordinates of a strength from which the best is sought: beyond is a millionth of its prior
SPREAD = (-2.0, -1.0, 0.0, 1.0, 2.0)  # the like of a place, or of a logarithm
STARTS = 2  # from which the best is sought
KEPT = 5  # places farther off that are looked at
ROUNDS = 12  # of strengths, weights and sizes of the model's own errors in turn
SIZED = (1, 4, 8)  # rounds in which the sizes are sought
ROUGHLY = 5  # rounds where what is most likely is looked at again
SHARES = (1.0, 0.5, 0.25, 0.1, 0.03)  # of a step that are tried
MOVED = (0.5, 0.8, 0.95, 1.05, 1.25, 2.0)  # times a strength, that are tried beside an optimum
OPENED = (0.05, 0.15, 0.4, 1.0, 2.5)  # coordinates of levels and delay beside an optimum that are tried
ENOUGH = 0.05  # of the logarithm of the evidence
BETTER = 0.5  # the like that is worth another search
SLOPE = 0.02  # step of a derivative, of the coordinate
NO_FORCE = 1e-9  # [N] a change that is rounding


class Search:
    """Mechanisms in the samples `acting` (n,) of a bench, in a fill; in the others nothing happens."""

    def __init__(
        self, bench: Bench, frame: Frame, acting: Array, fill: Fill | None = None, near: Found | None = None
    ) -> None:
        """The fill without a mechanism is sought from the middle of what is open, or `near` what was found before."""
        self.bench, self.frame, self.acting, self.fill = bench, frame, acting, fill or Fill()
        self.every = bool(acting.all())
        self.filling: Array = np.zeros((len(bench.z), 0))  # derivatives of the forces by the coordinates of the fill
        start = (self.fill.start, USUAL, frame) if near is None else (near.at, near.sizes, frame.weighted(near.weights))
        self.begin(self.climbed(NOTHING, *start))

    def begin(self, none: Found) -> None:
        """Compare with `none`, in a frame with its weights."""
        self.none, self.weighted = none, self.frame.weighted(none.weights)
        self.filling = self.slopes(NOTHING, self.trial(NOTHING, none.at, exact=True))

    def with_optimum(self) -> "Search":
        """The search, with the fill without a mechanism sought farther off, too."""
        self.begin(self.refined(self.none))
        return self

    def filled(self, u: Array) -> dict[str, float]:
        """The fill at the coordinates of the levels."""
        return {**self.fill.values, **{s.name: s.value(float(x)) for s, x in zip(self.fill.levels, u, strict=True)}}

    def ends(self, m: Mechanism) -> tuple[Array, Array]:
        """The least and the largest coordinates."""
        low, high = zip(*(s.span for s in (*m.strengths, *self.fill.levels)), strict=True) if self.count(m) else ((), ())
        return np.array(low, dtype=float), np.array(high, dtype=float)

    def count(self, m: Mechanism) -> int:
        """Number of coordinates."""
        return len(m.strengths) + len(self.fill.levels)

    def forces(self, m: Mechanism, u: Array) -> tuple[Array, Array]:
        """Forces (n,) [N] without the mechanism and with it."""
        k = len(m.strengths)
        fill = self.filled(u[k:])
        if not k:
            base = self.bench.forces(fill)
            return base, base
        force = self.bench.forces(fill | m.values(u[:k]))
        base = self.bench.forces(fill)
        return base, force if self.every else np.where(self.acting, force, base)

    def trial(self, m: Mechanism, u: Array, exact: bool) -> Trial:
        """The mechanism at some coordinates, with a law that is exact, or off as laws are."""
        base, force = self.forces(m, u)
        change, errors = force - base, (self.bench.measured - force)[:, None]
        if exact or not np.any(np.abs(change) > NO_FORCE):
            return Trial(u, base, force, errors)
        return Trial(
            u, base, force, np.hstack([errors, off_its_law(self.bench, change), late(self.bench.z, self.bench.t, change)])
        )

    def cost(self, frame: Frame, at: Trial, sizes: Sizes) -> float:
        """The negative logarithm of the posterior, up to a constant, where samples have the weights of `frame`."""
        reduced = frame.reduced(frame.whitened(at.values, sizes.lasting_at), sizes)
        return 0.5 * float(at.u @ at.u) - frame.log_z(reduced, sizes)

    def slopes(self, m: Mechanism, at: Trial, rough: bool = False) -> Array:
        """Derivatives (n, k) [N] of the forces by the coordinates.

        `rough` ones look to one side only, and take those of the fill from where nothing has happened.
        """
        if not at.slopes:
            low, high = self.ends(m)
            columns = []
            known = len(m.strengths) if rough else len(at.u)
            for i, x in enumerate(at.u[:known]):
                step = SLOPE * max(abs(x), 0.1)
                a, b = at.u.copy(), at.u.copy()
                b[i] = min(high[i], x + step)
                a[i] = x if rough and b[i] > x else max(low[i], x - step)
                below = at.force if a[i] == x else self.forces(m, a)[1]
                above = at.force if b[i] == x else self.forces(m, b)[1]
                columns.append((above - below) / (b[i] - a[i]))
            at.slopes.append(np.column_stack([*columns, self.filling[:, : len(at.u) - known]]))
        return at.slopes[0]

    def quadratic(self, frame: Frame, m: Mechanism, at: Trial, sizes: Sizes, rough: bool) -> tuple[Array, Array]:
        """Curvature (k, k) and slope (k,) of the logarithm of the posterior, all contributions integrated out."""
        x = at.values.shape[1]
        inner = frame.inner(np.hstack([at.values, self.slopes(m, at, rough)]), sizes)
        if x > 1:
            own = np.eye(x - 1) + inner[1:x, 1:x]
            rest = np.r_[0, x : len(inner)]
            inner = inner[np.ix_(rest, rest)] - inner[rest, 1:x] @ np.linalg.solve(own, inner[1:x, rest])
        return np.eye(len(at.u)) + inner[1:, 1:], inner[1:, 0] - at.u

    def climbed(
        self, m: Mechanism, u: Array, sizes: Sizes, frame: Frame, *, exact: bool = True, rounds: int = ROUNDS
    ) -> Found:
        """The best strengths near some coordinates, and the evidence of the mechanism there; weights are sought, too."""
        at, moved = self.trial(m, u, exact), False
        frame = reweighted(frame, at.values, sizes)
        for i in range(rounds):
            frame = reweighted(frame, at.values, sizes)
            if i in SIZED and moved:
                sizes = frame.evidence(at.values, sizes).sizes
            at, gained = self.stepped(frame, m, at, sizes, exact=exact, rough=rounds < ROUNDS)
            moved |= gained > ENOUGH
            if gained <= ENOUGH and (not moved or i > SIZED[0]):
                break
        return self.found_at(m, at, sizes, frame, exact=exact, rounds=rounds)

    def stepped(
        self, frame: Frame, m: Mechanism, at: Trial, sizes: Sizes, *, exact: bool, rough: bool
    ) -> tuple[Trial, float]:
        """A step of Gauss and Newton, as far as it is better, and what it gains of the logarithm of the posterior."""
        if not len(at.u):
            return at, 0.0
        low, high = self.ends(m)
        H, g = self.quadratic(frame, m, at, sizes, rough)
        L = np.linalg.cholesky(H)
        step = lsq_linear(L.T, np.linalg.solve(L, g), (low - at.u - 1e-12, high - at.u + 1e-12)).x
        if float(step @ g - 0.5 * step @ H @ step) < ENOUGH:
            return at, 0.0
        now = self.cost(frame, at, sizes)
        for share in SHARES:
            other = self.trial(m, np.clip(at.u + share * step, low, high), exact)
            cost = self.cost(frame, other, sizes)
            if cost < now:
                return other, now - cost
        return at, 0.0

    def found_at(self, m: Mechanism, at: Trial, sizes: Sizes, frame: Frame, *, exact: bool, rounds: int) -> Found:
        """The evidence about some coordinates."""
        k, u = len(m.strengths), at.u
        heavy = evidence(frame, at.values, sizes, rounds if rounds == ROUNDS else 1)
        log_z, spread = heavy.log_z + self.fill.log_prior, np.zeros(len(u))
        if len(u):
            H, _ = self.quadratic(heavy.frame, m, at, heavy.sizes, rounds < ROUNDS)
            spread = np.sqrt(np.diag(np.linalg.inv(H)))
            log_z += -0.5 * float(u @ u) - 0.5 * float(np.linalg.slogdet(H)[1])
        # Of a strength that cannot be negative only the part of the volume above zero counts, and twice its density.
        every = list(zip((*m.strengths, *self.fill.levels), u, spread, strict=True))
        log_z += sum(float(np.log(2.0) + norm.logcdf(x / sd)) for s, x, sd in every if s.kind == "half")
        several = every[:k]
        sd = {s.name: abs(s.value(x + d) - s.value(x - d)) / 2.0 for s, x, d in several}
        weights, filled = heavy.frame.weights, self.filled(u[k:])
        return Found(m, float(log_z), exact, u, m.values(u[:k]), sd, filled, heavy.sizes, weights, at.base, at.force)

    def found(self, m: Mechanism) -> Found:
        """The best strengths of a mechanism, sought from several places, and roughly its evidence."""
        m = m.about(self.bench.usual)
        several = [self.climbed(m, *place, rounds=ROUGHLY) for place in self.begun(m)]
        return max(several, key=lambda f: f.log_z)

    def again(self, found: Found) -> Found:
        """What was found roughly."""
        return self.inexact(self.climbed(found.mechanism, found.at, found.sizes, self.frame.weighted(found.weights)))

    def inexact(self, exact: Found) -> Found:
        """The evidence of a mechanism whose law is exact, or off, each as likely; the likelier of both.

        What a channel does is known.
        """
        m = exact.mechanism
        if m.kind != "effect":
            return exact
        off = self.climbed(m, exact.at, exact.sizes, self.frame.weighted(exact.weights), exact=False)
        log_z = float(np.logaddexp(off.log_z, exact.log_z) - np.log(2.0))
        return replace(max(exact, off, key=lambda f: f.log_z), log_z=log_z)

    def begun(self, m: Mechanism) -> Iterator[tuple[Array, Sizes, Frame]]:
        """Coordinates near the best, as errors of usual size have it and those without a cause, and as all samples do.

        What a cause explains has little weight without it, and may lie within the errors of a model without it.
        """
        tried = [np.concatenate([np.zeros(len(m.strengths)), self.none.at])]
        tried += [np.concatenate([x, self.none.at]) for x in grid(m)]
        errors = self.bench.measured[:, None] - np.column_stack([self.forces(m, u)[1] for u in tried])
        seen: set[int] = set()
        for frame, sizes in itertools.product((self.frame, self.weighted), (USUAL, self.none.sizes)):
            misfit = np.diag(frame.inner(errors, sizes)) + np.array([float(u @ u) for u in tried])
            best = int(np.argmin(misfit))
            if best not in seen and len(seen) < STARTS:
                seen.add(best)
                yield (tried[best], sizes, frame) if best else (tried[0], self.none.sizes, self.weighted)

    def refined(self, found: Found) -> Found:
        """What is found where the samples count anew at places farther off: where forces step, slopes show no way there."""
        m = found.mechanism
        while True:
            frame = self.frame.weighted(found.weights)
            now = self.weighed(m, found.at, found, frame)
            best = max(((self.weighed(m, u, found, frame), u) for u in self.likely(found, frame)), key=lambda one: one[0])
            if best[0] < now + BETTER:
                return found
            other = self.inexact(self.climbed(m, best[1], found.sizes, frame))
            if other.log_z < found.log_z + BETTER:
                return found
            found = other

    def likely(self, found: Found, weighted: Frame) -> list[Array]:
        """The likeliest coordinates (k,) farther off, by all samples and by those that count where something was found."""
        m, k, unit = found.mechanism, len(found.mechanism.strengths), np.eye(len(found.at))
        places = [found.at + (by - 1.0) * found.at * one for one in unit[:k] for by in MOVED]
        places += [found.at + sign * by * one for one in unit[k:] for by in OPENED for sign in (-1.0, 1.0)]
        places = [np.clip(u, *self.ends(m)) for u in places]
        if not places:
            return [found.at]
        errors = self.bench.measured[:, None] - np.column_stack([self.forces(m, u)[1] for u in places])
        best: dict[int, None] = {}
        for frame in (self.frame, weighted):
            misfit = np.diag(frame.inner(errors, found.sizes)) + np.array([float(u @ u) for u in places])
            best |= dict.fromkeys(np.argsort(misfit)[:KEPT].tolist())
        return [places[i] for i in best]

    def weighed(self, m: Mechanism, u: Array, near: Found, frame: Frame) -> float:
        """The logarithm of the posterior where the samples of a frame count anew, up to a constant."""
        at = self.trial(m, u, near.exact)
        heavy = reweighted(frame, at.values, near.sizes)
        return beyond(heavy, at.values, near.sizes) - self.cost(heavy, at, near.sizes)


def grid(m: Mechanism) -> list[Array]:
    """Coordinates (k,) of strengths from which the best are sought."""
    low, high = m.ends
    several: list[Sequence[float]] = []
    for s in m.strengths:
        if s.kind in ("half", "normal"):
            several.append((0.0, *TRIED) if s.span[0] >= 0.0 else (0.0, *TRIED, *(-x for x in TRIED)))
        else:
            several.append(SPREAD)
    return [np.clip(np.array(u), low, high) for u in itertools.product(*several) if any(u)] or [np.zeros(len(low))]


def off_its_law(bench: Bench, change: Array) -> Array:
    """What a mechanism that changes forces by (n,) [N] may do besides (n, k), of size one: it is more or less, smoothly."""
    hats = np.column_stack([np.interp(np.abs(bench.v), bench.law.knots, row) for row in np.eye(len(bench.law.knots))])
    z, t = bench.z / bench.law.span, bench.elapsed / max(1e-9, float(bench.elapsed.max()))
    sides = [hats @ bench.law.mixing * (side * change)[:, None] for side in (bench.v >= 0.0, bench.v < 0.0)]
    along = np.column_stack([change * z, change * t, change * (1.5 * z**2 - 0.5)])
    return np.asarray(numbers().law_of_cause * np.hstack([*sides, along]))
