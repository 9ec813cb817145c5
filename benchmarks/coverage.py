"""`python -m benchmarks.coverage coverage.json`: how much of each room the tests run, of the report of `pytest --cov`."""

import json
from collections import Counter
from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import standalone

PACKAGE = "src/twintube/"
COUNTS = ("covered_lines", "num_statements", "covered_branches", "num_branches")


def rooms(report: Path) -> dict[str, Counter[str]]:
    """The counts of each folder of the package, and of all."""
    found: dict[str, Counter[str]] = {}
    for name, file in json.loads(report.read_text(encoding="utf-8"))["files"].items():
        room, below, _ = name.removeprefix(PACKAGE).partition("/")
        own = Counter({count: file["summary"][count] for count in COUNTS})
        for each in (room if below else "the package itself", "all"):
            found.setdefault(each, Counter()).update(own)
    return found


def share(covered: int, count: int) -> str:
    """A share in words; empty of nothing."""
    return f"{covered / count:.0%}" if count else ""


def main(report: Annotated[Path, typer.Argument(help="Written by `--cov-report json`.")]) -> None:
    """Print the table."""
    typer.echo("| room | statements | lines | branches |\n| --- | --- | --- | --- |")
    for room, counts in sorted(rooms(report).items(), key=lambda item: (item[0] == "all", item[0])):
        lines, branches = (share(*(counts[name] for name in some)) for some in (COUNTS[:2], COUNTS[2:]))
        typer.echo(f"| {room} | {counts['num_statements']} | {lines} | {branches} |")


if __name__ == "__main__":
    standalone(main)()
