"""From the effects' files to records and functions: what `core/effects/__init__.py` executes.

A file `<effect>.py` in the folder `effects` has the constants TITLE, CAUSE, ABSENCE, DECIDES, NEEDS_TIME and ORDER, the
records `Parameters` and (optional) `State`, whose own fields join the table of variables, and functions called
`<effect>_<hook>` in the kernel's subset of Python. Every parameter says its role (ROLES); an effect acts if one of its
strengths is not 0. A file `_<name>.py` has functions that an effect is made of.

Effects act in the order of their constants ORDER, whatever their files are called. The hooks are in `hook_table.py`.
"""

import ast
import re
from collections.abc import Callable
from dataclasses import Field, dataclass, field, fields, make_dataclass
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.hook_table import HOOKS, JOINED

FOLDER = Path(__file__).parent / "effects"
NEEDED = ("TITLE", "CAUSE", "ABSENCE", "DECIDES", "NEEDS_TIME", "ORDER", "Parameters")
# What a parameter of an effect is, for those who search its value.
ROLES = {
    "strength": "0 where the effect is absent",
    "place": "a position within the stroke [m]",
    "scale": "a length, time, mass or energy about its default",
    "law": "a power or share whose lower bound is a law of its own",
    "start": "what a record begins with, the same in none of them unless its temperature is known",
}


@dataclass(frozen=True)
class Effect:
    """One effect: `parameters` are its fields in the table, `strength` those that are 0 when it does not act."""

    name: str
    title: str
    cause: str
    absence: str
    decides: str  # the measurement that tells it from its look-alikes
    needs_time: bool
    parameters: tuple[Field[Any], ...]
    states: tuple[Field[Any], ...]

    @property
    def strength(self) -> tuple[str, ...]:
        """The names of the parameters that are 0 when it does not act."""
        return tuple(item.name for item in self.parameters if item.metadata["role"] == "strength")

    def acts(self, p: Any) -> bool:
        """Whether the effect acts in a parameter set."""
        return any(getattr(p, name) != 0.0 for name in self.strength)


def sources() -> dict[str, str]:
    """The text of every effect's file, by the effect's name."""
    return {path.stem: path.read_text(encoding="utf-8") for path in sorted(FOLDER.glob("[a-z]*.py"))}


def helpers() -> dict[str, str]:
    """The text of every file `_<name>.py`, with functions that an effect is made of, by `_<name>`."""
    return {path.stem: path.read_text(encoding="utf-8") for path in sorted(FOLDER.glob("_[a-z]*.py"))}


def strengths(text: str) -> tuple[str, ...]:
    """The names of the strengths in a file, read without importing it: effects call the functions generated from it."""
    names = []
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.AnnAssign(target=ast.Name(id=name), value=ast.Call(keywords=keywords)):
                if any(k.arg == "role" and ast.literal_eval(k.value) == "strength" for k in keywords):
                    names.append(name)
    if not names:
        raise ImportError('an effect without a parameter of role="strength"')
    return tuple(names)


def order(text: str) -> int:
    """The constant ORDER of a file, read without importing it; raises ImportError where it is missing."""
    for node in ast.parse(text).body:
        match node:
            case ast.Assign(targets=[ast.Name(id="ORDER")], value=ast.Constant(value=int() as value)):
                return value
    raise ImportError("an effect without a whole number ORDER")


def in_order() -> dict[str, str]:
    """The texts of `sources` in the order in which the effects act; raises ImportError where two have the same."""
    texts = sources()
    orders = {name: order(text) for name, text in texts.items()}
    names = sorted(texts, key=lambda name: orders[name])
    for first, second in pairwise(names):
        if orders[first] == orders[second]:
            raise ImportError(f"effects/{first}.py and effects/{second}.py both have ORDER = {orders[first]}")
    return {name: texts[name] for name in names}


def names_of(arguments: str) -> str:
    """`p, d` of `p: Parameters, d: Derived`."""
    return ", ".join(part.split(":")[0] for part in arguments.split(", "))


