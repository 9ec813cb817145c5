"""State of a damper: oil level and share of the gas preload, each with an interval, from records of which nobody knows them.

A load cell that was set to zero with the damper in it lacks the force of the gas, as if the preload were lost. What tells
them apart is the rest of the gas: its stiffness, and that a damper without preload cavitates.
"""

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.posterior import NOTHING, Stated, StatePosterior, at_level, log_prior_fill, posterior
from twintube.diagnosis.shares import SHARES, Asked, Zeroed, log_share, nearest, ways
from twintube.diagnosis.sizes import LARGEST, Sizes

# Numerics of the grid.
WITHIN = (-0.02, -0.01, 0.0, 0.01)  # levels of a coarse cell that are looked at
COARSE = 0.04  # first step of the oil level
FINE = 0.01  # cells narrower than this are not divided
HALF, APART = 0.5, 0.25  # cells of the share of the gas no wider than this are not divided, in a sketch and else
STEP = 1.0  # change of the logarithm of the evidence above which a cell is divided
ROUGH = Sizes(4, 2, 4)
SKETCHED = [Sizes(law, own, lasting) for law, own in ((4, 2), (2, 1)) for lasting in (2, 4)]
# What a wrong state leaves is not to be taken for a damper far off its law.
BOUNDED = Sizes(4, 2, LARGEST.lasting_at)
ROUGHLY = 50.0  # logarithm of the odds, at usual sizes, below which a state is not looked at again
LOOKED_AT = 3  # levels at least, with and without preload, that are looked at again
ENOUGH = 8.0  # logarithm of the odds below which a cell of the oil level is not refined
LIKELY = 4.0  # the like of the share of the gas

Key = tuple[float, float]  # share of the gas, oil level


def steps(bench: Bench, force: Array, states: Array, which: Array, cell: float) -> Array:
    """What forces (n,) [N] are off within a `cell` of the grid of oil levels of the records `which` (r,)."""
    change = []
    for by in (-cell / 2.0, cell / 2.0):
        other = states.copy()
        other[which, 0] = np.clip(states[which, 0] + by, 0.0, 1.0)
        change.append(np.abs(bench.with_states(other) - force))
    # At the edge of a range in which nothing changes a state may lie on the quiet side.
    return np.asarray(np.min(change, axis=0) if cell <= FINE else np.max(change, axis=0))


def by_level(keys: Mapping[Key, object]) -> Iterator[tuple[float, list[float]]]:
    """Each oil level with the shares that were looked at there."""
    for level, several in itertools.groupby(sorted(keys, key=lambda key: (key[1], key[0])), key=lambda key: key[1]):
        yield level, [gas for gas, _ in several]


def cell(shares: Sequence[float], gas: float) -> NDArray[np.bool_]:
    """The shares (s,) to which one of `shares` is the nearest."""
    return np.asarray(np.abs(SHARES[:, None] - np.array(shares)).argmin(axis=1) == list(shares).index(gas))


def halves(found: Mapping[Key, Array], widest: float, least: float, further: float = 0.0) -> list[Key]:
    """The middles of cells of the share of the gas in which evidence (s,) changes, where it is more than `least`.

    It may be larger in between by as many times as it changes as `further` says.
    """
    wanted = []
    for level, shares in by_level(found):
        for a, b in itertools.pairwise(shares):
            inside = (a <= SHARES) & (b >= SHARES)
            at_a, at_b = found[a, level][inside], found[b, level][inside]
            # A simulation is right of its own share.
            along = (SHARES[inside] - a) / (b - a)
            change = 4.0 * along * (1.0 - along) * np.abs(at_a - at_b)
            if b - a > widest and np.any((change > STEP) & (np.maximum(at_a, at_b) + further * change > least)):
                wanted.append((0.5 * (a + b), level))
    return wanted


def between(found: Mapping[Key, Zeroed]) -> list[Key]:
    """The middles of cells in which the evidence changes, near its largest: what a sum over the grid still asks for."""
    prior = log_prior_fill()
    either = {key: z.either + prior for key, z in found.items()}
    levels = {level: (shares, np.logaddexp(*at_level(found, level)) + prior) for level, shares in by_level(found)}
    top = max(float(z.max()) for _, z in levels.values())
    wanted = halves(either, APART, top - LIKELY)
    for low, high in itertools.pairwise(levels):
        (shares, at_low), (others, at_high) = levels[low], levels[high]
        if high - low > FINE:
            changes = (np.maximum(at_low, at_high) > top - ENOUGH) & (np.abs(at_low - at_high) > STEP)
            several = sorted({*shares, *others})
            wanted += [(gas, round(0.5 * (low + high), 5)) for gas in several if changes[cell(several, gas)].any()]
    return wanted


