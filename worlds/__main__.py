"""`python -m worlds NAME --seed N --output DIR`: a dataset in DIR/dataset and the truth about it in DIR/truth.json."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from worlds.imperfect import make, write

app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)


class World(StrEnum):
    """The worlds of `imperfect`."""

    unknown_fill = "unknown_fill"
    before_after = "before_after"


@app.callback()
def main() -> None:
    """Make bench data with a known truth."""


@app.command()
def imperfect(
    seed: Annotated[int, typer.Option(min=0, help="The same seed makes the same files.")],
    output: Annotated[Path, typer.Option(help="Folder for dataset/ and truth.json; neither may exist there.")],
    world: Annotated[
        World | None, typer.Option(help="By default even seeds are unknown_fill, odd ones before_after.")
    ] = None,
) -> None:
    """A damper that differs from its parameter set, on a bench that is not perfect."""
    for path in (output / "dataset", output / "truth.json"):
        if path.exists():
            typer.echo(f"error: {path}: exists already", err=True)
            raise typer.Exit(2)
    write(make(seed, None if world is None else world.value), output)


if __name__ == "__main__":
    app()
