"""What the name of a column in the file says against what dataset.toml takes it for: another unit, a set point."""

import itertools
import json
import re
from collections.abc import Iterator
from typing import Literal, NamedTuple

from twintube.common.words import printable, shown
from twintube.data.convert.column_names import MEASURED, SET_POINT, fits, is_set_point, named_like
from twintube.data.convert.quantities import equal_units, per_unit
from twintube.data.convert.units import BRACKETS, OTHER_UNITS, is_mass, plain, split_header, unit_of, weight_advice
from twintube.data.findings import Notes
from twintube.data.formats import Format, Raw

# A separator that leaves no doubt: `Load, lbf`, `force/N`, `Stroke in mm`.
SEPARATED = re.compile(r"(?:[^/]+/|.+,|.+\sin\s)\s*(\S.*?)\s*")
LOOSE = re.compile(r"[\s_.:;-]+")
SIGNS_OF_UNITS = re.compile(r".*[^\W\d_].*[/^·*²³].*|.*[°µμ].*")
LONGEST_SYMBOL = 4  # letters of a unit's symbol in square brackets: `kgfm` may be one, `filtered` is a word
SYMBOLS = {"time": ("t",), "stroke": ("s", "z", "x"), "force": ("f", "p"), "velocity": ("v",), "temperature": ("t",)}
NO_UNITS = ("", "-", "1")
Kind = Literal["unit", "maybe", "unknown"]


class Claim(NamedTuple):
    """A unit in the name of a column; `maybe` where a word or an index would be written alike, `unknown` where none is."""

    unit: str
    kind: Kind


def claims(name: str, quantity: str) -> Iterator[Claim]:
    """The units that the name of a column of a quantity holds: `Load (lbf)`, `Load, lbf`, `Load_lbf`, `Load in lbf`."""
    name = plain(name)
    for inside in BRACKETS.finditer(name):
        yield from bracketed(inside[1], inside[0].startswith("["), quantity)
    bare = BRACKETS.sub(" ", name).strip().strip('"').strip()
    separated = SEPARATED.fullmatch(bare)
    if separated and says_unit(separated[1], quantity):
        yield Claim(separated[1], "unit")
        return
    parts = LOOSE.split(bare)
    first = parts[0] if len(parts) == 1 or (len(parts[0]) > 1 and parts[0].lower() != "in") else ""
    if unit_of(first) and says_unit(first, quantity):
        yield Claim(first, "unit")
    for before, part in itertools.pairwise(parts):
        if not (unit_of(part) or part.lower() == "kg") or (len(part) == 1 and not says_unit(part, quantity)):
            continue
        # `x_m` may be measured, `x_in` what goes in, `Load cell 10 kN` what the cell can take.
        unclear = len(part) == 1 or part.lower() == "in" or before[-1:].isdigit() or not says_unit(part, quantity)
        yield Claim(part, "maybe" if unclear else "unit")


def bracketed(text: str, square: bool, quantity: str) -> Iterator[Claim]:
    """What a text in brackets says: a unit, nothing, or what may be a unit that is not known."""
    symbol = text.lower() in SYMBOLS[quantity] and not says_unit(text, quantity)  # `Weg (s)`, `Force (F)`
    if text in NO_UNITS or symbol or re.match(r"[+-]?[\d.,]", text):
        return
    if says_unit(text, quantity) or unit_of(text) or text in OTHER_UNITS:
        yield Claim(text, "unit")
        return
    word = len(text) > LONGEST_SYMBOL or text.lower() in (*MEASURED, *SET_POINT)
    if SIGNS_OF_UNITS.fullmatch(text) or (square and text.isalpha() and not word):
        yield Claim(text, "unknown")


def says_unit(text: str, quantity: str) -> bool:
    """Whether a text is a unit of a quantity, or of mass where the quantity is a force."""
    return fits(quantity, text) or (quantity == "force" and is_mass(text))


def check_names(raw: Raw, form: Format, headers: dict[str, str], notes: Notes) -> None:
    """Findings on columns whose own names contradict dataset.toml; `headers` are those in use, by quantity."""
    named = form.columns if isinstance(form.columns, dict) else {}
    for quantity, header in headers.items():
        column = named.get(header, header)
        channel = form.channels.get(quantity)
        scaled = channel is not None and channel.gain is not None
        unit = split_header(header)[1]
        texts = [*([column] if column != header else []), *raw.over.get(header, [])]
        for name in texts if unit else []:
            check_unit(name, quantity, unit, header, scaled=scaled, notes=notes)
        for name in texts:
            check_word(name, quantity, header, notes)
        asked = [column, *texts] if channel is not None and channel.column is not None else texts
        if quantity != "time" and any(is_set_point(name) for name in asked):
            name = next(filter(is_set_point, asked))
            notes.warning(f"column {shown(name)} is named as a set point, not as what was measured", header)


def check_unit(name: str, quantity: str, stated: str, header: str, *, scaled: bool, notes: Notes) -> None:
    """Findings on a column named with another unit than the `stated` one; of volts with a scale only brackets count."""
    for claim in claims(name, quantity):
        if alike(quantity, claim.unit, stated, scaled) or (scaled and claim.kind != "unit"):
            continue
        said = f"column {shown(name)} is named in {printable(claim.unit)}"
        if claim.kind == "unknown":
            message = f"column {shown(name)}: the unit {shown(claim.unit)} in its name is not known, {stated} is taken"
            notes.warning(message, header)
        elif claim.kind == "maybe":
            notes.warning(f"{said}, if that is its unit; dataset.toml says {stated}", header)
        else:
            notes.error(f"{said}, dataset.toml says {stated}; {advice(name, quantity, claim.unit)}", header)
            return


def check_word(name: str, quantity: str, header: str, notes: Notes) -> None:
    """A warning where a name holds the word of another quantity, and none of its own."""
    held = list(named_like(name))
    own = any(claim.kind == "unit" and says_unit(claim.unit, quantity) for claim in claims(name, quantity))
    if held and quantity not in held and not own:
        notes.warning(f"column {shown(name)} is named like a {held[0]}, dataset.toml takes it for the {quantity}", header)


def alike(quantity: str, unit: str, stated: str, scaled: bool) -> bool:
    """Whether two units are equal: of a quantity, or of whatever its channel counts in."""
    if not scaled:
        return equal_units(quantity, unit, stated)
    try:
        return per_unit(unit, unit_of(stated) or stated) == 1.0
    except ValueError:
        return False


def advice(name: str, quantity: str, unit: str) -> str:
    """What to write into dataset.toml where the name is right."""
    column = json.dumps(printable(name), ensure_ascii=False)  # a string of TOML, too
    if quantity == "force" and is_mass(unit):
        return f"{unit} is a mass, {weight_advice(unit, column)}"
    if fits(quantity, unit):
        return f'write "{quantity} [{unit_of(unit) or unit}]" = {column}'
    return f"that is no unit of {quantity}: take another column, or give its scale in `channels`"