def looked_at(rough: Mapping[Key, Array], stated: Stated) -> list[Key]:
    """The states that a sketch leaves."""
    best = max(float(z.max()) for z in rough.values())
    out: list[Key] = []
    near: dict[Key, float] = {}
    for level, shares in by_level(rough):
        several = np.array([rough[gas, level] for gas in shares])
        likely = several.max(axis=0) > best - ROUGHLY
        # Where the gas makes no difference to the fluid force one share says what all do.
        alike = bool(np.all(np.ptp(several[:, likely], axis=0) <= STEP)) if likely.any() else False
        first = max(shares, key=lambda gas: float(rough[gas, level][cell(shares, gas)].max()))
        own = {gas: float(rough[gas, level][nearest(gas)]) for gas in (0.0, 1.0)}
        near |= {(gas, level): z for gas, z in own.items() if gas == first or not alike}
        out += [(gas, level) for gas, z in own.items() if z > best - ROUGHLY and not alike]
        out += [(first, level)] if several.max() > best - ROUGHLY else []
    for gas in (0.0, 1.0):  # of each end the most likely, which a step may have hidden
        out += sorted((key for key in near if key[0] == gas), key=lambda key: -near[key])[:LOOKED_AT]
        # A state with a probability of its own is looked at by itself.
        out += [(gas, x) for x in {1.0, stated.oil_level} if x is not None]
    return out


def state(
    bench: Bench, which: Sequence[int], stated: Stated = NOTHING, progress: Callable[[str], None] = lambda text: None
) -> StatePosterior:
    """The state of the damper in the records `which` of one fill; the others keep theirs."""
    mine = np.zeros(len(bench.records), dtype=bool)
    mine[list(which)] = True

    # An error at a step of the force comes again in every oscillation, and tells as much as in one.
    once = bench.once()
    of_gas = ways(bench, mine)

    def frame(key: Key, cell: float = COARSE, used: NDArray[np.bool_] | None = once) -> tuple[Frame, Array]:
        states = bench.states.copy()
        states[mine, 0], states[mine, 1] = key[1], key[0]
        force = bench.with_states(states)
        step = steps(bench, force, states, mine, cell)
        return Frame(bench, states, step, bench.days, used), bench.measured - force

    def asked(key: Key, cell: float) -> Asked:
        here, errors = frame(key, cell)
        return Asked(here, np.column_stack([errors, of_gas]), key[0])

    def sketched(key: Key) -> Array:
        """Evidence (s,) at some sizes: what a state far off has is far less."""
        here = asked(key, COARSE)
        return np.asarray(np.max([np.logaddexp(*here.at(sizes)) for sizes in SKETCHED], axis=0) + log_prior_fill())

    def evidence(key: Key) -> Zeroed:
        return asked(key, FINE).integrated(ROUGH, BOUNDED)

    def sketches() -> dict[Key, Array]:
        """Evidence over the whole grid of oil levels, of more shares than the ends where these differ."""
        levels = np.arange(1.0, numbers().level_low - 1e-9, -COARSE)
        wanted = [(gas, round(float(x), 5)) for gas in (1.0, 0.0) for x in levels]
        rough: dict[Key, Array] = {}
        while wanted:
            rough.update(zip(wanted, bench.threads.map(sketched, wanted), strict=True))
            best = max(float(z.max()) for z in rough.values())
            wanted = halves(rough, HALF, best, further=1.0)
        return rough

    rough = sketches()
    likely = sorted(rough, key=lambda key: -float(rough[key].max()))[:LOOKED_AT]

    def noise(key: Key) -> Array:
        here, errors = frame(key, used=None)
        share = float(SHARES[rough[key].argmax()])
        errors = errors + (key[0] - share) * of_gas[:, 0]
        return bench.noise_in(here.left(errors, here.evidence(errors, ROUGH, BOUNDED).sizes))

    # What a wrong state leaves seldom repeats from oscillation to oscillation: its errors hold more than noise.
    repeats = np.min(list(bench.threads.map(noise, likely)), axis=0)
    bench.noisy(np.hypot(repeats, numbers().degraded * bench.peak))
    progress("comparing oil levels and shares of the gas")
    coarsely = looked_at(sketches(), stated)
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
    right, tared = frame.evidence(errors), frame.evidence(bench.tared(errors, which, bench.states[:, 1]))
    return tared.log_z + log_share(True) > right.log_z + log_share(False)
