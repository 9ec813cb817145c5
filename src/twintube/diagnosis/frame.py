r"""Evidence of errors with Gaussian contributions integrated out: the probability model of the diagnosis.

The measured less the simulated forces of a record r are

    y_r = S_r a + O_r b_r + \epsilon_r,    a ~ N(0, diag(s^2)),  b_r ~ N(0, diag(o^2)),  \epsilon_r ~ N(0, N_r)

S are contributions that all records share (the model's own error D, friction, gas, degradation that is off), O those of a
single record (zero, gain, delay, temperature, its own error), N is white noise and an error that lasts. a and b are
integrated out in closed form. Everything follows from the inner products of the columns without their noise, so that other
sizes of the contributions cost no pass over the samples (Woodbury; Rasmussen and Williams 2006, equations 2.43 and A.3).
"""

from copy import copy
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag, cho_solve, cholesky, solve_triangular

from twintube.common.arrays import Array
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.memory import innovations, lasting
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.sizes import LARGEST, USUAL, Sizes

STILL = 17  # shared columns of friction, gas, degradation, zero and channels, before those of D
BENCH = 12  # own columns of the bench, before those of a record's own error
LASTS = 6.0  # intervals that an error lasts: an eighth of an oscillation


@dataclass(frozen=True)
class Evidence:
    """Evidence of some errors."""

    log_z: float  # sizes integrated out
    sizes: Sizes  # the best


@dataclass(frozen=True)
class White:
    """The columns of a record without their noise."""

    columns: Array  # (n, k + m)
    gram: Array
    log_noise: float


@dataclass(frozen=True)
class Reduced:
    """Inner products with errors over all records, the contributions of single records integrated out."""

    shared_errors: Array  # (k, c)
    errors: Array  # (c, c)
    own: list[Array]  # (m, c) of each part, what was taken off


@dataclass(frozen=True)
class Integrated:
    """The contributions of single records integrated out."""

    factors: list[tuple[Array, Array]]  # of each part: the Cholesky factor (m, m), and what was taken off (m, k)
    shared: Array  # (k, k) inner products over all records
    log_det: float


@dataclass(frozen=True)
class Part:
    """What is compared of the records of one motion: its place among all samples, and the contributions to it."""

    rows: NDArray[np.int64]  # (n,)
    columns: Array  # (n, k + m)
    fixed: NDArray[np.bool_]  # (m,) own contributions whose size is not sought
    sigma: Array  # [N]
    lasts: Array  # [N] of size one
    kept: Array
    known: dict[int, White] = field(default_factory=dict, init=False, compare=False)

    def scale(self, sizes: Sizes) -> Array:
        """Standard deviations of the own contributions (m,)."""
        return np.where(self.fixed, 1.0, sizes.own)

    def innovations(self, values: Array, lasting_at: int) -> tuple[Array, float]:
        """Values (n, c) [N] without noise, and half the logarithm of its determinant."""
        some = np.ascontiguousarray(values)
        out = np.empty_like(some)
        log_noise = innovations(some, self.sigma, numbers().lasting_sizes[lasting_at] * self.lasts, self.kept, out)
        return out, float(log_noise)

    def white(self, lasting_at: int) -> White:
        """The columns without noise, of which the lasting part has one of the sizes tried."""
        if lasting_at not in self.known:
            out, log_noise = self.innovations(self.columns, lasting_at)
            self.known[lasting_at] = White(out, out.T @ out, log_noise)
        return self.known[lasting_at]


