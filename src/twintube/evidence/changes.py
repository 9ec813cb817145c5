"""What has happened since the reference, or what the model lacks: the probability of every hypothesis.

`none` is the model with its own error; what always acts belongs to it. `state` is another fill than stated, `unknown` a free
change of the model's error. All others are mechanisms. The verdict follows from these probabilities alone.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from twintube.arrays import Array
from twintube.evidence.base import Base
from twintube.evidence.bench import Bench
from twintube.evidence.mechanisms import Mechanism, effects, faults
from twintube.evidence.numbers import NUMBERS
from twintube.evidence.search import Found, Search
from twintube.evidence.state import StatePosterior

NONE, STATE, UNKNOWN = "none", "state", "unknown"
MOST = 6  # mechanisms of a base
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


def mechanisms(bench: Bench) -> list[Mechanism]:
    """Everything in the catalogue."""
    longest = max(float(np.ptp(r.time)) for r in bench.records)
    return [*effects(), *faults(bench.peak, longest)]


def changes(
    bench: Bench, acting: Array, stated: Sequence[StatePosterior], progress: Callable[[str], None] = lambda text: None
) -> Changes:
    """The probability of all hypotheses about the samples `acting` (n,); the others are the reference.

    `stated` are the states of those records whose file states them.
    """
    catalogue = mechanisms(bench)
    names = list(dict.fromkeys(m.effect for m in catalogue))
    always = float(np.log(NUMBERS.lacking / (1.0 - NUMBERS.lacking) / len(names)))
    base, every = Base(bench, acting), np.ones(len(acting), dtype=bool)
    found: dict[Mechanism, Found] = {}
    while True:
        search = base.search()
        found = searched(search, catalogue, found, progress)
        if acting.all() or len(base.mechanisms) == MOST:
            break
        # What all records show is no change.
        likely = [m for m in catalogue if found[m].log_z > search.none.log_z + WORTH and not base.has(m)]
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
    for name in names:
        some = [weight(f) for m, f in found.items() if m.effect == name and not slight[m]]
        evidence[name] = float(np.logaddexp.reduce(some, initial=-np.inf)) - search.none.log_z
    prior = priors(names, list(evidence))
    log_p = {name: z + float(np.log(prior[name])) for name, z in evidence.items()}
    # What is too slight for the load cell is nothing.
    nothing = [weight(f) - search.none.log_z + np.log(prior[m.effect]) for m, f in found.items() if slight[m]]
    log_p[NONE] = float(np.logaddexp.reduce([log_p[NONE], *nothing]))
    total = float(np.logaddexp.reduce(list(log_p.values())))
    several = []
    for name, z in evidence.items():
        own = [f for m, f in found.items() if m.effect == name]
        kind = own[0].mechanism.kind if own else name
        best = max(own, key=weight) if own else None
        several.append(Hypothesis(name, kind, z, float(np.exp(log_p[name] - total)), best))
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


def slightly(search: Search, found: Found) -> bool:
    """Whether the force that a mechanism changes, RMS, is below the zero of the load cell."""
    change = (found.force - search.base)[search.acting & search.bench.used]
    return bool(np.sqrt(np.mean(change**2)) < NUMBERS.zero * search.bench.peak)


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
    """Prior probability of each hypothesis."""
    n = NUMBERS
    out = {NONE: n.unchanged, UNKNOWN: n.other, STATE: n.misstated}
    rest = 1.0 - sum(out.values())
    return {name: out.get(name, rest / len(names)) for name in asked}
