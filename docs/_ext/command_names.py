"""The commands of the program, which the page about them names and shows with their options."""

from typing import Any

import typer

from twintube.cli import app
from twintube.cli.base import PANELS


def known() -> dict[str, Any]:
    """The commands by their full name such as `paper claims`, group by group in the order of the alphabet."""
    found: dict[str, Any] = {}
    for name, command in typer.main.get_command(app).commands.items():  # type: ignore[attr-defined]
        if command.hidden:  # a former name
            continue
        within = getattr(command, "commands", None)
        found |= {name: command} if within is None else {f"{name} {part}": each for part, each in within.items()}
    return {name: found[name] for name in sorted(found, key=lambda name: (PANELS.index(found[name].rich_help_panel), name))}
