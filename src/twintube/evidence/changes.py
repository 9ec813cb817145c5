"""What has happened since the reference, or what the model lacks: the probability of every hypothesis.

`none` is the model with its own error; what always acts belongs to it. `state` is another fill than stated, `unknown` a free
change of the model's error. `tared_cell` is `none` with a load cell that was set to zero with the damper in it, as likely as
the state has it. All others are mechanisms. The verdict follows from these probabilities alone.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from math import comb

import numpy as np
from scipy.optimize import lsq_linear
from scipy.stats import norm

from twintube.common.arrays import Array
from twintube.diagnosis.channels import TARED
from twintube.evidence.base import Base
from twintube.evidence.bench import CHANNELS, Bench
from twintube.evidence.mechanisms import Mechanism, both, effects, faults, unit_of
from twintube.evidence.numbers import NUMBERS
from twintube.evidence.search import Found, Search
from twintube.evidence.state import StatePosterior

NONE, STATE, UNKNOWN = "none", "state", "unknown"
MOST = 6  # mechanisms of a base
PAIRED = 5  # the most likely mechanisms, of which two may act at once
LEAST = 1e-12  # probability, for a logarithm; numerics
WORTH = 1.0  # logarithm of the odds from which a change is compared with what always acts; numerics


@dataclass(frozen=True)
class Hypothesis:
    """What may be the case, and its probability."""

    name: str
    kind: str  # none | state | effect | fault | unknown
    log_evidence: float  # over that of `none`
    probability: float
    found: Found | None = None  # of mechanisms the most likely


@dataclass(frozen=True)
class Changes:
    """All hypotheses, the most probable first."""

    hypotheses: tuple[Hypothesis, ...]
    base: tuple[Mechanism, ...]
    search: Search

    @property
    def credible(self) -> tuple[str, ...]:
        """The fewest hypotheses that hold 90 %."""
        total = np.cumsum([h.probability for h in self.hypotheses])
        return tuple(h.name for h in self.hypotheses[: int(np.searchsorted(total, NUMBERS.credible)) + 1])


def mechanisms(bench: Bench, catalogue: Collection[str] | None = None) -> list[Mechanism]:
    """What may have happened: everything known, or what a `catalogue` names."""
    longest = max(float(np.ptp(r.time)) for r in bench.records)
    reach = max(float(np.abs(r.stroke).max()) for r in bench.records)
    every = [*effects(reach), *faults(bench.peak, longest)]
    return [m for m in every if catalogue is None or m.effect in catalogue]


def changes(
    bench: Bench,
    acting: Array,
    stated: Sequence[StatePosterior],
    tared: Sequence[float] = (),
    progress: Callable[[str], None] = lambda text: None,
    *,
    catalogue: Collection[str] | None = None,
) -> Changes:
    """The probability of all hypotheses about the samples `acting` (n,); the others are the reference.

    `stated` are the states of those records whose file states them, `tared` the probabilities that the load cell was set to
    zero with the damper in it, in each state that is as its file says. What a `catalogue` does not name
    cannot have happened.
    """
    causes = mechanisms(bench, catalogue)
    names = list(dict.fromkeys(m.effect for m in causes))
    always = float(np.log(NUMBERS.lacking / (1.0 - NUMBERS.lacking) / len(names)))
    base, every = Base(bench, acting), np.ones(len(acting), dtype=bool)
    found: dict[Mechanism, Found] = {}
    while True:
        search = base.search()
        found = searched(search, causes, found, progress)
        if acting.all() or len(base.mechanisms) == MOST:
            break
        # What all records show is no change.
        likely = [m for m in causes if found[m].log_z > search.none.log_z + WORTH and not base.has(m)]
        whole = Search(bench, search.frame, every)
        also = searched(whole, likely, found, progress)
        best = max(also.values(), key=weight, default=None)
        if best is None or weight(best) + always < max(search.none.log_z, *(weight(f) for f in found.values())):
            break
        base.add(best)
    evidence = {NONE: 0.0, UNKNOWN: free(search)}
    if stated:
        evidence[STATE] = float(-sum(s.log_odds_stated for s in stated))
    slight = {m: slightly(search, f) for m, f in found.items()}
    singles = list(names)
    for f in two_at_once(search, [f for m, f in found.items() if not slight[m]], progress):
        found[f.mechanism], slight[f.mechanism] = f, False
        names.append(f.mechanism.effect)
    for name in names:
        some = [weight(f) for m, f in found.items() if m.effect == name and not slight[m]]
        evidence[name] = float(np.logaddexp.reduce(some, initial=-np.inf)) - search.none.log_z
    prior = priors(singles, list(evidence))
    log_p = {name: z + float(np.log(prior[name])) for name, z in evidence.items()}
    # What is too slight for the channels is nothing, in the fill that is stated and in another.
    nothing = [weight(f) - search.none.log_z + np.log(prior[m.effect]) for m, f in found.items() if slight[m]]
    with_slight = float(np.logaddexp.reduce([log_p[NONE], *nothing])) - log_p[NONE]
    for name in (NONE, STATE):
        if name in log_p:
            log_p[name] += with_slight
    if tared:
        right = float(np.prod(1.0 - np.clip(tared, LEAST, 1.0 - LEAST)))
        log_p[TARED] = log_p[NONE] + float(np.log(1.0 - right))
        log_p[NONE] += float(np.log(right))
    prior = priors(singles, list(log_p))
    total = float(np.logaddexp.reduce(list(log_p.values())))
    offset = log_p[NONE] - float(np.log(prior[NONE]))  # so that probability is prior times evidence for each
    several = []
    for name, z in log_p.items():
        own = [f for m, f in found.items() if m.effect == name]
        kind = own[0].mechanism.kind if own else "fault" if name == TARED else name
        best = max(own, key=weight) if own else None
        log_evidence = z - float(np.log(prior[name])) - offset
        several.append(Hypothesis(name, kind, log_evidence, float(np.exp(z - total)), best))
    return Changes(tuple(sorted(several, key=lambda h: -h.probability)), tuple(base.mechanisms), search)


def searched(
    search: Search, several: Sequence[Mechanism], near: Mapping[Mechanism, Found], progress: Callable[[str], None]
) -> dict[Mechanism, Found]:
    """The best strengths of some mechanisms, sought from those found before."""
    out = {}
    for m in several:
        progress(f"a single cause: {m.effect}")
        out[m] = search.found(m, near.get(m))
    return out


def two_at_once(search: Search, several: Sequence[Found], progress: Callable[[str], None]) -> list[Found]:
    """The most likely mechanism together with each of the next, of other effects."""
    best: dict[str, Found] = {}
    for f in sorted(several, key=weight, reverse=True):
        if f.log_z > search.none.log_z + WORTH:
            best.setdefault(f.mechanism.effect, f)
    likely = list(best.values())[:PAIRED]
    out = []
    for first, f in ((likely[0], f) for f in likely[1:]):
        if {*first.values} & {*f.values}:
            continue
        progress(f"two causes: {first.mechanism.effect}+{f.mechanism.effect}")
        start = replace(first, at=np.concatenate([first.at, f.at]))
        pair = search.found(both(first.mechanism, f.mechanism), start)
        if apart(search, pair, len(first.at)):
            out.append(pair)
    return out


def apart(search: Search, pair: Found, k: int) -> bool:
    """Whether each of two causes, the first of which has `k` strengths, does more than the law of the other may be off."""
    a, b = pair.mechanism.parts
    alone = [rms(search, search.force(m.about(search.bench.usual), u)) for m, u in ((a, pair.at[:k]), (b, pair.at[k:]))]
    return min(alone) > NUMBERS.law_of_cause * max(alone)


def rms(search: Search, force: Array) -> float:
    """Root mean square [N] of what forces (n,) [N] differ by where something may have happened."""
    return float(np.sqrt(np.mean((force - search.base)[search.acting & search.bench.used] ** 2)))


def slightly(search: Search, found: Found) -> bool:
    """Whether a mechanism does no more than the zero of a load cell, apart from what good channels do by themselves."""
    bench, rest = search.bench, found.force - search.base
    least = NUMBERS.zero * bench.peak
    if rms(search, found.force) < least or shorter(found, float(np.median([r.period for r in bench.records]))):
        return True
    several = bench.contributions(bench.states)
    usual = float(norm.ppf(0.5 + 0.5 * NUMBERS.credible))  # standard deviations
    for at, (_, own, _) in zip(bench.slices, several, strict=True):
        rows = at.start + np.flatnonzero((search.acting & bench.used)[at])
        if len(rows) > CHANNELS and np.any(rest[rows]):
            columns = own[rows - at.start, :CHANNELS]
            rest[rows] -= columns @ lsq_linear(columns, rest[rows], (-usual, usual)).x
    return rms(search, search.base + rest) < least


def shorter(found: Found, period: float) -> bool:
    """Whether a mechanism makes the force late by less than a sample [s]: what a channel does within one nobody knows."""
    strengths = [s for s in found.mechanism.strengths if s.kind in ("half", "normal")]
    times = [abs(found.values[s.name]) for s in strengths if unit_of(s.name) == "s"]
    return len(times) == len(strengths) and max(times) < period


def weight(found: Found) -> float:
    """Evidence of a mechanism with its share of the prior of its effect."""
    return found.log_z + found.mechanism.log_odds


def free(search: Search) -> float:
    """Evidence over that of `none` of a free change of the model's error where something may have happened."""
    bench = search.bench
    shared = np.vstack([s for s, _, _ in bench.contributions(bench.states)])
    scale = search.frame.fixed_shared(shared.shape[1])
    errors = bench.measured - search.base
    found = []
    for size in NUMBERS.change_sizes:
        columns = shared * search.acting[:, None] * np.where(scale, 1.0, size)
        found.append(search.frame.evidence(np.column_stack([errors, columns]), search.none.sizes).log_z)
    return float(np.logaddexp.reduce(found) - np.log(len(found))) - search.none.log_z


def priors(names: Sequence[str], asked: Sequence[str]) -> dict[str, float]:
    """Prior probability of each hypothesis; `names` are single mechanisms, others that are not known are two of them."""
    n = NUMBERS
    rest = 1.0 - n.unchanged - n.other - n.misstated
    tared = n.tared if TARED in asked else 0.0  # of what is else as it was
    out = {NONE: (1.0 - tared) * n.unchanged, TARED: tared * n.unchanged, UNKNOWN: n.other, STATE: n.misstated}
    one = (1.0 - n.two) * rest / len(names)
    two = n.two * rest / comb(len(names), 2)
    return {name: out.get(name, one if name in names else two) for name in asked}
