"""Runs of a test that stand side by side in a table, each with columns of its own."""

import re
from collections import Counter
from collections.abc import Sequence

from twintube.data.convert.column_names import NAMED, likeness
from twintube.data.sniff.names import Names

COUNTED = re.compile(r"[\s_#.-]*(\d+|\b[A-Z])$")  # how `Stroke 1` and `Stroke B` end


def side_by_side(names: Names, held: Sequence[int]) -> list[list[int]]:
    """The columns of each run; all columns where there is one run.

    There are several where stroke and force come as often, one after the other, under names that only a number or a letter
    tells apart. The time is theirs or, where it comes once, that of all.
    """
    told = {i: quantity for i in held for quantity, score in [likeness(*names.pair(i))] if score >= NAMED}
    counts = Counter(told.values())
    runs = counts["stroke"]
    own = [quantity for quantity in ("time", "stroke", "force") if counts[quantity] == runs]
    if runs < 2 or "force" not in own or (counts["time"] != 1 and "time" not in own):
        return [list(held)]
    first = next(quantity for quantity in told.values() if quantity in own)
    starts = [i for i, quantity in told.items() if quantity == first]
    common = [i for i in held if i < starts[0]]
    parts = [[i for i in held if start <= i < end] for start, end in zip(starts, [*starts[1:], max(held) + 1], strict=True)]
    alike = {frozenset((told[i], COUNTED.sub("", names.pair(i)[0])) for i in part if told.get(i) in own) for part in parts}
    several = len(alike) == 1 and {quantity for quantity, _ in next(iter(alike))} == set(own)
    return [common + part for part in parts] if several else [list(held)]
