"""What has happened since the reference, or what the model lacks: the probability of every hypothesis.

`none` is the model with its own error; what always acts belongs to it. `state` is another fill than stated, `unknown` a free
change of the model's error. All others are mechanisms, alone, two at once, or beside another fill. The fill is open to its
tolerance in each. The verdict follows from these probabilities, and from how records are predicted that were left out.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from math import comb

import numpy as np

from twintube.common.arrays import Array
from twintube.diagnosis.base import Base
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.channels import TARED
from twintube.diagnosis.found import Fill, Found
from twintube.diagnosis.heavy import evidence
from twintube.diagnosis.mechanisms import Mechanism, both, effects, faults
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.search import Search

NONE, STATE, UNKNOWN = "none", "state", "unknown"
MOST = 6  # mechanisms of a base
PAIRED = 5  # the most likely effects, of which two may act at once
CLOSE = 20.0  # logarithm of the odds, to which ways of an effect are looked at again; numerics
FAR = 300.0  # the like, from which a fill is not looked at further; numerics
WORTH = 1.0  # logarithm of the odds from which a change is compared with what always acts; numerics


@dataclass(frozen=True)
class Hypothesis:
    """What may be the case, and its probability."""

    name: str
    kind: str  # none | state | effect | fault | unknown
    log_evidence: float  # over that of `none`
    probability: float
    found: Found | None = None  # the most likely way; that of `none` and `state`, too
    search: Search | None = None  # in its fill


@dataclass(frozen=True)
class Changes:
    """All hypotheses, the most probable first; `search` is in the fill as stated."""

    hypotheses: tuple[Hypothesis, ...]
    base: tuple[Mechanism, ...]
    search: Search

    @property
    def credible(self) -> tuple[str, ...]:
        """The fewest hypotheses that hold 90 %."""
        total = np.cumsum([h.probability for h in self.hypotheses])
        return tuple(h.name for h in self.hypotheses[: int(np.searchsorted(total, numbers().credible)) + 1])


def mechanisms(bench: Bench, catalogue: Collection[str] | None = None) -> list[Mechanism]:
    """What may have happened: everything known, or what a `catalogue` names."""
    longest = max(float(np.ptp(r.time)) for r in bench.records)
    reach = max(float(np.abs(r.stroke).max()) for r in bench.records)
    p = bench.damper.parameters
    every = [*effects(reach), *faults(bench.peak, longest, p.F_FrS / p.F_0 if p.F_0 > 0.0 else 0.0)]
    every = [m for m in every if m.effect != TARED or p.F_0 > 0.0]
    return [m for m in every if catalogue is None or m.effect in catalogue]


def changes(
    bench: Bench,
    acting: Array,
    fills: Sequence[Fill],
    progress: Callable[[str], None] = lambda text: None,
    *,
    catalogue: Collection[str] | None = None,
) -> Changes:
    """The probability of all hypotheses about the samples `acting` (n,); the others are the reference.

    `fills` are as stated, and others that are likely. What a `catalogue` does not name cannot have happened.
    """
    bench.alone = False  # several hypotheses run side by side
    causes = mechanisms(bench, catalogue)
    names = list(dict.fromkeys(m.effect for m in causes))
    searches, base, found = beside_a_base(bench, acting, fills, causes, progress)
    stated = likeliest(searches)
    several = [(s, s.none) for s in searches]
    for lead in (stated, *doubted(searches, stated)):
        known = found if lead is stated else searched(lead, causes, progress)
        best = refined(lead, known, progress)
        several += [(lead, f) for f in (*known, *best)]
        top = sorted(best, key=weight, reverse=True)[:PAIRED]
        for other in (s for s in searches if s is not lead and s.fill.other == lead.fill.other):
            progress(f"in another fill: {other.fill.name}")
            likely = [f for f in top if weight(f) > weight(top[0]) - CLOSE]
            several += [(other, f) for f in bench.threads.map(partial(moved, other), likely)]
            # A cell that was set to zero with the damper in it is like a lost preload: it shows in the other fill.
            several += [(other, other.found(m)) for m in causes if m.effect == TARED]
    return concluded(stated, several, names, tuple(base.mechanisms))


def likeliest(searches: Sequence[Search]) -> Search:
    """The search in the likeliest fill that is as stated."""
    return max((s for s in searches if not s.fill.other), key=lambda s: s.none.log_z)


def doubted(searches: Sequence[Search], stated: Search) -> list[Search]:
    """The search in the likeliest other fill, where without any cause it explains the records better."""
    several = [s for s in searches if s.fill.other and s.none.log_z > stated.none.log_z]
    return [max(several, key=lambda s: s.none.log_z)] if several else []


def moved(search: Search, found: Found) -> Found:
    """A mechanism that was found in another fill."""
    at = np.concatenate([found.at[: len(found.mechanism.strengths)], search.none.at])
    return search.inexact(search.climbed(found.mechanism, at, found.sizes, search.frame.weighted(found.weights)))


def beside_a_base(
    bench: Bench, acting: Array, fills: Sequence[Fill], causes: Sequence[Mechanism], progress: Callable[[str], None]
) -> tuple[list[Search], Base, list[Found]]:
    """The searches in each fill beside what always acts, and what was found in the likeliest."""
    always = float(np.log(numbers().lacking / (1.0 - numbers().lacking) / max(1, len({m.effect for m in causes}))))
    base, every = Base(bench, acting, fills[0]), np.ones(len(acting), dtype=bool)
    while True:
        searches = in_fills(base, fills)
        lead = likeliest(searches)
        found = searched(lead, causes, progress)
        if acting.all() or len(base.mechanisms) == MOST:
            return searches, base, found
        # What all records show is no change.
        likely = [f.mechanism for f in found if f.log_z > lead.none.log_z + WORTH and not base.has(f.mechanism)]
        whole = Search(bench, lead.frame, every, lead.fill)
        best = max(searched(whole, likely, progress), key=weight, default=None)
        if best is None or weight(best) + always < max(lead.none.log_z, *(weight(f) for f in found)):
            return searches, base, found
        base.add(best)


def in_fills(base: Base, fills: Sequence[Fill]) -> list[Search]:
    """The search in each fill; one that is far from the likeliest of its kind is left as it is."""
    several = list(base.bench.threads.map(base.search, fills))
    best = {other: max((s.none.log_z for s in several if s.fill.other is other), default=0.0) for other in (False, True)}
    return list(base.bench.threads.map(lambda s: base.further(s) if s.none.log_z > best[s.fill.other] - FAR else s, several))


def searched(search: Search, causes: Sequence[Mechanism], progress: Callable[[str], None]) -> list[Found]:
    """The best strengths of some mechanisms."""

    def one(m: Mechanism) -> Found:
        progress(f"a single cause: {m.effect}")
        return search.found(m)

    return list(search.bench.threads.map(one, causes))


def refined(search: Search, found: Sequence[Found], progress: Callable[[str], None]) -> list[Found]:
    """What is most likely, looked at farther off, alone and two at once."""
    top: dict[str, list[Found]] = {}
    for f in sorted(found, key=weight, reverse=True):
        if f.log_z > search.none.log_z + WORTH and (len(top) < PAIRED or f.mechanism.effect in top):
            top.setdefault(f.mechanism.effect, []).append(f)
    progress("the likeliest causes again, and farther off")
    some = [f for ways in top.values() for f in ways if f.log_z > ways[0].log_z - CLOSE]
    again: dict[str, Found] = {}
    for f in search.bench.threads.map(search.again, some):
        again[f.mechanism.effect] = max(again.get(f.mechanism.effect, f), f, key=weight)
    alone = list(search.bench.threads.map(search.refined, again.values()))
    alone.sort(key=weight, reverse=True)
    # Ways of one effect may act together, as stops at both ends do.
    pairs = [(alone[0], f) for f in alone[1:]]
    pairs += [(a, b) for f in alone[:1] for a, b in combinations(top[f.mechanism.effect][:3], 2)]
    pairs = [(a, b) for a, b in pairs if not {*a.values} & {*b.values}]

    def two(pair: tuple[Found, Found]) -> Found:
        a, b = pair
        progress(f"two at once: {a.mechanism.effect}+{b.mechanism.effect}")
        k = len(a.mechanism.strengths)
        u = np.concatenate([a.at[:k], b.at[: len(b.mechanism.strengths)], a.at[k:]])
        return search.inexact(search.climbed(both(a.mechanism, b.mechanism), u, a.sizes, search.frame.weighted(a.weights)))

    together = list(search.bench.threads.map(two, pairs))
    return [*alone, *together]


def headline(stated: Search, search: Search, found: Found) -> str:
    """What is the case, largest first, without what does next to nothing beside the largest."""
    sizes: dict[str, float] = {}
    if search.fill.other:
        filled = search.bench.forces(stated.filled(np.zeros(len(stated.fill.levels))))
        sizes[STATE] = rms(search, found.base - filled)
    k, begin = len(found.mechanism.strengths), 0
    for part in found.mechanism.parts or (found.mechanism,):
        end = begin + len(part.strengths)
        without, with_it = search.forces(part, np.concatenate([found.at[begin:end], found.at[k:]]))
        sizes[part.effect] = max(sizes.get(part.effect, 0.0), rms(search, with_it - without))
        begin = end
    noise = float(np.sqrt(np.mean(search.bench.sigma[search.acting & search.bench.used] ** 2)))
    least = numbers().slight * max(noise, *sizes.values())
    return "+".join(name for name, size in sizes.items() if name != NONE and size >= least) or NONE


def rms(search: Search, force: Array) -> float:
    """Root mean square [N] of forces (n,) [N] where something may have happened."""
    return float(np.sqrt(np.mean(force[search.acting & search.bench.used] ** 2)))


def concluded(
    stated: Search, several: Sequence[tuple[Search, Found]], names: Sequence[str], base: tuple[Mechanism, ...]
) -> Changes:
    """Probabilities from what was found in each fill; the evidence of each has the prior of its fill."""
    prior = priors(names)
    # Of a way that was found twice in a fill the better.
    best: dict[tuple[str, str], tuple[Search, Found]] = {}
    for search, f in several:
        key = search.fill.name, f.mechanism.way
        best[key] = max(best.get(key, (search, f)), (search, f), key=lambda one: weight(one[1]))
    groups: dict[str, list[tuple[Search, Found]]] = {NONE: []}
    log_p: dict[str, float] = {NONE: -np.inf, UNKNOWN: float(np.log(prior(UNKNOWN))) + best_none(best) + free(stated)}
    for search, f in best.values():
        name = headline(stated, search, f)
        groups.setdefault(name, []).append((search, f))
        own = float(np.log(prior(f.mechanism.effect)))
        log_p[name] = float(np.logaddexp(log_p.get(name, -np.inf), weight(f) + own))
    total = float(np.logaddexp.reduce(list(log_p.values())))
    offset = log_p[NONE] - float(np.log(prior(NONE)))  # so that probability is prior times evidence for each
    out = []
    for name, z in log_p.items():
        search, found = max(groups.get(name, [(stated, stated.none)]), key=lambda one: weight(one[1]))
        kind = name if name in (NONE, STATE, UNKNOWN) else kind_of(name, found)
        log_evidence = z - float(np.log(prior(name))) - offset
        known = None if name == UNKNOWN else found
        out.append(Hypothesis(name, kind, log_evidence, float(np.exp(z - total)), known, search))
    return Changes(tuple(sorted(out, key=lambda h: -h.probability)), base, stated)


def best_none(best: Mapping[tuple[str, str], tuple[Search, Found]]) -> float:
    """The evidence of nothing in the fills as stated."""
    several = [f.log_z for search, f in best.values() if f.mechanism.kind == "none" and not search.fill.other]
    return float(np.logaddexp.reduce(several))


def kind_of(name: str, found: Found) -> str:
    """Whether what is named is of the damper or of the bench."""
    several = [m for m in found.mechanism.parts or (found.mechanism,) if m.effect in name.split("+")]
    return "effect" if any(m.kind == "effect" for m in several) else "fault"


def weight(found: Found) -> float:
    """Evidence of a mechanism with its share of the prior of its effect."""
    return found.log_z + found.mechanism.log_odds


def free(search: Search) -> float:
    """Evidence over that of `none` of a free change of the model's error where something may have happened."""
    bench, none = search.bench, search.none
    shared = np.vstack([s for s, _, _ in bench.contributions(bench.states, known=True)])
    fixed = search.frame.fixed_shared(shared.shape[1])
    errors = bench.measured - none.force
    found = []
    for size in numbers().change_sizes:
        columns = shared * search.acting[:, None] * np.where(fixed, 1.0, size)
        found.append(evidence(search.weighted, np.column_stack([errors, columns]), none.sizes).log_z)
    alone = evidence(search.weighted, errors[:, None], none.sizes).log_z
    return float(np.logaddexp.reduce(found) - np.log(len(found))) - alone


def priors(names: Sequence[str]) -> Callable[[str], float]:
    """Prior probability of a hypothesis; `names` are single mechanisms, all others two of them. Fills have their own."""
    n = numbers()
    singles = [name for name in names if name != TARED]
    rest = 1.0 - n.unchanged - n.other
    tared = n.tared if TARED in names else 0.0  # of what is else as it was
    known = {NONE: (1.0 - tared) * n.unchanged, TARED: tared * n.unchanged, UNKNOWN: n.other}
    one = (1.0 - n.two) * rest / max(1, len(singles))
    two = n.two * rest / max(1, comb(len(singles), 2))

    def prior(name: str) -> float:
        cause = name.removeprefix(f"{STATE}+") if name != STATE else NONE
        return known.get(cause, one if cause in names else two)

    return prior
