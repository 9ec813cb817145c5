"""The records of a text file or a workbook for a new dataset.toml: one, or one for each of its sheets, runs and blocks."""

from collections.abc import Callable
from contextlib import suppress
from copy import deepcopy
from dataclasses import replace
from functools import partial
from pathlib import Path

from twintube.common.words import listed, shown
from twintube.data.convert.column_names import assigned
from twintube.data.convert.quantities import convert
from twintube.data.convert.units import unit_of
from twintube.data.dataset_toml.keys import MOST_RECORDS
from twintube.data.dataset_toml.manifest import form_of
from twintube.data.findings import Notes, UnreadableError
from twintube.data.formats import Format, Raw, usual_delimiter
from twintube.data.read.binary import check_package, first_rows, is_binary
from twintube.data.read.blocks import Rows
from twintube.data.read.lvm import X
from twintube.data.read.sheets import sheet_rows
from twintube.data.read.tables import table_of
from twintube.data.read.text import TextReader, cut_text, is_lvm
from twintube.data.read.text import decoded as whole_text
from twintube.data.sniff.grids import Grid
from twintube.data.sniff.text import LINE_END, MOST_ROWS, decoded, sniff, sniffed, with_encoding
from twintube.data.sniff.values import Sniffed, judge, say_motion
from twintube.engine.simulate import InputError


def sniff_records(path: Path) -> list[Sniffed]:
    """What dataset.toml should say about each record of a text file or a workbook; raises InputError and OSError."""
    if is_binary(path):
        return sniff_sheets(path)
    if is_lvm(path):
        return sniff_lvm(path)
    found, usual = sniff(path), usual_delimiter(path)
    if len(found) > 1:
        return found
    delimiter, encoding = found[0].reading.get("delimiter", usual), form_of(found[0].reading).encoding

    def grid() -> Grid:
        return Grid(LINE_END.split(whole_text(path, encoding)), usual, [delimiter])

    return with_blocks(str(path), found[0], lambda form: cut_text(path, form).rows, grid)


def sniff_sheets(path: Path) -> list[Sniffed]:
    """The tables in the sheets of a workbook; raises InputError where it has none."""
    try:
        check_package(path)
        sheets = first_rows(path, MOST_ROWS)
    except UnreadableError as error:
        raise InputError(f"{path}: {error}") from error
    found: list[Sniffed] = []
    refused = {}
    for name, rows in sheets.items():
        place, cut = f"{path}, sheet {shown(name)}", partial(sheet_rows, rows)
        try:
            own = sniffed(place, Grid(rows))
            own = own if len(own) > 1 else with_blocks(place, own[0], cut, partial(Grid, rows))
        except InputError as error:
            refused[name] = str(error)
            continue
        for guess in own if len(sheets) > 1 else []:
            guess.reading["sheet"] = name
        found += own
    if not found:
        raise InputError("; ".join(refused.values()))
    if refused:
        found[0].facts.append(f"sheets without a record: {listed(map(shown, refused))}")
    return found


def with_blocks(place: str, whole: Sniffed, cut: Callable[[Format], Rows], grid: Callable[[], Grid]) -> list[Sniffed]:
    """The records of a table's blocks, or the one of the `whole` table.

    `cut` gives its rows as a form says, `grid` all rows of it, to be looked at.
    """
    form = form_of(whole.reading)
    try:
        rows = cut(form if isinstance(form.columns, list) else replace(form, skip_rows=0))
        if isinstance(form.columns, list) and len(set(rows.heads)) != 1:
            form = replace(form, columns=None)
            rows = cut(replace(form, skip_rows=0))
    except UnreadableError:  # the checks of the new dataset say why
        return [whole]
    if not 1 < len(rows.starts) <= MOST_RECORDS:
        return [whole]
    firsts = [rows.table[i][0] - 1 for i in rows.starts]
    found: list[Sniffed] = []
    last, looked = whole, None
    for number, (start, end) in enumerate(zip(firsts, [*firsts[1:], None], strict=True), start=1):
        named = rows.heads[number - 1] == rows.starts[number - 1] and not isinstance(form.columns, list)
        if named:
            looked = looked or grid()
            part = looked.rows[start : min(end or start + MOST_ROWS, start + MOST_ROWS)]
            try:
                (last,) = sniffed(place, replace(looked, rows=part), [form.decimal])
            except (InputError, ValueError):
                continue
            last.reading.pop("skip_rows", None)  # a block begins with its names
            last = with_encoding([last], form.encoding)[0]
        guess = deepcopy(last)
        guess.reading["block"] = number
        if not named or len(rows.starts) > len(set(rows.heads)):
            of_restart(guess, rows)
        found.append(guess)
    # A small table in the head of a file, of gains or limits, is no record: nothing moves there.
    return [guess for guess in found if guess.measurement] or found or [whole]


def of_restart(guess: Sniffed, rows: Rows) -> None:
    """Sampling and kind of a block that shares its names with the one before."""
    form = form_of(guess.reading)
    guess.facts = [fact for fact in guess.facts if "rows looked at" not in fact]
    with suppress(UnreadableError):
        table = convert(table_of(rows, form, form.delimiter or ""), form, Notes(""))
        if table is not None:
            say_motion(table.columns["time"], table.columns["stroke"], guess)


def sniff_lvm(path: Path) -> list[Sniffed]:
    """The segments of a file that LabVIEW wrote; raises InputError."""
    try:
        form = Format(encoding=decoded(path)[1])
        count = min(len(cut_text(path, form).segments), MOST_RECORDS)
        reader = TextReader()
        raws = [reader.read(path, replace(form, block=number)) for number in range(1, count + 1)]
    except UnreadableError as error:
        raise InputError(f"{path}: {error}") from error
    found = with_encoding([of_lvm(raw) for raw in raws], form.encoding)
    if count > 1:
        for number, guess in enumerate(found, start=1):
            guess.reading["block"] = number
    return found


def of_lvm(raw: Raw) -> Sniffed:
    """What the names and units of a segment tell."""
    result = Sniffed({})
    names = list(raw.columns)
    units = {name: raw.units.get(name, "") for name in names}
    pairs = [("time" if name == X else name, unit_of(unit) or unit) for name, unit in units.items()]
    columns = assigned(pairs, result.doubts)
    result.facts.append("columns in the file: " + ", ".join(names))
    result.reading["columns"] = dict(enumerate(names))
    judge(columns, [list(row) for row in zip(*raw.columns.values(), strict=True)], raw.decimal, result)
    if result.reading.get("columns") == {header: name for name, header in raw.meant.items()}:
        del result.reading["columns"]  # the file says it itself
    return result
