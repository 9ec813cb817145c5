"""Records that do not belong to the others: of another damper, setting or fill than stated, or with a fault of their own."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import minimize_scalar

from twintube.common.words import lower
from twintube.diagnosis.channels import FAULTS, ChannelFault, faults
from twintube.diagnosis.measurement.faults import STRANGER, Fault, unit_error
from twintube.diagnosis.measurement.jitter import with_uncertainty
from twintube.diagnosis.problem import Problem
from twintube.diagnosis.records.seen import STROKE_GAIN
from twintube.diagnosis.rules import RULES

GAINS = ("force_gain", STROKE_GAIN)  # of a single record: another setting of the damper looks like it


def odd_records(problem: Problem) -> tuple[Fault | None, Problem]:
    """The few records that the model contradicts while it explains all others, and the problem without them."""
    odd, sure, usual, beyond = contradicting(problem)
    if not odd:
        return None, problem
    part = problem.with_records([problem.records[i] for i in odd])
    others = problem.with_records([r for i, r in enumerate(problem.records) if i not in odd])
    names = tuple(record.name for record in part.records)
    if not sure:  # a cause may act in some records alone, but makes none of another unit
        fault = own_unit(part, names, usual)
        return (fault, others) if fault is not None else (None, problem)
    fault = own_fault(part, names, faults(problem))
    if fault is not None and fault.effect == "force_offset" and with_the_gas(problem, odd):
        return None, problem
    gain = fault is not None and len(names) == 1 and fault.effect in GAINS
    if fault is None or gain:
        zero = RULES.small_zero * max(record.peak for record in problem.records)
        least = RULES.odd_little if beyond >= RULES.odd_clear else RULES.odd_force
        if all(record.intact for record in part.records):  # no fill may be to blame
            least = RULES.odd_intact
        apart = differ(part, least, zero) if fault is None else abs(fault.factor - 1.0) >= least
        filled = own_fill(part, names) if fault is None else None
        other = stranger(part, names) if fault is None else scaled_stranger(fault)
        fault = filled or (other if apart else None)
    return (fault, others) if fault is not None else (None, problem)


def with_the_gas(problem: Problem, odd: Sequence[int]) -> bool:
    """Whether several records are all that have their gas, or all that lost it: its force may be another than stated."""
    intact = [i for i, record in enumerate(problem.records) if record.intact]
    degraded = [i for i, record in enumerate(problem.records) if not record.intact]
    return len(odd) > 1 and list(odd) in (intact, degraded)


def contradicting(problem: Problem) -> tuple[Sequence[int], bool, float, float]:
    """The numbers of the fewest records without which the model is right; none where it is right or that does not help.

    Also whether that is sure, the largest misfit of all others, and how many times that these have. What is far beyond them
    needs no right model.
    """
    misfit = problem.misfits(problem.residual({}))
    logs = problem.counts * np.log(np.maximum(RULES.least_misfit, misfit))
    order, share = np.argsort(-misfit), np.array(shares(problem))
    for count in range(1, int(RULES.odd_share * len(misfit)) + 1):
        odd, rest = order[:count], order[count:]
        usual = max(1.0, float(misfit[rest].max()))
        right = logs[rest].sum() <= RULES.right * problem.counts[rest].sum()
        beyond = misfit[odd].min() / usual
        # The noise of a record that does not belong is overestimated: its error's share of the force tells, too.
        apart = share[odd].min() >= RULES.odd_apart * share[rest].max()
        if beyond >= (RULES.odd if right or apart else RULES.odd_unit):
            return sorted(odd.tolist()), bool(right or apart or beyond >= RULES.odd_far), usual, float(beyond)
    return [], False, 1.0, 0.0


def shares(problem: Problem) -> list[float]:
    """Root mean square errors of the records' compared intervals, shares of their peak forces."""
    errors = problem.errors({})
    return [
        float(np.sqrt(np.mean(errors[a:b][record.judged] ** 2))) / record.peak if record.judged.any() else 0.0
        for record, a, b in zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True)
    ]


def spreads(problem: Problem) -> list[float]:
    """Shares of the records' compared intervals in which the model is off, beyond a zero as other records have."""
    errors = problem.errors({})
    off = np.abs((errors - problem.zeros(errors)) * problem.weight) > RULES.odd_off
    return [
        float(off[a:b][record.judged].mean()) if record.judged.any() else 0.0
        for record, a, b in zip(problem.records, problem.starts[:-1], problem.starts[1:], strict=True)
    ]


