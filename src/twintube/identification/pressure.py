"""The gas pressure that an identified gas spring belongs to."""

from collections import Counter
from collections.abc import Sequence

from twintube.common.words import listed
from twintube.data import Record
from twintube.fitting.harmonic import Harmonic

BAR = 1e5  # [Pa]


def at_one_pressure(
    sines: Sequence[Harmonic], slow: Sequence[Record]
) -> tuple[float | None, list[Harmonic], list[Record], list[str]]:
    """Gauge pressure [Pa] of the intact records, those to fit the gas spring to, and remarks.

    One gas spring holds at one pressure. Where the records state several, that of most sines is fitted; the set then holds
    it, and records of the others are validated with their gas as much stronger or weaker. A record that states none counts
    for every pressure. None: no record states one, and the pressure is that which F_0 and the rod's area make.
    """
    stated = Counter(h.gas_pressure for h in sines if h.gas_pressure)
    if not stated:
        return None, list(sines), list(slow), []
    pressure = stated.most_common(1)[0][0]
    fitting = [h for h in sines if h.gas_pressure in (None, pressure)]
    still = [r for r in slow if r.gas_pressure in (None, pressure)]
    every: list[Harmonic | Record] = [*sines, *slow]
    left = [r.name for r in every if r.gas_pressure not in (None, pressure)]
    remarks = [f"F-v curve, friction and gas spring are those at {pressure / BAR:g} bar; not fitted: {listed(left, 5)}"]
    return pressure, fitting, still, remarks if left else []
