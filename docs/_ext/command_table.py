"""The table of all commands on the page about them: `python docs/_ext/command_table.py` writes it into docs/commands.md.

Example and first sentences are those of `--help`.
"""

import re
from pathlib import Path
from typing import Any

import typer

from twintube.cli import app

PAGE = Path(__file__).parents[1] / "commands.md"
TABLE = re.compile(r"^\| command \| does \|\n(?:\|.*\n)+", re.MULTILINE)


def known() -> dict[str, Any]:
    """The commands by name, in the order of the alphabet."""
    return dict(sorted(typer.main.get_command(app).commands.items()))  # type: ignore[attr-defined]


def table() -> str:
    """A row for each command: an example, and what it does."""
    rows = ["| command | does |", "|---|---|"]
    for command in known().values():
        first = " ".join((command.help or "").split("\n\n", maxsplit=1)[0].split())
        rows.append(f"| `{command.epilog.removeprefix('Example: ')}` | {first} |")
    return "\n".join(rows) + "\n"


def written(page: str) -> str:
    """The page with the table of the present program."""
    return TABLE.sub(lambda _: table(), page)


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