def dispatch_source() -> str:
    """The text of the functions `effects_<hook>`, and of two that say whether any effect acts, or has a force of its own."""
    texts = in_order()
    guard = {name: " or ".join(f"p.{item} != 0.0" for item in strengths(text)) for name, text in texts.items()}
    parts = [
        "def effects_active(p: Parameters) -> int:\n"
        + "".join(f"    if {condition}:\n        return 1\n" for condition in guard.values())
        + "    return 0\n"
    ]
    memory = [guarded for name, guarded in guard.items() if re.search(rf"^def {name}_force\(", texts[name], re.M)]
    parts.append(
        "def effects_remember(p: Parameters) -> int:\n"
        + "".join(f"    if {condition}:\n        return 1\n" for condition in memory)
        + "    return 0\n"
    )
    for hook, what in HOOKS.items():
        arguments = names_of(what.arguments)
        body, line, _ = JOINED[what.joined]
        for name, text in texts.items():
            if re.search(rf"^def {name}_{hook}\(", text, re.MULTILINE):
                body += f"    if {guard[name]}:\n        {line.format(f'{name}_{hook}({arguments})')}\n"
        body += "    return\n" if what.joined == "call" else "    return value\n"
        parts.append(f"def effects_{hook}({what.arguments}) -> {what.result}:\n{body}")
    return "\n\n".join(parts)


def own(record: type, base: type) -> tuple[Field[Any], ...]:
    """The fields that a record adds to its base."""
    inherited = {item.name for item in fields(base)}
    return tuple(item for item in fields(record) if item.name not in inherited)


def effect_of(name: str, module: ModuleType) -> Effect:
    """The effect that an imported file describes; raises ImportError where it lacks something."""
    missing = [key for key in NEEDED if not hasattr(module, key)]
    if missing:
        raise ImportError(f"effects/{name}.py lacks {', '.join(missing)}")
    parameters = own(module.Parameters, variables.Parameters)
    states = own(module.State, Frame) if hasattr(module, "State") else ()
    for record, items in (("Parameters", parameters), ("State", states)):
        for item in items:
            if item.metadata.get("default") is None:
                raise ImportError(f"effects/{name}.py: {record}.{item.name}: must be var(..., default=...)")
    for item in parameters:
        if item.metadata["role"] not in ROLES:
            role = item.metadata["role"]
            raise ImportError(f"effects/{name}.py: role = {role!r} of {item.name}: must be one of {', '.join(ROLES)}")
    return Effect(
        name,
        module.TITLE,
        module.CAUSE,
        module.ABSENCE,
        module.DECIDES,
        module.NEEDS_TIME,
        parameters,
        states,
    )


def hooks_of(name: str, module: ModuleType) -> dict[str, Callable[..., Any]]:
    """The functions `<effect>_...` of an imported file."""
    return {key: value for key, value in vars(module).items() if key.startswith(f"{name}_") and callable(value)}


def joined(name: str, base: type, groups: list[tuple[Field[Any], ...]], text: str, module: str, *, frozen: bool) -> type:
    """A record of `base` with the fields of all effects."""
    added: list[Any] = [(item.name, item.type, field(metadata=item.metadata)) for group in groups for item in group]
    names = [item[0] for item in added] + [item.name for item in fields(base)]
    twice = {item for item in names if names.count(item) > 1}
    if twice:
        raise ImportError(f"effects share the names {', '.join(sorted(twice))}")
    record = make_dataclass(name, added, bases=(base,), slots=True, frozen=frozen, namespace={"__module__": module})
    record.__doc__ = text
    return record


def reset_source(state: type) -> str:
    """The text of `effects_reset(s)`, which puts the states of all effects to their defaults."""
    extra = own(state, variables.State)
    return "def effects_reset(s: State) -> None:\n" + "".join(
        f"    s.{item.name} = {item.metadata['default']!r}\n" for item in extra
    )
