"""Thousands separators: read where the cells of a column leave no doubt, refused elsewhere."""

import re
from collections.abc import Sequence

SPACES = "\N{NO-BREAK SPACE}\N{FIGURE SPACE}\N{THIN SPACE}\N{NARROW NO-BREAK SPACE}"
SAME = str.maketrans(dict.fromkeys(SPACES, " ") | {"\N{RIGHT SINGLE QUOTATION MARK}": "'"})


def one_space(cell: str) -> str:
    """The cell with one kind of space and of apostrophe, none at its ends."""
    return cell.translate(SAME).strip()


def parted(text: str, decimal: str) -> list[str]:
    """The signs in the cells that may part thousands."""
    return [sign for sign in (" ", "'", "," if decimal == "." else ".") if sign in text]


def ungrouped(cells: Sequence[str], separator: str, decimal: str) -> tuple[list[str], int] | None:
    """The cells without their thousands separators, and the number of the first that had one; None where in doubt.

    Every separator must part groups of three digits after a first one that does not begin with 0. A space or an apostrophe
    is no decimal sign. That a point or a comma is none is clear where no longer number is without and a cell holds both
    signs or several separators, or where the column has no decimal sign but whole numbers below 1000: `2.189` among
    `870` and `-45`, with decimal = ',' in dataset.toml.
    """
    groups = re.compile(
        rf"\s*[+-]?[1-9]\d{{0,2}}(?:{re.escape(separator)}\d{{3}})+(?:{re.escape(decimal)}\d*)?\s*", re.ASCII
    )
    grouped = [cell for cell in cells if separator in cell]
    if not grouped or not all(groups.fullmatch(cell) for cell in grouped):
        return None
    if separator in ",." and not thousands(cells, grouped, separator, decimal):
        return None
    first = next(i for i, cell in enumerate(cells) if separator in cell)
    return [cell.replace(separator, "") for cell in cells], first


def thousands(cells: Sequence[str], grouped: Sequence[str], separator: str, decimal: str) -> bool:
    """Whether a point or a comma in `grouped`, some of the cells, can only part thousands."""
    others = [cell for cell in cells if separator not in cell]
    if any(re.match(r"\s*[+-]?\d{4}", cell) for cell in others):
        return False
    both_signs = any(decimal in cell or cell.count(separator) > 1 for cell in grouped)
    whole = decimal == "," and not any(decimal in cell for cell in cells) and any(cell.strip() for cell in others)
    return both_signs or whole
