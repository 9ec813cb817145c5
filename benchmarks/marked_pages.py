"""Pages of the documentation with a table that a command makes: it stands between two marks."""

from pathlib import Path

from twintube.errors import UserError


def parts(page: Path, name: str) -> tuple[str, str, str]:
    """The text of a page up to its table, the table, and the text from its end; raises UserError where marks are missing."""
    begin, end = f"<!-- table: {name} -->\n", "<!-- end of table -->\n"
    before, _, rest = page.read_text(encoding="utf-8").partition(begin)
    table, _, after = rest.partition(end)
    if not table:
        raise UserError(f"{page}: the lines {begin.strip()} and {end.strip()} are missing")
    return before + begin, table.strip() + "\n", end + after


def with_table(page: Path, name: str, table: str) -> str:
    """The text of a page with another table; raises UserError where marks are missing."""
    before, _, after = parts(page, name)
    return f"{before}\n{table}\n{after}"
