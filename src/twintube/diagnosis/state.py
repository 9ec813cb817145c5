"""State of a damper: oil level with an interval, gas preload there or lost, from records of which nobody knows it.

A load cell that was set to zero with the damper in it lacks the force of the gas, as if the preload were lost. What tells
them apart is the rest of the gas: its stiffness, and that a damper without preload cavitates.
"""

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit, logsumexp
from scipy.stats import norm

from twintube.common.arrays import Array
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.frame import Evidence, Frame
from twintube.diagnosis.numbers import NUMBERS
from twintube.diagnosis.sizes import LARGEST, Sizes

# Numerics of the grid.
WITHIN = (-0.02, -0.01, 0.0, 0.01)  # levels of a coarse cell that are looked at
COARSE = 0.04  # first step of the oil level
FINE = 0.01  # cells narrower than this are not divided
STEP = 1.0  # change of the logarithm of the evidence above which a cell is divided
ROUGH = Sizes(4, 2, 4)
SKETCHED = [Sizes(law, own, lasting) for law, own in ((4, 2), (2, 1)) for lasting in (2, 4)]
# What a wrong state leaves is not to be taken for a damper far off its law.
BOUNDED = Sizes(4, 2, LARGEST.lasting_at)
ROUGHLY = 50.0  # logarithm of the odds, at usual sizes, below which a state is not looked at again
LOOKED_AT = 3  # levels at least, with and without preload, that are looked at again
SHOWN = 0.0025  # step of the oil level in the answer
WIDEST = 4.0  # standard deviations of the tolerance
ENOUGH = 8.0  # logarithm of the odds below which a cell of the grid is not refined
EVEN = 0.5  # probability of the one and the other
LOST, THERE, TARED = range(3)  # rows of the probability


@dataclass(frozen=True)
class Stated:
    """What a file says of a state; None where it says that nobody knows."""

    oil_level: float | None = None
    gas_preload: float | None = None

    @property
    def anything(self) -> bool:
        """Whether it says something."""
        return self.oil_level is not None or self.gas_preload is not None


NOTHING = Stated()


@dataclass(frozen=True)
class Zeroed:
    """Evidence of a state, where the zero of the load cell is right, and where it was set with the damper in it."""

    right: Evidence
    tared: Evidence

    @property
    def log_z(self) -> float:
        """Of both, as likely as they are before the records."""
        return float(np.logaddexp(self.right.log_z + log_share(False), self.tared.log_z + log_share(True)))

    @property
    def rather_tared(self) -> bool:
        """Whether the latter is likelier."""
        return self.tared.log_z + log_share(True) > self.right.log_z + log_share(False)


def log_share(tared: bool) -> float:
    """Logarithm of the probability that the load cell was set to zero with the damper in it, or was not."""
    return float(np.log(NUMBERS.tared if tared else 1.0 - NUMBERS.tared))


@dataclass(frozen=True)
class StatePosterior:
    """Probability over oil level (l,) and gas: (3, l), summing to 1.

    The preload is lost, there, or there and missing in the records, as the load cell was set to zero with the damper in it.
    """

    levels: Array
    probability: Array
    evidence: Evidence  # of the state below
    # Preload, level, and whether the cell was set to zero with the damper in it, that fit best, within what a file says.
    best: tuple[int, float, bool]
    log_odds_stated: float  # evidence of what a file says, to the tolerance of a fill, over that of any state
    free: tuple[int, float]  # preload and level that fit best, whatever a file says
    levels_of: Mapping[int, float]  # level that fits best without preload and with it
    tared_as_stated: float  # probability that the load cell was set to zero with the damper in it, where the file is right

    @property
    def as_stated(self) -> float:
        """Probability that what a file says is right."""
        return float(expit(self.log_odds_stated + np.log(1.0 / NUMBERS.misstated - 1.0)))

    @property
    def rather_misstated(self) -> bool:
        """Whether what a file says is more likely wrong than right."""
        return self.as_stated < EVEN

    @property
    def gas_lost(self) -> float:
        """Probability that the preload is lost."""
        return float(self.probability[LOST].sum())

    @property
    def tared(self) -> float:
        """Probability that the preload is there, and the load cell was set to zero with the damper in it."""
        return float(self.probability[TARED].sum())

    def interval(self, share: float = 0.9) -> tuple[float, float]:
        """The shortest interval of the oil level [1] that holds a `share` of the probability."""
        mass = self.probability.sum(axis=0)
        half = 0.5 * float(self.levels[1] - self.levels[0])
        total = np.concatenate([[0.0], np.cumsum(mass)])
        ends = np.minimum(np.searchsorted(total, total[:-1] + share - 1e-9), len(mass))
        wide = np.where(total[:-1] + share <= total[-1] + 1e-9, ends - np.arange(len(mass)), len(mass) + 1)
        first = int(np.argmin(wide))
        low, high = self.levels[first] - half, self.levels[min(first + int(wide[first]), len(mass)) - 1] + half
        return float(low), float(min(1.0, high))

    @property
    def level(self) -> float:
        """The median oil level [1]."""
        return float(np.interp(0.5, np.cumsum(self.probability.sum(axis=0)), self.levels))


