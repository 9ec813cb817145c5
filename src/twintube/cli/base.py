"""What all commands share: the application, and answers to bad input."""

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from contextvars import ContextVar
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup
from typer.models import CommandFunctionType

from twintube.common.caches import lend
from twintube.common.extras import missing
from twintube.common.words import printable
from twintube.errors import InputError, InputWarning, UserError
from twintube.version import __version__

# No rich text: it takes longer to import than all else that the help needs.
STYLE: dict[str, Any] = {
    "context_settings": {"help_option_names": ["-h", "--help"]},
    "rich_markup_mode": None,
    "pretty_exceptions_enable": False,
}
# Groups of commands in the help, in this order.
MODEL, BENCH, VEHICLE, PAPER = "Model and FMU", "Bench data", "Vehicle", "Paper"
PANELS = (MODEL, BENCH, VEHICLE, PAPER)
# Former names, which work for a release: what is typed now, and for commands of another shape, which `former.py` holds,
# what is said.
MOVED = {
    "claims": "paper claims",
    "reproduce": "paper figures",
    "readings": "paper readings",
    "calibrate": "paper calibrate",
    "rig": "paper rig",
    "variables": "dampers --variables",
}
REPLACED = {
    "ssv": "twintube fmu --ssv",
    "container": "twintube ssp --container",
    "sensitivity": "python -m benchmarks sensitivity",
    "car-sensitivity": "python -m benchmarks car_sensitivity",
}
LASTS = "the former name works until the next release"
# The context of the running command; Typer has it in a module of its own, which was click's in former versions.
RUNNING: ContextVar[Any] = ContextVar("running")
USAGE_ERROR: Any = typer.BadParameter.__bases__[0]  # click's UsageError, which Typer does not pass on
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
def parsing() -> Iterator[None]:
    """A name or a value that the command line does not know is bad input like any other: one line, not click's four."""
    try:
        yield
    except USAGE_ERROR as error:
        place = f"; see {error.ctx.command_path} -h" if error.ctx else ""
        text = " ".join(error.format_message().split()).rstrip(".").replace("Value error, ", "")
        typer.echo(printable(f"error: {text}{place}"), err=True)
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


def renamed(words: Sequence[str], former: Mapping[str, str], say: Callable[[str], None]) -> list[str]:
    """The words behind a command with its `former` options under their names of now, an empty one for an argument."""
    kept: list[str] = []
    arguments: list[str] = []
    rest = iter(words)
    for word in rest:
        name, sign, value = word.partition("=")
        new = former.get(name)
        if new:
            say(f"{name} is {new} now; {LASTS}")
            kept.append(new + sign + value)
        elif new is None or not (value := value or next(rest, "")):
            kept.append(word)
        else:
            say(f"{name} {value} is just {value} now; {LASTS}")
            arguments.append(value)
    return kept + arguments


class Command(TyperCommand):
    """A command that looks at the place of its output before it computes, and answers bad input with one line."""

    former: Mapping[str, str] = {}

    def make_context(self, info_name: str | None, args: list[str], parent: Any = None, **options: Any) -> Any:
        """Read the command line; a script of its own keeps the names that it has."""

        def say(text: str) -> None:
            if parent is not None:
                typer.echo(f"{parent.command_path} {info_name}: {text}", err=True)

        with parsing():
            return super().make_context(info_name, renamed(args, self.former, say), parent, **options)

    def invoke(self, ctx: Any) -> Any:
        """Run it."""
        RUNNING.set(ctx)
        with answering(), warning():
            lend()
            for name in OUTPUTS:
                if isinstance(path := ctx.params.get(name), Path):
                    check_place(path)
            return super().invoke(ctx)

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        """As usual, `DAMPER` for what Typer writes as `{DAMPER}`."""
        return [piece.strip("{}") for piece in super().collect_usage_pieces(ctx)]

    def format_options(self, ctx: Any, formatter: Any) -> None:
        """Names as metavars say them, without the types of Python that Typer puts behind those of arguments."""
        for title, kind in (("Arguments", "argument"), ("Options", "option")):
            records = [each.get_help_record(ctx) for each in self.get_params(ctx) if each.param_type_name == kind]
            rows = [(name.partition(" <")[0], text) for name, text in filter(None, records)]
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows)


class Group(TyperGroup):
    """Commands in groups, each sorted, with the whole first line of their help."""

    def make_context(self, info_name: str | None, args: list[str], *more: Any, **options: Any) -> Any:
        """Read the command line; without arguments click answers with the help."""
        with parsing() if args else nullcontext():
            return super().make_context(info_name, args, *more, **options)

    def list_commands(self, ctx: Any) -> list[str]:
        """The names in the order of the alphabet."""
        return sorted(name for name, command in self.commands.items() if not command.hidden)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """A section for each group."""
        width = max(map(len, self.list_commands(ctx)))
        for title in PANELS:
            known: list[tuple[str, Any]] = [(name, self.commands[name]) for name in self.list_commands(ctx)]
            rows = [(f"{name:{width}}", first_line(each)) for name, each in known if each.rich_help_panel == title]
            if rows:
                with formatter.section(title):
                    formatter.write_dl(rows)

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """As Typer does; a command that had another name runs, and says the one of now."""
        known = self.commands.get(args[0])
        if known is None and args[0] in MOVED:
            typer.echo(f"'twintube {args[0]}' is 'twintube {MOVED[args[0]]}' now; {LASTS}", err=True)
            args = [*MOVED[args[0]].split(), *args[1:]]
        elif known is not None and known.hidden:
            typer.echo(f"'twintube {args[0]}' is '{REPLACED[args[0]]}' now; {LASTS}", err=True)
        with parsing():
            return super().resolve_command(ctx, args)


def first_line(command: Any) -> str:
    """The first paragraph of a command's help, in one line."""
    return " ".join((command.help or "").split("\n\n", maxsplit=1)[0].split())


class App(typer.Typer):
    """An application of such commands."""

    def command(
        self, *arguments: Any, former: Mapping[str, str] | None = None, **options: Any
    ) -> Callable[[CommandFunctionType], CommandFunctionType]:
        """As Typer's; `former` options are read as those of now, or as an argument where that is empty."""
        own = type("Command", (Command,), {"former": former or {}})
        return super().command(*arguments, **({"cls": own} | options))


app = App(**STYLE, name="twintube", cls=Group, no_args_is_help=True)


def standalone(command: Callable[..., None], former: Mapping[str, str] | None = None) -> typer.Typer:
    """An application of one command, for the scripts at the top level."""
    alone = App(**STYLE, add_completion=False)
    alone.command(former=former)(command)
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
    """Twin-tube shock absorber after oil and gas loss: simulation, FMU, diagnosis.

    Behind a command, -h lists its options: twintube fmu -h
    """
