"""What a command may replace: a file that the user named, and what the same input wrote. All else stays, and it says so."""

import json
from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

from twintube.cli.base import RUNNING
from twintube.common.files import write_text
from twintube.errors import InputError

MARK = "made_from.json"
# Parameters of commands that do not change what is computed.
ELSEWHERE = ("output", "json_file", "plot", "processes", "cluster")


def named(option: str = "output") -> bool:
    """Whether the user gave this option of the running command."""
    return bool(RUNNING.get().get_parameter_source(option).name != "DEFAULT")


def typed(context: Any) -> list[str]:
    """The parameters of a command that its user gave."""
    sources = {name: context.get_parameter_source(name) for name in context.params}
    return [name for name, source in sources.items() if source is not None and source.name == "COMMANDLINE"]


def written_on(path: Path) -> str:
    """When a file was last written, for messages."""
    return datetime.fromtimestamp(path.stat().st_mtime).strftime("%Y-%m-%d %H:%M")


def refuse_other(path: Path, *, same: bool) -> None:
    """Raise InputError where a file at a place that the user did not name holds another result."""
    if path.exists() and not same:
        raise InputError(
            f"{path} holds another result, of {written_on(path)}, which stays; "
            f"to replace it name it: --output {path}, or name another file"
        )


def keep_other(path: Path, data: bytes) -> None:
    """`refuse_other` for a file that is the same whenever it is made from the same input."""
    if not named() and path.exists():
        refuse_other(path, same=path.read_bytes() == data)


def of_options() -> dict[str, str]:
    """What the running command computes from: all its options but the places of outputs; paths are resolved."""
    context = RUNNING.get()
    given = {name: value for name, value in context.params.items() if name not in ELSEWHERE and value is not None}
    return {"command": full_name(context)} | {name: resolved(value) for name, value in given.items()}


def full_name(context: Any) -> str:
    """The name of a command with that of its group, `paper figures`, without the program's."""
    name, above = str(context.command.name), context.parent
    return f"{above.command.name} {name}" if above is not None and above.parent is not None else name


def resolved(value: Any) -> str:
    """An option as text, a file in full."""
    several = value if isinstance(value, list | tuple) else [value]
    return ", ".join(str(Path(each).resolve() if Path(str(each)).is_file() else each) for each in several)


def check_folder(folder: Path, holds: Sequence[str], made_from: Mapping[str, str]) -> None:
    """Raise InputError where a folder `holds` one of these files, made from another input than its MARK says.

    A run of the same input replaces them, or goes on where it was interrupted.
    """
    mark = folder / MARK
    standing = [folder / name for name in holds if (folder / name).exists()]
    if standing:
        try:
            before = json.loads(mark.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            before = None
        if before != dict(made_from):
            other = (
                f"made from {difference(before, made_from)}" if isinstance(before, dict) else "that does not say its input"
            )
            raise InputError(
                f"{folder} holds a result {other} ({standing[0].name}, {written_on(standing[0])}), which stays; "
                "name another folder with --output, or remove this one"
            )


def mark_folder(folder: Path, made_from: Mapping[str, str]) -> None:
    """Say in a folder what its results are made from."""
    write_text(folder / MARK, json.dumps(dict(made_from), indent=1) + "\n")


def difference(before: Mapping[str, Any], now: Mapping[str, str]) -> str:
    """What the input of a result was where it is not that of now."""
    return ", ".join(f"{name} = {value}" for name, value in before.items() if now.get(name) != value) or "fewer options"
