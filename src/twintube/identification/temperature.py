"""The temperature at which an identified F-v curve holds."""

from collections.abc import Iterable

import numpy as np

from twintube.core.checks import KELVIN
from twintube.dampers import Damper
from twintube.dampers.temperature import held_at
from twintube.data import Record


def at_their_temperature(damper: Damper, records: Iterable[Record]) -> tuple[Damper, list[str]]:
    """The damper with T_curve at the median temperature of the records it is fitted to, and remarks.

    Where none of them says its temperature, T_curve stays.
    """
    known = [r.start_temperature if r.temperature is None else float(np.mean(r.temperature)) for r in records]
    stated = [each for each in known if each is not None]
    if not stated:
        return damper, []
    usual, p = float(np.median(stated)), damper.parameters
    if not p.T_cold < usual + KELVIN < p.T_hot:
        low, high = p.T_cold - KELVIN, p.T_hot - KELVIN
        return damper, [
            f"the records were measured at {usual:.1f} degC, beyond the law of temperature ({low:g} to {high:g} degC): "
            f"the set is said to hold at {p.T_curve - KELVIN:.1f} degC"
        ]
    return held_at(damper, usual + KELVIN), [f"F-v curve, friction and gas spring are those at {usual:.1f} degC (T_curve)"]
