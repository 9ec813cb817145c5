"""The table of the numbers of the diagnosis, written into its page while the site is built."""

from typing import Any

from twintube.diagnosis.numbers import listed

HERE = "<!-- table: numbers -->"


def row(entry: dict[str, Any]) -> str:
    """A number with its value, meaning and source."""
    values = entry["value"] if isinstance(entry["value"], tuple) else (entry["value"],)
    unit = "" if entry["unit"] == "1" else f" {entry['unit']}"
    return f"| `{entry['name']}` | {', '.join(f'{x:g}' for x in values)}{unit} | {entry['meaning']} | {entry['source']} |"


def written(page: str) -> str:
    """The page with the table in its place."""
    head = ["", "| number | value | meaning | source |", "|---|---|---|---|"]
    return page.replace(HERE, "\n".join([*head, *map(row, listed())]))
