"""What all commands share: the application, and answers to bad input."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import typer

from twintube.dampers import ParameterError
from twintube.engine.simulate import InputError

STYLE: dict[str, Any] = {"add_completion": False, "rich_markup_mode": None, "pretty_exceptions_enable": False}

app = typer.Typer(
    **STYLE,
    no_args_is_help=True,
    help="Twin-tube shock absorber after oil and gas loss: parameter sets, simulation, FMU, identification, diagnosis.",
)


def standalone(command: Callable[..., None]) -> typer.Typer:
    """An application of one command, for the scripts at the top level."""
    alone = typer.Typer(**STYLE)
    alone.command()(command)
    return alone


@contextmanager
def answering(*others: type[Exception]) -> Iterator[None]:
    """Bad input ends with one line on standard error and exit status 2; `others` are exceptions of the same kind."""
    refused: tuple[type[Exception], ...] = (ParameterError, InputError, OSError, *others)
    try:
        yield
    except refused as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None
