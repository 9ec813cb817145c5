"""The records of a text file for a new dataset.toml: one, or one for each of its blocks."""

from dataclasses import replace
from pathlib import Path

from twintube.data.convert.column_names import assigned
from twintube.data.convert.units import unit_of
from twintube.data.dataset_toml.keys import MOST_RECORDS
from twintube.data.findings import UnreadableError
from twintube.data.formats import DEFAULT_ENCODING, TEXT, Format, Raw
from twintube.data.read.lvm import X
from twintube.data.read.text import TextReader, cut_text, decoded, is_lvm
from twintube.data.sniff.text import LINE_END, MOST_ROWS, sniff, sniffed
from twintube.data.sniff.text import decoded as beginning
from twintube.data.sniff.values import Sniffed, judge
from twintube.engine.simulate import InputError


def sniff_records(path: Path) -> list[Sniffed]:
    """What dataset.toml should say about each record of a text file; raises InputError and OSError."""
    if is_lvm(path):
        return sniff_lvm(path)
    whole = sniff(path)
    form = Format(
        delimiter=whole.reading.get("delimiter"),
        decimal=whole.reading.get("decimal", "."),
        encoding=whole.reading.get("encoding", DEFAULT_ENCODING),
    )
    try:
        rows = cut_text(path, form).rows
        starts = [rows.table[i][0] for i in rows.starts]
        lines = LINE_END.split(decoded(path, form.encoding)) if 1 < len(starts) <= MOST_RECORDS else []
    except UnreadableError:  # the checks of the new dataset say why
        return [whole]
    if not lines:
        return [whole]
    ways = [form.delimiter or TEXT[path.suffix.lower()]], [form.decimal]
    found = []
    for number, (start, end) in enumerate(zip(starts, [*starts[1:], len(lines)], strict=True), start=1):
        try:
            guess = sniffed(path, lines[start - 1 : min(end - 1, start + MOST_ROWS)], form.encoding, *ways)
        except InputError:
            continue
        guess.reading.pop("skip_rows", None)  # a block begins with its names
        guess.reading["block"] = number
        found.append(guess)
    # A small table in the head of a file, of gains or limits, is no record: nothing moves there.
    moving = [guess for guess in found if guess.measurement] or found
    return moving if len(moving) > 1 else [whole]


def sniff_lvm(path: Path) -> list[Sniffed]:
    """The segments of a file that LabVIEW wrote; raises InputError."""
    try:
        form = Format(encoding=beginning(path)[1])
        count = min(len(cut_text(path, form).segments), MOST_RECORDS)
        reader = TextReader()
        raws = [reader.read(path, replace(form, block=number)) for number in range(1, count + 1)]
    except UnreadableError as error:
        raise InputError(f"{path}: {error}") from error
    found = [of_lvm(raw) for raw in raws]
    if form.encoding != DEFAULT_ENCODING:
        for guess in found:
            guess.reading["encoding"] = form.encoding
            guess.doubts.append(f"encoding: the file is not UTF-8, {form.encoding} is assumed")
    if count > 1:
        for number, guess in enumerate(found, start=1):
            guess.reading["block"] = number
    return found


def of_lvm(raw: Raw) -> Sniffed:
    """What the names and units of a segment tell."""
    result = Sniffed({})
    names = list(raw.columns)
    units = [raw.units.get(name, "") for name in names]
    pairs = [("time" if name == X else name, unit_of(unit) or unit) for name, unit in zip(names, units, strict=True)]
    columns = assigned(pairs, result.doubts)
    result.facts.append("columns in the file: " + ", ".join(names))
    result.reading["columns"] = {name: names[i] for name, (i, _) in columns.items()}
    judge(columns, [list(row) for row in zip(*raw.columns.values(), strict=True)], raw.decimal, result)
    if result.reading.get("columns") == {header: name for name, header in raw.meant.items()}:
        del result.reading["columns"]  # the file says it itself
    return result
