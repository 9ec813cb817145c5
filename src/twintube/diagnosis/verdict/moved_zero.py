"""A constant of all records with their gas, or of all without it: the gas, or a zero that moved with the filling."""

from collections.abc import Sequence

import numpy as np

from twintube.diagnosis.fits.gains import floor
from twintube.diagnosis.result import RecordResult
from twintube.diagnosis.rules import RULES

ZERO = "force_offset"
MOVED = (
    "Zero of the load cell, if it moved when the filling was changed: the load cell read with the damper taken out, before "
    "and after"
)
NOT_THAT_OF_ALL = (
    "the zero that is not told apart is a constant of the records with gas and another of those without; that among the "
    "candidates is one of all records alike"
)


def moved_zero(held: Sequence[RecordResult], limit: float) -> float | None:
    """Share of the explainable squared error that a constant of the records with and one of those without gas take away.

    None where all records are alike, or where the extended model leaves less by more than noise, whose `limit` is given.
    """
    squares = {"base": 0.0, "extended": 0.0, "moved": 0.0}
    for intact in (True, False):
        some = [r for r in held if r.record.intact == intact]
        if not some:
            return None
        weight = np.concatenate([r.weight for r in some])
        base, extended = (
            np.concatenate([r.weight * (force - r.measured) for r, force in zip(some, forces, strict=True)])
            for forces in ([r.base for r in some], [r.extended for r in some])
        )
        zero = float(weight @ base) / max(float(weight @ weight), np.finfo(float).tiny)
        squares["base"] += float(base @ base)
        squares["extended"] += float(extended @ extended)
        squares["moved"] += float(np.sum((base - zero * weight) ** 2))
    gained = squares["base"] - squares["extended"]
    if squares["moved"] - squares["extended"] > max(limit, RULES.close * gained):
        return None
    explainable = squares["base"] - floor(held) * sum(int(np.sum(r.weight > 0.0)) for r in held)
    return float(min(1.0, (squares["base"] - squares["moved"]) / explainable)) if explainable > 0.0 else None
