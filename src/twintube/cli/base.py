"""What all commands share: the application, and answers to bad input."""

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand
from typer.models import CommandFunctionType

from twintube import __version__
from twintube.caches import lend
from twintube.engine.simulate import InputError
from twintube.errors import InputWarning, UserError
from twintube.extras import missing
from twintube.words import printable

STYLE: dict[str, Any] = {"add_completion": False, "rich_markup_mode": None, "pretty_exceptions_enable": False}
AS_PUBLISHED = Annotated[
    bool, typer.Option("--as-published", help="The paper's equations alone: gas that cavitation frees stays gas.")
]
# The context of the running command; Typer has it in a module of its own, which was click's in former versions.
RUNNING: ContextVar[Any] = ContextVar("running")
OUTPUTS = ("output", "json_file", "plot")  # parameters of commands that name what is written


@contextmanager
def answering() -> Iterator[None]:
    """Bad input ends with one line on standard error and exit status 2, also where a package of an extra is missing."""
    try:
        yield
    except ModuleNotFoundError as error:
        if not missing(error):
            raise
        typer.echo(f"error: {missing(error)}", err=True)
        raise typer.Exit(2) from None
    except BrokenPipeError:  # the reader has what it wanted, as in `twintube dampers | head -1`: ended without a word
        raise
    except OSError as error:
        place = f"{error.filename}: " if error.strerror and error.filename else ""
        typer.echo(printable(f"error: {place}{error.strerror or error}"), err=True)
        raise typer.Exit(2) from None
    except UserError as error:
        typer.echo(printable(f"error: {error}"), err=True)
        raise typer.Exit(2) from None


@contextmanager
def warning() -> Iterator[None]:
    """Every warning about the input is one line on standard error, said once; others are shown as Python does."""
    said: set[str] = set()

    def show(message: Warning | str, category: type[Warning], *rest: Any, **options: Any) -> None:
        if not issubclass(category, InputWarning):
            usual(message, category, *rest, **options)
        elif str(message) not in said:
            said.add(str(message))
            typer.echo(printable(f"warning: {message}"), err=True)

    with warnings.catch_warnings():
        usual = warnings.showwarning
        warnings.simplefilter("always", InputWarning)
        warnings.showwarning = show
        yield


def check_place(path: Path) -> None:
    """Raise InputError unless the folder of an output exists, or can be made in a folder that does."""
    folder = path.absolute().parent
    above = folder if folder.exists() else folder.parent
    if not above.exists():
        raise InputError(f"{path}: the folder {above} does not exist; only the last folder of an output is made")
    if not above.is_dir():
        raise InputError(f"{path}: {above} is not a folder")


class Command(TyperCommand):
    """A command that looks at the place of its output before it computes, and answers bad input with one line."""

    def invoke(self, ctx: Any) -> Any:
        """Run it."""
        RUNNING.set(ctx)
        with answering(), warning():
            lend()
            for name in OUTPUTS:
                if isinstance(path := ctx.params.get(name), Path):
                    check_place(path)
            return super().invoke(ctx)


class App(typer.Typer):
    """An application of such commands."""

    def command(self, *arguments: Any, **options: Any) -> Callable[[CommandFunctionType], CommandFunctionType]:
        """As Typer's."""
        return super().command(*arguments, **({"cls": Command} | options))


app = App(
    **STYLE,
    name="twintube",
    no_args_is_help=True,
)


def standalone(command: Callable[..., None]) -> typer.Typer:
    """An application of one command, for the scripts at the top level."""
    alone = App(**STYLE)
    alone.command()(command)
    return alone


def show_version(wanted: bool) -> None:
    """Print the version and end."""
    if wanted:
        typer.echo(f"twintube {__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=show_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Twin-tube shock absorber after oil and gas loss: parameter sets, simulation, FMU, identification, diagnosis."""