def between(found: Mapping[tuple[int, float], Zeroed]) -> list[tuple[int, float]]:
    """The middles of cells in which the evidence changes, near its largest: what a sum over the grid still asks for."""
    top = max(e.log_z for e in found.values())
    wanted = []
    for gas in (0, 1):
        levels = sorted(x for g, x in found if g == gas)
        for a, b in itertools.pairwise(levels):
            at_a, at_b = found[gas, a].log_z, found[gas, b].log_z
            if b - a > FINE and max(at_a, at_b) > top - ENOUGH and abs(at_a - at_b) > STEP:
                wanted.append((gas, round(0.5 * (a + b), 5)))
    return wanted


def steps(bench: Bench, force: Array, states: Array, which: Array, cell: float) -> Array:
    """What forces (n,) [N] are off within a `cell` of the grid of oil levels of the records `which` (r,)."""
    change = []
    for by in (-cell / 2.0, cell / 2.0):
        other = states.copy()
        other[which, 0] = np.clip(states[which, 0] + by, 0.0, 1.0)
        change.append(np.abs(bench.with_states(other) - force))
    # At the edge of a range in which nothing changes a state may lie on the quiet side.
    return np.asarray(np.min(change, axis=0) if cell <= FINE else np.max(change, axis=0))


def state(
    bench: Bench, which: Sequence[int], stated: Stated = NOTHING, progress: Callable[[str], None] = lambda text: None
) -> StatePosterior:
    """The state of the damper in the records `which` of one fill; the others keep theirs."""
    mine = np.zeros(len(bench.records), dtype=bool)
    mine[list(which)] = True

    # An error at a step of the force comes again in every oscillation, and tells as much as in one.
    once = bench.once()

    def frame(key: tuple[int, float], cell: float = COARSE, used: NDArray[np.bool_] | None = once) -> tuple[Frame, Array]:
        states = bench.states.copy()
        states[mine, 0], states[mine, 1] = key[1], key[0]
        force = bench.with_states(states)
        step = steps(bench, force, states, mine, cell)
        return Frame(bench, states, step, bench.days, used), bench.measured - force

    def sketched(key: tuple[int, float]) -> float:
        """Evidence at some sizes: what a state far off has is far less."""
        here, errors = frame(key)
        found = []
        for values in (errors[:, None], bench.tared(errors, mine, key[0])):
            white = {i: here.whitened(values, i) for i in {sizes.lasting_at for sizes in SKETCHED}}
            found += [here.log_z(here.reduced(white[sizes.lasting_at], sizes), sizes) for sizes in SKETCHED]
        return max(found)

    def evidence(key: tuple[int, float]) -> Zeroed:
        here, errors = frame(key, FINE)
        right = here.evidence(errors, ROUGH, BOUNDED)
        return Zeroed(right, here.evidence(bench.tared(errors, mine, key[0]), right.sizes, BOUNDED))

    levels_tried = np.arange(1.0, NUMBERS.level_low - 1e-9, -COARSE)
    coarse = [(gas, round(float(x), 5)) for gas in (1, 0) for x in levels_tried]
    rough = dict(zip(coarse, bench.threads.map(sketched, coarse), strict=True))
    likely = sorted(coarse, key=lambda key: -rough[key])[:LOOKED_AT]

    def noise(key: tuple[int, float]) -> Array:
        here, errors = frame(key, used=None)
        return bench.noise_in(here.left(errors, here.evidence(errors, ROUGH, BOUNDED).sizes))

    # What a wrong state leaves seldom repeats from oscillation to oscillation: its errors hold more than noise.
    repeats = np.min(list(bench.threads.map(noise, likely)), axis=0)
    bench.noisy(np.hypot(repeats, NUMBERS.degraded * bench.peak))
    progress("comparing oil levels")
    rough = dict(zip(coarse, bench.threads.map(sketched, coarse), strict=True))
    best = max(rough.values())
    coarsely = [key for key in coarse if rough[key] > best - ROUGHLY]
    for gas in (0, 1):  # of each preload the most likely, which a step may have hidden
        coarsely += sorted((key for key in coarse if key[0] == gas), key=lambda key: -rough[key])[:LOOKED_AT]
        # A state with a probability of its own is looked at by itself.
        coarsely += [(gas, x) for x in {1.0, stated.oil_level} if x is not None]
    close = sorted({(gas, round(min(1.0, x + by), 5)) for gas, x in coarsely for by in WITHIN})
    found = dict(zip(close, bench.threads.map(evidence, close), strict=True))
    while wanted := between(found):
        found.update(zip(wanted, bench.threads.map(evidence, wanted), strict=True))
    bench.noisy(repeats)
    return posterior(found, stated)


