"""Sheets of workbooks: their cells are read as those of a text, so that all that holds for texts holds for them."""

from collections.abc import Sequence

from twintube.common.words import listed, shown
from twintube.data.findings import UnreadableError
from twintube.data.formats import Format, Raw
from twintube.data.read.blocks import Row, Rows, ruled
from twintube.data.read.tables import table_of, texts_over

Cells = list[float | str | None]


def texts(cells: Cells, decimal: str) -> list[str]:
    """The cells of a row as a text with this decimal sign has them, without empty ones at its end."""
    last = next((i for i in range(len(cells), 0, -1) if cells[i - 1] is not None), 0)
    return [
        "" if cell is None else cell if isinstance(cell, str) else repr(cell).replace(".", decimal) for cell in cells[:last]
    ]


def sheet_rows(cells: Sequence[Cells], form: Format) -> Rows:
    """The rows of a sheet behind those to be skipped."""
    rows: list[Row] = [
        (number, texts(row, form.decimal)) for number, row in enumerate(cells[form.skip_rows :], start=form.skip_rows + 1)
    ]
    while rows and not rows[-1][1]:
        rows.pop()
    return ruled(rows, form)


def read_sheet(cells: Sequence[Cells], sheet: str, sheets: Sequence[str], form: Format) -> Raw:
    """The columns of a sheet of a workbook; raises UnreadableError."""
    over = [texts(row, form.decimal) for row in cells[: form.skip_rows]]
    rows = sheet_rows(cells, form)
    others = [name for name in sheets if name != sheet] if form.sheet is None else []
    hint = f"; the workbook has other sheets: {listed(map(shown, others))}; `sheet` chooses one" if others else ""
    if not rows.table:
        skipped = f" after {form.skip_rows} rows" if form.skip_rows else ""
        raise UnreadableError(f"sheet {shown(sheet)} is empty{skipped}{hint}")
    try:
        raw = table_of(rows, form, "")
    except UnreadableError as error:
        raise UnreadableError(f"{error}{hint}", error.row) from error
    raw.sheets = sheets if others else ()
    if isinstance(form.columns, list):
        raw.over = texts_over(over, form.columns) | raw.over
    return raw
