"""A first `columns` for a record whose columns dataset.toml does not name yet."""

import json

from twintube.common.words import printable
from twintube.data.convert.cells import floats
from twintube.data.convert.column_names import CURVE, assigned, is_curve
from twintube.data.convert.quantities import EXAMPLES, quantity_of, rising
from twintube.data.convert.units import name_and_unit
from twintube.data.findings import Notes
from twintube.data.formats import Format, Raw
from twintube.data.sniff.values import guessed

LACKS = ("no column", "no unit")  # how the findings on missing columns begin
LOOK = 10_000  # samples whose size tells a unit


def suggest_columns(raw: Raw, form: Format, notes: Notes) -> None:
    """What to do where columns are missing: a remark with the key to set, the names as far as the file tells them.

    A table of an F-v curve, which has none of them, is said in place of all that it lacks.
    """
    names = list(raw.columns)
    pairs = [name_and_unit(name) for name in names]
    fitting = assigned(
        [(name, unit or raw.units.get(full, "")) for full, (name, unit) in zip(names, pairs, strict=True)], []
    )
    if is_curve(map(quantity_of, form.columns) if isinstance(form.columns, dict) else fitting):
        notes.findings[:] = [finding for finding in notes.findings if not finding.message.startswith(LACKS)]
        notes.error(CURVE)
        return
    if form.columns is not None or not raw.columns:
        return
    found = {quantity: (names[i], unit) for quantity, (i, unit) in fitting.items()}
    if "time" not in found and (late := rising(raw, form.decimal)):
        found["time"] = late[0], ""
    texts = []
    for quantity in EXAMPLES:
        name, unit = found.get(quantity, ("name in the file", ""))
        values = floats(raw.columns.get(name, [])[:LOOK], form.decimal)
        texts.append(
            f'"{quantity} [{unit or guessed(quantity, values)}]" = {json.dumps(printable(name), ensure_ascii=False)}'
        )
    notes.remark(f"name columns and units like columns = {{{', '.join(texts)}}}; check them, they are a guess")