def rather_tared(bench: Bench, which: NDArray[np.bool_]) -> bool:
    """Whether the load cell was rather set to zero with the damper in it, in records (r,) that are as their file says."""
    errors = bench.measured - bench.with_states(bench.states)
    frame = Frame(bench, bench.states, used=bench.once() & np.repeat(which, np.diff(bench.starts)))
    several = Zeroed(frame.evidence(errors), frame.evidence(bench.tared(errors, which, bench.states[:, 1])))
    return several.rather_tared


def posterior(found: Mapping[tuple[int, float], Zeroed], stated: Stated = NOTHING) -> StatePosterior:
    """Probabilities from the evidence of preload and oil level, and from what a file says of them."""
    fine = np.arange(NUMBERS.level_low, 1.0 + 1e-9, SHOWN)
    # What the force tells is the level to a tolerance: geometry and fill of a damper are no better known.
    wide = WIDEST * NUMBERS.level_tolerance
    read = np.arange(fine[0] - wide, fine[-1] + wide, SHOWN / 2.0)
    tolerance = norm.logpdf(read, fine[:, None], NUMBERS.level_tolerance) + np.log(SHOWN / 2.0)

    def likelihood(gas: int, of: Callable[[Zeroed], float]) -> Array:
        """Logarithm (l,) of the probability of the records."""
        known = [x for g, x in sorted(found) if g == gas]
        # A level that was not looked at has the evidence of the line between its neighbours.
        at = np.interp(read, known, [of(found[gas, x]) for x in known], left=min(of(z) for z in found.values()))
        return np.asarray(logsumexp(tolerance + at, axis=1))

    log_likelihood = np.array([
        likelihood(0, lambda z: z.log_z),
        likelihood(1, lambda z: z.right.log_z + log_share(False)),
        likelihood(1, lambda z: z.tared.log_z + log_share(True)),
    ])  # fmt: skip
    free, as_stated = (log_prior(fine, some)[[0, 1, 1]] + log_likelihood for some in (NOTHING, stated))
    said = 1.0 - NUMBERS.misstated if stated.anything else 0.0
    both = logsumexp([free, as_stated], axis=0, b=[[[1.0 - said]], [[said]]])
    best = max(found, key=lambda key: found[key].log_z + fitting(key, stated))
    free_best = max(found, key=lambda key: found[key].log_z)
    levels_of = {gas: max((key for key in found if key[0] == gas), key=lambda key: found[key].log_z)[1] for gas in (0, 1)}
    known, tared = found[best], found[best].rather_tared
    probability, right = (np.exp(x - logsumexp(x)) for x in (both, as_stated))
    odds = float(logsumexp(as_stated) - logsumexp(free))
    share = float(right[TARED].sum())
    return StatePosterior(
        fine, probability, known.tared if tared else known.right, (*best, tared), odds, free_best, levels_of, share
    )


def fitting(key: tuple[int, float], stated: Stated) -> float:
    """Logarithm of the odds of preload and level against those that a file states."""
    if stated.gas_preload is not None and key[0] != int(stated.gas_preload):
        return -np.inf
    apart = 0.0 if stated.oil_level is None else key[1] - stated.oil_level
    return float(-0.5 * (apart / NUMBERS.level_tolerance) ** 2)


def log_prior(levels: Array, stated: Stated) -> Array:
    """Logarithm of the probability (2, l) of preload lost and there at oil levels (l,) where a file is right about them."""
    if stated.oil_level is None:
        level = np.full(len(levels), np.log((1.0 - NUMBERS.full) / (len(levels) - 1)))
        level[-1] = np.log(NUMBERS.full)
    else:
        level = norm.logpdf(levels, stated.oil_level, NUMBERS.level_tolerance)
        level -= logsumexp(level)
    there = None if stated.gas_preload is None else int(stated.gas_preload)
    gas = np.full(2, np.log(0.5)) if there is None else np.where(np.arange(2) == there, 0.0, -np.inf)
    return np.asarray(gas[:, None] + level)
