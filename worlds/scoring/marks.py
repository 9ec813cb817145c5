"""One answer against its truth. A dataset without an answer has no mark that is right, and none that is a wrong name.

Pairs: a verdict is right that names both. To the probabilities each of the two counts as right, as does `a+b`.
"""

import math
from collections.abc import Iterable
from typing import Final

import numpy as np

from worlds.scoring.answer import Fill, parts
from worlds.scoring.pairs import Pair
from worlds.scoring.truth import UNKNOWN

NOTHING: Final = frozenset({"none", UNKNOWN})  # names that accuse nothing
# Some hundred datasets cannot show odds of more than a thousand to one to be right: a surer error costs no more.
SUREST: Final = 1e-3
NARROW: Final = 0.1  # [1] widest interval of an oil level that is of use, where the force tells it
FULL: Final = Fill(1.0, 1.0, 1.0, 0.0)
EVEN: Final = 0.5  # probability of the one and the other


def holds(names: Iterable[str], pair: Pair) -> bool:
    """Whether some names hold the truth; of two causes both, or the two as one name."""
    members = {parts([name]) for name in names}
    both = pair.truth.wanted in members or all(frozenset({name}) in members for name in pair.truth.wanted)
    return both or any(frozenset({name}) in members for name in pair.truth.also_fits)


def right_alone(pair: Pair) -> bool:
    """The verdict names what is hidden, and nothing else."""
    named = pair.answer.named
    return pair.answer.alone and (named == pair.truth.wanted or any(named == {name} for name in pair.truth.also_fits))


def wrong_alone(pair: Pair) -> bool:
    """The verdict stands by a name that is not hidden; `none` and `unknown` are no names."""
    return pair.answer.alone and bool(pair.answer.named - NOTHING - pair.truth.names)


def missed(pair: Pair) -> bool:
    """The verdict is that nothing has changed."""
    return pair.answer.verdict in ("none", "tolerance")


def fill_alone(pair: Pair) -> bool:
    """Whether the fill was asked, and nothing else was asked or hidden: its figures say how that was answered."""
    return pair.answer.only_fill or (pair.truth.kind == "state" and pair.truth.stated_as_full is False)


def accused(pair: Pair) -> bool:
    """Something is named that is not hidden, alone or in a set without `none`: what a good damper must not hear."""
    return bool(pair.answer.named - NOTHING - pair.truth.names) and not pair.answer.named & pair.truth.names


def truth_probability(pair: Pair) -> float:
    """Probability of all names that are right."""
    return min(sum(p for name, p in pair.answer.probabilities.items() if parts([name]) <= pair.truth.names), 1.0)


def log_score(pair: Pair) -> float:
    """Logarithm of the truth's probability [nats]."""
    return math.log(max(truth_probability(pair), SUREST))


def brier(pair: Pair) -> float:
    """Sum of squares over all names, 0 to 2; those that are right count as one."""
    others = [p for name, p in pair.answer.probabilities.items() if not parts([name]) <= pair.truth.names]
    return (1.0 - truth_probability(pair)) ** 2 + sum(p**2 for p in others)


def top(pair: Pair) -> tuple[float, bool]:
    """The largest probability, and whether its name is right."""
    p = pair.answer.probabilities
    name = max(p, key=lambda key: p[key])
    return p[name], parts([name]) <= pair.truth.names


def top_right(pair: Pair) -> bool:
    """Whether the likeliest name is right."""
    return bool(pair.answer.probabilities) and top(pair)[1]


def fill(pair: Pair) -> Fill | None:
    """The fill of the later records; of one that the file states as full, and the answer leaves at that, the stated."""
    if pair.answer.fills:
        return pair.answer.fills[-1]
    return FULL if pair.answer.given and pair.truth.stated_as_full else None


def preload_right(pair: Pair) -> bool:
    """Whether the gas is where the answer says."""
    told = fill(pair)
    return told is not None and (told.gas_lost < EVEN) == pair.truth.gas_preload


def level_inside(pair: Pair) -> bool:
    """Whether the interval holds the oil level, up to the digits of the file."""
    told, level = fill(pair), pair.truth.oil_level
    return told is not None and level is not None and told.low - 1e-4 <= level <= told.high + 1e-4


def level_narrow(pair: Pair) -> bool:
    """Whether the interval is at most NARROW wide."""
    told = fill(pair)
    return told is not None and told.high - told.low <= NARROW + 1e-9


def level_log_score(pair: Pair) -> float | None:
    """Logarithm of the density at the true oil level [nats]; 0 is that of a level anywhere from 0 to 1."""
    told = fill(pair)
    if told is None or told.grid is None or pair.truth.oil_level is None:
        return None
    levels, density = map(np.asarray, told.grid)
    at = float(np.interp(pair.truth.oil_level, levels, density / np.trapezoid(density, levels), left=0.0, right=0.0))
    return math.log(max(at, SUREST))
