"""The tables of all commands on the page about them: `python docs/_ext/command_table.py` writes them into docs/commands.md.

Groups and first lines are those of `--help`.
"""

import re
from pathlib import Path
from typing import Any

import typer

from twintube.cli import app
from twintube.cli.base import PANELS, first_line

PAGE = Path(__file__).parents[1] / "commands.md"
HEAD = "does |\n|---|---|\n"
TABLES = re.compile(rf"(?:^\| [\w ]+ \| {re.escape(HEAD)}(?:\|.*\n)+\n?)+", re.MULTILINE)


def known() -> dict[str, Any]:
    """The commands by their full name such as `paper claims`, group by group in the order of the alphabet."""
    found: dict[str, Any] = {}
    for name, command in typer.main.get_command(app).commands.items():  # type: ignore[attr-defined]
        if command.hidden:  # a former name
            continue
        within = getattr(command, "commands", None)
        found |= {name: command} if within is None else {f"{name} {part}": each for part, each in within.items()}
    return {name: found[name] for name in sorted(found, key=lambda name: (PANELS.index(found[name].rich_help_panel), name))}


def tables() -> str:
    """A table for each group: the names, and what the commands do."""
    made = []
    for title in PANELS:
        rows = [
            f"| `twintube {name}` | {first_line(each)} |\n"
            for name, each in known().items()
            if each.rich_help_panel == title
        ]
        made.append(f"| {title} | {HEAD}{''.join(rows)}")
    return "\n".join(made)


def written(page: str) -> str:
    """The page with the tables of the present program."""
    return TABLES.sub(lambda _: tables() + "\n", page, count=1)


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
