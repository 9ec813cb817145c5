"""Thousands separators: read where the cells of a column leave no doubt, refused elsewhere."""

import re
from collections.abc import Sequence


def ungrouped(cells: Sequence[str], decimal: str) -> tuple[list[str], int] | None:
    """The cells without their thousands separators, and the number of the first that had one.

    None where they may be decimal signs. Every separator must part groups of three digits after a first one that does not
    begin with 0, and no longer number may be without. That they are no decimal signs is clear where a cell holds both
    signs or several separators, or where the column has no decimal sign but whole numbers below 1000: `2.189` among
    `870` and `-45`, with decimal = ',' in dataset.toml.
    """
    separator = "," if decimal == "." else "."
    groups = re.compile(rf"\s*[+-]?[1-9]\d{{0,2}}(?:{re.escape(separator)}\d{{3}})+(?:{re.escape(decimal)}\d*)?\s*")
    parted = [cell for cell in cells if separator in cell]
    plain = [cell for cell in cells if separator not in cell]
    if not parted or not all(groups.fullmatch(cell) for cell in parted):
        return None
    if any(re.match(r"\s*[+-]?\d{4}", cell) for cell in plain):
        return None
    both_signs = any(decimal in cell or cell.count(separator) > 1 for cell in parted)
    whole = decimal == "," and not any(decimal in cell for cell in cells) and any(cell.strip() for cell in plain)
    if not (both_signs or whole):
        return None
    first = next(i for i, cell in enumerate(cells) if separator in cell)
    return [cell.replace(separator, "") for cell in cells], first
