"""Tables that pages of the site take from the code: `<!-- table: hooks -->`, and so `numbers` and `variables`."""

from collections.abc import Iterator

from typer.testing import CliRunner

from twintube.cli import app
from twintube.core.hook_table import HOOKS, JOINED
from twintube.diagnosis.numbers import listed


def hooks() -> Iterator[str]:
    """The hooks of an effect, in the order in which a step calls them."""
    yield from ("| hook | arguments | several give | does |", "|---|---|---|---|")
    for name, hook in HOOKS.items():
        arguments = ", ".join(part.split(":")[0] for part in hook.arguments.split(", "))
        yield f"| `{name}` | `({arguments})` | {JOINED[hook.joined][2]} | {hook.does} |"


def numbers() -> Iterator[str]:
    """The numbers of the diagnosis."""
    yield from ("| number | value | meaning | source |", "|---|---|---|---|")
    for entry in listed():
        values = entry["value"] if isinstance(entry["value"], tuple) else (entry["value"],)
        unit = "" if entry["unit"] == "1" else f" {entry['unit']}"
        yield f"| `{entry['name']}` | {', '.join(f'{x:g}' for x in values)}{unit} | {entry['meaning']} | {entry['source']} |"


def variables() -> Iterator[str]:
    """The inputs, outputs and parameters, as the command prints them."""
    yield from CliRunner().invoke(app, ["dampers", "--variables"], catch_exceptions=False).stdout.splitlines()


def written(page: str) -> str:
    """The page with its tables."""
    for table in (hooks, numbers, variables):
        mark = f"<!-- table: {table.__name__} -->"
        if mark in page:
            page = page.replace(mark, "\n".join(table()))
    return page