def own_unit(part: Problem, names: tuple[str, ...], usual: float = 1.0) -> Fault | None:
    """The other unit in which the model explains these records as well as others, whose misfits are up to `usual`."""
    wrong, put_right = unit_error(part)
    if wrong is None or wrong.records:
        return None
    # Noise and steps were read in the wrong unit.
    if not right(with_uncertainty(put_right), {}, usual):
        return None
    of = f"In {', '.join(names)}: {wrong.explanation[0].lower()}{wrong.explanation[1:]}"
    return Fault(wrong.effect, wrong.title, of, wrong.factor, records=names)


def own_fault(part: Problem, names: tuple[str, ...], several: Sequence[ChannelFault]) -> Fault | None:
    """The fault of the measurement that explains these records, if any does that is larger than every measurement has."""
    unit = own_unit(part, names)
    if unit is not None:
        return unit
    best: tuple[float, ChannelFault, float] | None = None
    for f in several:

        def cost(x: float, name: str = f.name) -> float:
            return float(np.sum(part.residual({name: x}) ** 2))

        shares = (0.0, *RULES.shares, 1.0)
        grid = sorted(f.neutral + share * side for share in shares for side in (f.high - f.neutral, f.low - f.neutral))
        at = int(np.argmin([cost(x) for x in grid]))
        ends = grid[max(0, at - 2)], grid[min(len(grid) - 1, at + 2)]
        value = float(minimize_scalar(cost, bounds=ends, method="bounded", options={"xatol": 1e-4 * (f.high - f.low)}).x)
        acts = abs(value - f.neutral) > f.usual
        if acts and right(part, {f.name: value}) and (best is None or cost(value) < best[0]):
            best = (cost(value), f, value)
    if best is None:
        return None
    _, f, value = best
    known = FAULTS[f.name]
    text = f"In {', '.join(names)}: {lower(known.acts)}"
    spread = RULES.channel_width * abs(value - f.neutral)
    return Fault(f.name, known.title, text, value, f.name, known.unit, names, spread=spread)


def own_fill(part: Problem, names: tuple[str, ...]) -> Fault | None:
    """Another fill, far from the recorded one, at which the model explains a single record; without preload, as measured."""
    if len(names) > 1:
        return None
    (record,) = part.records

    def misfit(level: float) -> float:
        other = part.with_records([replace(record, oil_level=level, gas_preload=0)])
        return float(other.misfits(other.residual({}))[0])

    low, high, step = RULES.odd_fills
    start = min(np.arange(low, high, step).tolist(), key=misfit)
    level = float(minimize_scalar(misfit, bounds=(max(low, start - step), min(high, start + step)), method="bounded").x)
    now = float(part.misfits(part.residual({}))[0])
    if abs(level - record.oil_level) < RULES.odd_fill or misfit(level) > RULES.odd_left * now:
        return None
    of, as_if = 100.0 * record.oil_level, 100.0 * level
    text = f"The record {names[0]} does not belong to the others: it is as with {as_if:.0f} % oil, recorded with {of:.0f} %."
    return Fault(STRANGER, "Odd record", text, level, "oil_level", "1", names)


def right(part: Problem, values: dict[str, float], usual: float = 1.0) -> bool:
    """Whether the model explains the records, as well as others with misfits up to `usual`."""
    misfit = part.misfits(part.residual(values))
    return bool(np.all(misfit <= RULES.odd_right * usual))


def differ(part: Problem, least: float, zero: float) -> bool:
    """Whether records differ by shares `least` of their peaks, and by more than a `zero` [N], in most of their intervals.

    So much does a model differ where the filling changes, or the zero of a good load cell. An error in few intervals is a
    moved step: a cause may act in a single record.
    """
    sizes = shares(part)
    size = max(share * record.peak for share, record in zip(sizes, part.records, strict=True))
    return min(sizes) >= least and size >= zero and min(spreads(part)) >= RULES.odd_spread


def stranger(part: Problem, names: tuple[str, ...]) -> Fault:
    """Records of something else, with their error as the page shows it: by uncertainty, beside a zero."""
    errors = part.errors({})
    size = float(np.linalg.norm((errors - part.zeros(errors)) * part.weight) / np.linalg.norm(part.weight))
    kind, belong = ("record", "does not belong") if len(names) == 1 else ("records", "do not belong")
    text = f"The {kind} {', '.join(names)} {belong} to the others, which the model explains: error {size:.0f} N."
    return Fault(STRANGER, f"Odd {kind}", text, size, "force_rmse_N", "N", names)


def scaled_stranger(gain: Fault) -> Fault:
    """A record that another gain of a channel explains: what has that gain is not told from another setting."""
    channel = "stroke" if gain.effect == STROKE_GAIN else "force"
    text = (
        f"The record {gain.records[0]} does not belong to the others: it is as with its {channel} times {gain.factor:.3g}, "
        "by another range of the channel or another setting of the damper."
    )
    return replace(gain, effect=STRANGER, title="Odd record", explanation=text, channel=channel)
