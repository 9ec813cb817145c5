"""What all commands share: the application, answers to bad input, files written whole."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import typer

from twintube.parameters import ParameterError
from twintube.simulate import InputError

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Twin-tube shock absorber after oil and gas loss: parameter sets, simulation, claims of the paper.",
)


@contextmanager
def answering() -> Iterator[None]:
    """Bad input ends with one line on standard error and exit status 2."""
    try:
        yield
    except (ParameterError, InputError, OSError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None


def write(path: Path, text: str) -> None:
    """Write a file whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    try:
        part.write_text(text, encoding="utf-8")
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
