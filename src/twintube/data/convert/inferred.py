"""What was read by inference, said once for each kind."""

import re
from collections.abc import Iterable

from twintube.common.words import counted, listed, shown
from twintube.data.findings import Notes
from twintube.data.formats import Format, Raw

COMMENT = re.compile(r"comments?|remarks?|notes?|kommentare?|bemerkung(en)?|anmerkung(en)?", re.IGNORECASE)


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
    if raw.meant and form.columns is None:
        taken = [f"{header} from {shown(column)}" for header, column in used.items() if header != column]
        notes.remark(f"by the names and units in the file's head: {listed(taken)}; `columns` would say otherwise")


def say_without(raw: Raw, used: Iterable[str], notes: Notes) -> None:
    """All rows are shorter than the row of names: which names are the extra ones is clear where the last alone are idle."""
    idle = [name for name in raw.columns if name not in used and name not in raw.without]
    last = listed(map(shown, raw.without))
    if idle and not all(COMMENT.fullmatch(name) for name in raw.without):
        cells, names = len(raw.columns) - len(raw.without), len(raw.columns)
        notes.error(
            f"no row has more than {cells} cells under {names} names: is {last} without cells, or "
            f"{listed(map(shown, idle))}? set `columns`, the headers as a list, and skip_rows"
        )
    elif not set(raw.without) & set(used):
        notes.remark(f"no row has a cell for the last of the names, {last}: the others are read in their order")