class Frame:
    """The Gaussian contributions to some records, for simulations near a given one."""

    def __init__(
        self,
        bench: Bench,
        states: Array,
        steps: Array | None = None,
        more: Array | None = None,
        used: NDArray[np.bool_] | None = None,
        *,
        known: bool = False,
    ) -> None:
        """Contributions in some states (r, 4); `steps` (n,) [N] is more noise, `more` (n, p) [N] are further shared ones.

        Only the samples `used` (n,) are compared, if given. Whether the fill is `known`: see `Bench.contributions`.
        """
        self.bench, self.used = bench, bench.used if used is None else used
        several = bench.contributions(states, known)
        more = np.zeros((len(bench.z), 0)) if more is None else more
        noise = bench.sigma if steps is None else np.hypot(bench.sigma, steps)
        self.still = STILL + more.shape[1]
        self.k = self.still - STILL + several[0][0].shape[1]
        self.parts = [self.part(group, several, noise, more) for group in bench.motions()]
        self.noise = noise
        self.weights: Array = np.ones(len(bench.z))
        self.forget()

    def forget(self) -> None:
        """Nothing is known yet of any sizes."""
        self.known: dict[tuple[int, int], Integrated] = {}
        self.factors: dict[Sizes, Array] = {}

    def weighted(self, weights: Array) -> "Frame":
        """The same contributions, where each sample counts by its weight (n,)."""
        if weights is self.weights:
            return self
        other = copy(self)
        other.weights = weights
        sigma = self.noise / np.sqrt(weights)
        other.parts = [replace(part, sigma=sigma[part.rows]) for part in self.parts]
        other.forget()
        return other

    def hiding(self, at: slice, noise: float) -> "Frame":
        """The same contributions, with a further noise [N] in the samples `at`."""
        other = copy(self)
        inside = [(part.rows >= at.start) & (part.rows < at.stop) for part in self.parts]
        other.parts = [
            replace(part, sigma=np.hypot(part.sigma, noise * some)) if some.any() else part
            for part, some in zip(self.parts, inside, strict=True)
        ]
        other.forget()
        return other

    def part(self, group: list[int], several: list[tuple[Array, Array, Array]], noise: Array, more: Array) -> Part:
        """The records of one motion."""
        uses = [np.flatnonzero(self.used[self.bench.slices[i]]) for i in group]
        rows = np.concatenate([self.bench.slices[i].start + use for i, use in zip(group, uses, strict=True)])
        own = block_diag(*(several[i][1][use] for i, use in zip(group, uses, strict=True)))
        shared, lasts, repeating = (
            np.concatenate([x[use] for x, use in zip(xs, uses, strict=True)])
            for xs in zip(*((several[i][0], several[i][2], self.bench.repeating(i)) for i in group), strict=True)
        )
        fixed = [np.arange(several[i][1].shape[1]) < BENCH for i in group]
        kept = np.concatenate([np.concatenate([[0.0], np.exp(-np.diff(use) / LASTS)]) for use in uses])
        columns = np.ascontiguousarray(np.hstack([more[rows], shared, own, repeating]))
        return Part(rows, columns, np.concatenate([*fixed, np.zeros(repeating.shape[1], bool)]), noise[rows], lasts, kept)

    def fixed_shared(self, k: int) -> NDArray[np.bool_]:
        """Which of a state's shared contributions (k,) have a size that is not sought."""
        return np.arange(k) < STILL

    def white(self, lasting_at: int) -> list[White]:
        """The columns of all records without noise, of which the lasting part has one of the sizes tried."""
        return [part.white(lasting_at) for part in self.parts]

    def whitened(self, values: Array, lasting_at: int) -> list[Array]:
        """Errors (n, c) [N] of all records without noise."""
        return [part.innovations(values[part.rows], lasting_at)[0] for part in self.parts]

    def scale(self, sizes: Sizes) -> Array:
        """Standard deviations of the shared contributions (k,)."""
        return np.where(np.arange(self.k) < self.still, 1.0, sizes.law)

    def integrated(self, sizes: Sizes) -> Integrated:
        """What integrating out the contributions of single records asks for, whatever the errors are."""
        key = (sizes.own_at, sizes.lasting_at)
        if key not in self.known:
            k, factors, SS, log_det = self.k, [], np.zeros((self.k, self.k)), 0.0
            for part, w in zip(self.parts, self.white(sizes.lasting_at), strict=True):
                scale = part.scale(sizes)
                L = cholesky(np.eye(len(scale)) + scale[:, None] * w.gram[k:, k:] * scale, lower=True, check_finite=False)
                P = solve_triangular(L, scale[:, None] * w.gram[k:, :k], lower=True, check_finite=False)
                SS += w.gram[:k, :k] - P.T @ P
                log_det += float(np.log(np.diag(L)).sum()) + w.log_noise
                factors.append((L, P))
            self.known[key] = Integrated(factors, SS, log_det)
        return self.known[key]

    def factor(self, sizes: Sizes) -> Array:
        """The Cholesky factor (k, k) of the precision of the shared contributions, in standard deviations."""
        if sizes not in self.factors:
            scale = self.scale(sizes)
            G = np.eye(self.k) + scale[:, None] * self.integrated(sizes).shared * scale
            self.factors[sizes] = cholesky(G, lower=True, check_finite=False)
        return self.factors[sizes]

    def reduced(self, errors: list[Array], sizes: Sizes) -> Reduced:
        """What whitened errors (n, c) say of the shared contributions, those of single records integrated out."""
        k, c = self.k, errors[0].shape[1]
        SY, YY, own = np.zeros((k, c)), np.zeros((c, c)), []
        several = zip(self.parts, self.white(sizes.lasting_at), self.integrated(sizes).factors, errors, strict=True)
        for part, w, (L, P), y in several:
            cross = w.columns.T @ y
            Q = solve_triangular(L, part.scale(sizes)[:, None] * cross[k:], lower=True, check_finite=False)
            SY, YY = SY + cross[:k] - P.T @ Q, YY + y.T @ y - Q.T @ Q
            own.append(Q)
        return Reduced(SY, YY, own)

    def log_z(self, reduced: Reduced, sizes: Sizes) -> float:
        """Evidence of the first of several errors; shared contributions and those of the other columns integrated out."""
        L, pulled = self.factor(sizes), self.pulled(reduced, sizes)
        inner = reduced.errors - pulled.T @ pulled
        left, log_det = float(inner[0, 0]), self.integrated(sizes).log_det + float(np.log(np.diag(L)).sum())
        if len(inner) > 1:
            L = cholesky(np.eye(len(inner) - 1) + inner[1:, 1:], lower=True, check_finite=False)
            taken = solve_triangular(L, inner[1:, 0], lower=True, check_finite=False)
            left, log_det = left - float(taken @ taken), log_det + float(np.log(np.diag(L)).sum())
        return -0.5 * left - log_det

    def evidence(self, errors: Array, start: Sizes = USUAL, most: Sizes = LARGEST) -> Evidence:
        """Evidence of errors (n,) [N] with the sizes integrated out about their best, sought from `start` up to `most`.

        Further columns (n, 1 + c) [N] are contributions of size one of a hypothesis.
        """
        found: dict[Sizes, float] = {}
        white: dict[int, list[Array]] = {}
        reduced: dict[tuple[int, int], Reduced] = {}
        values = errors[:, None] if errors.ndim == 1 else errors

        def at(sizes: Sizes) -> float:
            if sizes not in found:
                i, key = sizes.lasting_at, (sizes.own_at, sizes.lasting_at)
                if i not in white:
                    white[i] = self.whitened(values, i)
                if key not in reduced:
                    reduced[key] = self.reduced(white[i], sizes)
                found[sizes] = self.log_z(reduced[key], sizes) + sizes.log_prior
            return found[sizes]

        best = start
        while (better := max(best.beside(most), key=at)) != best and at(better) > at(best):
            best = better
        return Evidence(float(np.logaddexp.reduce([at(sizes) for sizes in best.beside(most)])), best)

    def explained(self, values: Array, sizes: Sizes) -> tuple[list[Array], Array, list[Array]]:
        """Whitened values (n, c) of each record, and what the shared (k, c) and own contributions of it are expected to be.

        Both are in standard deviations of their priors.
        """
        y, scale = self.whitened(values, sizes.lasting_at), self.scale(sizes)
        reduced = self.reduced(y, sizes)
        a = cho_solve((self.factor(sizes), True), scale[:, None] * reduced.shared_errors, check_finite=False)
        several = zip(self.integrated(sizes).factors, reduced.own, strict=True)
        own = [
            solve_triangular(L, Q - P @ (scale[:, None] * a), lower=True, trans="T", check_finite=False)
            for (L, P), Q in several
        ]
        return y, a, own

    def expected(self, part: Part, a: Array, b: Array, sizes: Sizes) -> Array:
        """The contributions (k + m, c) to a part whose shared and own ones are `a` (k, c) and `b` (m, c) deviations."""
        return np.concatenate([self.scale(sizes)[:, None] * a, part.scale(sizes)[:, None] * b])

    def left(self, errors: Array, sizes: Sizes) -> Array:
        """Errors (n,) [N] without what the contributions are expected to be."""
        _, a, own = self.explained(errors[:, None], sizes)
        out = np.zeros(len(errors))
        for part, b in zip(self.parts, own, strict=True):
            out[part.rows] = errors[part.rows] - (part.columns @ self.expected(part, a, b, sizes))[:, 0]
        return out

    def standardised(self, errors: Array, sizes: Sizes) -> Array:
        """Errors (n,) [N] without all that is expected of the contributions and of what lasts, over the noise."""
        left, out = self.left(errors, sizes), np.zeros(len(errors))
        size = numbers().lasting_sizes[sizes.lasting_at]
        for part in self.parts:
            some = left[part.rows]
            if size > 0.0:
                some = some - lasting(some, part.sigma, size * part.lasts, part.kept)
            out[part.rows] = some / self.noise[part.rows]
        return out

    def inner(self, values: Array, sizes: Sizes) -> Array:
        """Inner products (c, c) of values (n, c) [N] under the model."""
        reduced = self.reduced(self.whitened(values, sizes.lasting_at), sizes)
        pulled = self.pulled(reduced, sizes)
        return np.asarray(reduced.errors - pulled.T @ pulled)

    def pulled(self, reduced: Reduced, sizes: Sizes) -> Array:
        """What the shared contributions take off (k, c)."""
        scaled = self.scale(sizes)[:, None] * reduced.shared_errors
        return np.asarray(solve_triangular(self.factor(sizes), scaled, lower=True, check_finite=False))
