"""`python -m worlds COMMAND`: bench data with a known truth, a diagnosis of many of them, and what the answers are worth."""

import json
from pathlib import Path
from typing import Annotated

import typer

from twintube.common.files import write_text
from twintube.errors import UserError
from worlds.makers import FIRST_SEED, WORLDS, collected, jobs
from worlds.run import run as run_jobs
from worlds.run import write_score
from worlds.scoring import read_pairs, tables
from worlds.scoring import score as score_pairs

app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)


@app.callback()
def main() -> None:
    """Make bench data with a known truth, and score what a diagnosis says about them."""


def refuse(message: str) -> typer.Exit:
    """Say what is wrong; the exit to raise."""
    typer.echo(f"error: {message}", err=True)
    return typer.Exit(2)


@app.command(epilog="Example: python -m worlds score run/before_after_*")
def score(
    folders: Annotated[
        list[Path], typer.Argument(help="Folders with truth.json and answer/diagnosis.json, or folders of such.")
    ],
    answers: Annotated[
        Path | None, typer.Option(help="Folder of NAME/diagnosis.json, if the answers are elsewhere.")
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="Write the figures to this file, too.")] = None,
) -> None:
    """Score the answers to datasets whose truth is known."""
    try:
        scored = score_pairs(read_pairs(folders, answers))
    except UserError as error:
        raise refuse(str(error)) from error
    typer.echo(tables(scored), nl=False)
    if json_file is not None:
        write_text(json_file, json.dumps(scored, indent=1) + "\n")


def known(world: str) -> None:
    """Refuse the name of no world."""
    if world not in WORLDS:
        raise refuse(f"--world {world}: must be one of {', '.join(WORLDS)}")


def span(text: str, world: str) -> tuple[int, int]:
    """First and last seed in `A-B` or `A`."""
    first, _, last = text.partition("-")
    if not first.isdecimal() or not (last or first).isdecimal() or int(last or first) < int(first):
        raise refuse(f"--seeds {text}: must be A-B with B not below A, or a single seed")
    if int(first) < (least := FIRST_SEED.get(world, 0)):
        raise refuse(f"--seeds {text}: the seeds of {world} begin at {least}")
    return int(first), int(last or first)


@app.command(epilog="Example: python -m worlds make --world workshop --seed 7 --output one")
def make(
    world: Annotated[str, typer.Option(help=f"One of {', '.join(WORLDS)}.")],
    seed: Annotated[int, typer.Option(min=0, help="The same seed makes the same data.")],
    output: Annotated[Path, typer.Option(help="Folder for dataset/ and truth.json, which neither may hold.")],
) -> None:
    """Make a dataset."""
    for path in (output / "dataset", output / "truth.json"):
        if path.exists():
            raise refuse(f"{path}: exists already")
    known(world)
    WORLDS[world](span(str(seed), world)[0], output)


@app.command(epilog="Example: python -m worlds run --world before_after --seeds 1-20 --output run --jobs 2")
def run(
    output: Annotated[Path, typer.Option(help="Folder of the run; what it holds already is not made or answered again.")],
    world: Annotated[str, typer.Option(help=f"One of {', '.join(WORLDS)}.")] = "",
    seeds: Annotated[str, typer.Option(help="A-B, both included.")] = "",
    datasets: Annotated[
        Path | None, typer.Option(help="In place of a world: a folder of datasets with a table of truths, truth.json.")
    ] = None,
    workers: Annotated[int, typer.Option("--jobs", min=1, help="Datasets at a time.")] = 1,
    timeout: Annotated[float, typer.Option(min=1.0, help="Longest time of a diagnosis [s]; counted as no answer.")] = 600.0,
) -> None:
    """Make datasets, have `twintube diagnose` answer them, and score the answers."""
    if (datasets is None) == (world == ""):
        raise refuse("--world, --datasets: give one of them")
    if datasets is None:
        known(world)
    try:
        wanted = jobs(world, *span(seeds, world)) if datasets is None else collected(datasets)
        pairs = run_jobs(wanted, output, workers=workers, timeout=timeout)
    except UserError as error:
        raise refuse(str(error)) from error
    typer.echo(write_score(pairs, output), nl=False)


if __name__ == "__main__":
    app()
