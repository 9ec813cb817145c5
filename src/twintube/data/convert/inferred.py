"""What was read by inference, said once for each kind."""

import re
from collections.abc import Collection, Sequence

from twintube.common.words import counted, listed, shown
from twintube.data.convert.units import NUMBER
from twintube.data.findings import Notes
from twintube.data.formats import Format, Raw

COMMENT = re.compile(
    r"comments?|remarks?|notes?|events?|kommentare?|bemerkung(en)?|anmerkung(en)?|ereignis(se)?", re.IGNORECASE
)
LOOK = 100  # cells that tell whether a column may be a quantity


def say_inferred(raw: Raw, form: Format, used: dict[str, str], notes: Notes) -> None:
    """Findings on blank rows, names without cells and quantities told by units; `used` are the columns by header."""
    if raw.blank:
        message = f"skipped {counted(len(raw.blank), 'blank row')} between the others"
        if form.sample_rate is None or not raw.spaced:
            notes.remark(message, row=raw.blank[0])
        else:
            notes.warning(f"{message}; times by sample_rate_Hz do not count them", row=raw.blank[0])
    if raw.without:
        say_without(raw, set(used.values()), notes)
    if raw.empty and not set(raw.empty) & set(used.values()):
        notes.remark(f"left out, because no row has a cell for it: {listed(map(shown, raw.empty))}")
    if raw.sheets:
        notes.remark(f"read is the first sheet of {listed(map(shown, raw.sheets))}; `sheet` chooses another")
    if raw.meant and form.columns is None:
        taken = [f"{header} from {shown(column)}" for header, column in used.items() if header != column]
        notes.remark(f"by the names and units in the file's head: {listed(taken)}; `columns` would say otherwise")


def say_without(raw: Raw, used: Collection[str], notes: Notes) -> None:
    """All rows are shorter than the row of names, and the last names are the extra ones.

    That is not clear where a column of numbers before those in use is idle, too: its name may be the extra one.
    """
    names = list(raw.columns)
    last_used = max((names.index(name) for name in used), default=0)
    idle = [name for name in names[:last_used] if name not in used and numeric(raw.columns[name])]
    last = listed(map(shown, raw.without))
    if idle and not all(COMMENT.fullmatch(name) for name in raw.without):
        cells = len(names) - len(raw.without)
        notes.error(
            f"no row has more than {cells} cells under {len(names)} names: is {last} without cells, or "
            f"{listed(map(shown, idle))}? set `columns`, the headers as a list, and skip_rows"
        )
    elif not set(raw.without) & set(used):
        notes.remark(f"no row has a cell for the last of the names, {last}: the others are read in their order")


def numeric(cells: Sequence[str]) -> bool:
    """Whether a column has a number in each of its first rows."""
    return all(map(NUMBER.fullmatch, cells[:LOOK]))
