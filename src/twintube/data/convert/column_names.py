"""Which column of a foreign file is which quantity: names and units as test benches write them, English and German."""

import re
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from twintube.common.grouping import grouped
from twintube.data.convert.quantities import UNITS, in_si
from twintube.data.convert.units import OTHER_UNITS, PLAIN_UNITS

SYMBOLS = {"t": "time", "z": "stroke", "x": "stroke", "s": "stroke", "F": "force", "v": "velocity", "T": "temperature"}
# Of two words that both fit the earlier line counts: `Kolbengeschwindigkeit` is a velocity, `Lastweg` a stroke.
WORDS = {
    "velocity": re.compile(r"velocity|geschw|speed|veloc|скорост"),
    "temperature": re.compile(r"temp(?!o|s\b)|темп"),  # temps and tempo are times
    "stroke": re.compile(r"stroke|weg|hub|displ|position|travel|auslenkung|lvdt|перемещ|位移"),
    "force": re.compile(r"force|kraft|load|last|fz|усили|нагрузк|力"),
    "time": re.compile(r"time|zeit|temps\b|tempo\b|tiempo|elapsed|seconds|sekunden|время|时间"),
}
SET_POINT = ("soll", "set", "setpoint", "setpt", "sp", "target", "command", "commanded", "cmd", "demand", "desired", "ref",
             "reference", "nominal", "program", "sollwert", "vorgabe")  # fmt: skip
MEASURED = ("ist", "istwert", "act", "actual", "meas", "measured", "feedback", "fbk", "fdbk", "response")
# Within a single word: `Sollweg`, `Wegsoll`, `LoadSetpoint`; short ones only as a word of their own.
SET_POINT_PARTS = ("soll", "setpoint", "command", "sollwert")
MEASURED_PARTS = ("istwert", "istweg", "istkraft", "istpos", "feedback")
CURVE = (
    "an F-v table, not a record of time, stroke and force: its points go into [fv] of a parameter file, "
    "which `twintube dampers SA8 > mine.toml` writes"
)
NAMED = 2.0  # score of a column whose name says what it holds


def words(name: str) -> list[str]:
    """The words of a name in small letters: `LoadCmd`, `load_cmd` and `Load (cmd)` have the same."""
    return [word.lower() for word in re.findall(r"[^\W\d_]+", re.sub(r"(?<=[a-zäöü])(?=[A-ZÄÖÜ])", " ", name))]


def says(name: str, whole: Sequence[str], parts: tuple[str, ...]) -> bool:
    """Whether a name has one of these words, or a word that begins or ends with one of these parts."""
    return any(word in whole or word.startswith(parts) or word.endswith(parts) for word in words(name))


def is_set_point(name: str) -> bool:
    """Whether a name says that it is what was asked for, and not what was measured."""
    return says(name, SET_POINT, SET_POINT_PARTS) and not says(name, MEASURED, MEASURED_PARTS)


def named_like(name: str) -> Iterator[str]:
    """The quantities whose words a name holds, the one that counts first."""
    low = name.lower()
    return (quantity for quantity, some in WORDS.items() if some.search(low))


def fits(quantity: str, unit: str) -> bool:
    """Whether a unit is one of a quantity."""
    try:
        in_si(np.ones(1), quantity, unit)
    except ValueError:
        return False
    return True


def likeness(name: str, unit: str) -> tuple[str, float]:
    """The quantity that a column most likely is, and how sure that is: 0 where it is none."""
    low = name.lower()
    parts = re.split(r"[\s_.-]+", low)
    symbol = name[:1] if all(part in (*SET_POINT, *MEASURED) for part in parts[1:]) and len(parts[0]) == 1 else ""
    quantity, score = "", 0.0
    if low in UNITS:
        quantity, score = low, 4.0
    elif symbol in SYMBOLS or symbol.lower() in SYMBOLS:
        quantity, score = SYMBOLS.get(symbol, SYMBOLS.get(symbol.lower(), "")), 2.5
    else:
        quantity = next(named_like(name), "")
        score = 3.0 if quantity else 0.0
    if unit and quantity and not fits(quantity, unit) and unit in (*PLAIN_UNITS, *OTHER_UNITS):
        quantity, score = "", 0.0  # `Zeit [N]` is neither, `Kraft [V]` needs a scale
    if not quantity and unit:
        quantity = next((q for q in UNITS if fits(q, unit)), "")
        score = 1.0 if quantity else 0.0
    return quantity, score - 0.75 if is_set_point(name) and score else score


def assigned(pairs: Sequence[tuple[str, str]], doubts: list[str]) -> dict[str, tuple[int, str]]:
    """By quantity: the number and the unit of the column that fits best; adds what is not sure to `doubts`."""
    rated = [(i, *likeness(*pair)) for i, pair in enumerate(pairs)]
    likely = grouped((quantity, (score, i)) for i, quantity, score in rated if score)
    columns = {}
    for quantity in UNITS:
        # What was asked for is taken only where nothing else fits, however well it is named.
        ranked = sorted(likely.get(quantity, []), key=lambda item: (is_set_point(pairs[item[1]][0]), -item[0], item[1]))
        if not ranked:
            continue
        score, i = ranked[0]
        columns[quantity] = i, pairs[i][1]
        if is_set_point(pairs[i][0]):
            doubts.append(f"{quantity}: {pairs[i][0]!r} is named as a set point, and no measured one was found")
        elif score < NAMED:
            doubts.append(f"{quantity}: taken from {pairs[i][0]!r}, by its unit only")
        rivals = [k for other, k in ranked[1:] if other > score - 1.0]
        if rivals:
            others = ", ".join(repr(pairs[k][0]) for k in rivals)
            doubts.append(f"{quantity}: taken from {pairs[i][0]!r}; {others} would fit too")
    return columns


def is_curve(quantities: Iterable[str]) -> bool:
    """Whether columns of these quantities are points of an F-v curve."""
    there = set(quantities)
    return {"velocity", "force"} <= there and not {"time", "stroke"} & there
