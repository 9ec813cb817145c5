"""The equations as a typed module, as pyccel reads it, and its digest, by which a build knows stale C."""

import ast
import hashlib
import re
from collections.abc import Sequence
from dataclasses import fields

from twintube.core import effects, sources
from twintube.core.consistency import Violation
from twintube.core.variables import FV_POINTS, Derived, Flow, Outputs

RECORDS = {
    "Parameters": effects.Parameters,
    "Derived": Derived,
    "State": effects.State,
    "Flow": Flow,
    "Outputs": Outputs,
    "Violation": Violation,
}
ARGUMENTS = {"p": "Parameters", "d": "Derived", "s": "State", "f": "Flow", "o": "Outputs", "violation": "Violation"}
# What the wrapper calls.
ENTRIES = (
    "set_up", "start", "advance", "publish", "curve_rule", "fit_rule", "stroke_limit", "time_slack", "stroke_jump",
    "possible",
)  # fmt: skip
INTEGERS = ("effects_active", "effects_parts", "effects_remember")  # of the functions generated from the effects' files


def record_source(name: str, record: type) -> str:
    """A record as the class with a typed `__init__` that pyccel wants; arrays are handed in, the rest starts at 0."""
    arrays = [item.name for item in fields(record) if item.metadata["size"] > 1]
    arguments = "".join(f", {item}: 'float[:]'" for item in arrays)
    lines = [f"class {name}:", f"    def __init__(self: '{name}'{arguments}):"]
    for item in fields(record):
        start = item.name if item.name in arrays else "0" if item.metadata["integer"] else "0.0"
        lines.append(f"        self.{item.name} = {start}")
    return "\n".join(lines)


def signature(node: ast.FunctionDef) -> str:
    """The first line of a function with the types that pyccel needs; those of the records go by the arguments' names."""
    arguments = []
    for argument in node.args.args:
        written = ast.unparse(argument.annotation) if argument.annotation else "float"
        kind = ARGUMENTS.get(argument.arg, written.replace("tuple[float, ...]", "float[:]"))
        arguments.append(f"{argument.arg}: {kind!r}")
    returned = ast.unparse(node.returns) if node.returns else "None"
    if node.name.startswith("effects_"):
        returns = any(isinstance(item, ast.Return) and item.value is not None for item in ast.walk(node))
        returned = ("int" if node.name in INTEGERS else "float") if returns else "None"
    arrow = "" if returned == "None" else f" -> {returned!r}"
    return f"def {node.name}({', '.join(arguments)}){arrow}:"


def functions(text: str) -> dict[str, str]:
    """The functions of a source by name: typed, with its constants in place of their names, comments kept.

    pyccel would make global variables of the constants.
    """
    body = ast.parse(text).body
    values: dict[str, float] = {"FV_POINTS": FV_POINTS}
    for node in body:
        match node:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Constant(value=int() | float() as value)):
                values[name] = value
    lines = text.splitlines()
    texts = {}
    for node in body:
        if isinstance(node, ast.FunctionDef):
            inside = "\n".join(lines[node.body[0].lineno - 1 : node.end_lineno])
            for name, value in values.items():
                inside = re.sub(rf"\b{name}\b", repr(value), inside)
            texts[node.name] = f"{signature(node)}\n{inside}"
    return texts


def ordered(texts: dict[str, str], entries: Sequence[str]) -> list[str]:
    """The entries and what they call, every function below those that it calls; raises ValueError on a recursion."""
    done: list[str] = []

    def place(name: str, above: tuple[str, ...]) -> None:
        if name in above:
            raise ValueError(f"{name} calls itself")
        if name not in done:
            for node in ast.walk(ast.parse(texts[name])):
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in texts:
                    place(node.func.id, (*above, name))
            done.append(name)

    for name in entries:
        place(name, ())
    return done


def joined_source() -> str:
    """One typed module of all equations, as pyccel reads it."""
    typed: dict[str, str] = {}
    for text in (*sources.kernel_texts(), *sources.effect_texts(), sources.model_text(), sources.rule_text()):
        typed |= functions(text)
    parts = ["import math", *(record_source(name, record) for name, record in RECORDS.items())]
    parts += [typed[name] for name in ordered(typed, ENTRIES)]
    return "\n\n\n".join(parts) + "\n"


def digest() -> str:
    """Of the joined source; stands in the translated file, so that a build sees whether it is current."""
    return hashlib.sha256(joined_source().encode()).hexdigest()[:16]


class StaleTranslationError(RuntimeError):
    """The C of the equations is not the translation of the Python equations."""


def marked(body: str) -> str:
    """The C under a line that says what it was translated from, and the digest of the body: a change by hand shows."""
    body_digest = hashlib.sha256(body.encode()).hexdigest()[:16]
    return (
        f"/* Written by twintube/fmu/translate.py from the equations {digest()}, body {body_digest}; do not edit. */\n{body}"
    )


def checked(text: str) -> str:
    """The text of `kernel.h`; raises StaleTranslationError unless it is the unchanged translation of the equations."""
    if text != marked(text.split("\n", 1)[-1]):
        raise StaleTranslationError(
            "kernel.h is not the translation of this package's equations: run `python -m twintube.fmu.translate` "
            "(needs pyccel), or build the Python kind"
        )
    return text
