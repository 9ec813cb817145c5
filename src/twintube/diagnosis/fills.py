"""The fills that a hypothesis may have: as stated, and others that are likely."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from scipy.stats import norm

from twintube.dampers.freed_gas import DEFAULT, VARIED, has_own, values_of
from twintube.diagnosis.answer import StateAnswer
from twintube.diagnosis.bench import GAS, LEVEL, Bench
from twintube.diagnosis.found import Fill
from twintube.diagnosis.mechanisms import OPEN, Strength
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.posterior import StatePosterior, log_prior_fill
from twintube.diagnosis.records.seen import DELAY
from twintube.diagnosis.shares import nearest

LEAST_LEVEL = 0.05  # [1] numerics
MOST_DELAY = 0.02  # [s] numerics


def as_filled(
    bench: Bench,
    name: str,
    other: Mapping[str, tuple[float, float]] | None = None,
    log_prior: float = 0.0,
    wide: Mapping[str, float] | None = None,
) -> Fill:
    """The fill of a bench, levels open to the tolerance of a fill; of some states another preload and level.

    When and how fast the force is seen to step is open beside it.

    `wide` are standard deviations of levels that nobody has stated.
    """
    other = other or {}
    levels, values = [], {}
    for label, which in bench.labels.items():
        gas, level = other.get(label, (float(bench.states[which][0, 1]), float(bench.states[which][0, 0])))
        if label in other:
            values[f"{GAS}:{label}"] = gas
        if level < 1.0 or label in other:
            scale = (wide or {}).get(label, numbers().level_tolerance)
            levels.append(Strength(f"{LEVEL}:{label}", "normal", scale, level, LEAST_LEVEL, 1.0))
    delay = Strength(DELAY, "normal", bench.delayed, 0.0, -MOST_DELAY, MOST_DELAY)
    return Fill((*levels, delay, *OPEN), values, log_prior, name)


def spread(known: StatePosterior) -> float:
    """Standard deviation of a level that the records tell, no less than the tolerance of a fill."""
    low, high = known.interval()
    return max(numbers().level_tolerance, (high - low) / (2.0 * float(norm.ppf(0.95))))


def likely_fills(bench: Bench, several: Sequence[StateAnswer] = ()) -> list[Fill]:
    """The fill as stated, and the likeliest other one of those states that may be another; what freed gas does is open.

    Nobody has measured that. Where the parameter set states it, it is as stated.
    """
    n = numbers()
    told = [one for one in several if one.stated.anything]
    doubtful = [one for one in told if one.posterior.as_stated < n.credible]
    wide = {one.state: spread(one.posterior) for one in several if not one.stated.anything}
    out = [as_filled(bench, "as_stated", None, float(np.log(1.0 - n.misstated)) if told else 0.0, wide)]
    # Of a fill that nobody knows the share of the gas may be another.
    for one in several:
        probability, *other = one.posterior.otherwise
        if not one.stated.anything and probability > n.implausible:
            out.append(as_filled(bench, one.state, {one.state: (other[0], other[1])}, out[0].log_prior))
    if doubtful:
        # Anywhere between the least level and all oil, with any share of the gas: the part of it that tolerances hold.
        share = np.sqrt(2.0 * np.pi) * n.level_tolerance / (1.0 - n.level_low)
        free = {one.state: one.posterior.free for one in doubtful}
        log_prior = float(np.log(n.misstated) + len(free) * np.log((1.0 - n.full) * share))
        log_prior += sum(float(log_prior_fill()[nearest(gas)]) for gas, _ in free.values())
        other_fill = as_filled(bench, "another", free, log_prior, wide)
        out.append(replace(other_fill, other=True))
    ways = [{}] if has_own(bench.given) else [{}, *(values_of(name) for name in VARIED if name != DEFAULT)]
    return [
        replace(
            fill, values={**fill.values, **way}, log_prior=fill.log_prior - float(np.log(len(ways))),
            name=f"{fill.name} {i}",
        )
        for i, way in enumerate(ways)
        for fill in out
    ]  # fmt: skip
