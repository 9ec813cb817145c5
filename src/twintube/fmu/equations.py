"""The equations as a typed module, as pyccel reads it, and its digest, by which a build knows stale C."""

import ast
import hashlib
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields

from twintube.core import effects, sources
from twintube.core.agreement import Agreement
from twintube.core.consistency import Violation
from twintube.core.variables import FV_POINTS, Derived, Flow, Outputs
from twintube.vehicle.full import brakes, car, equation_texts, signals


@dataclass(frozen=True)
class Equations:
    """Equations of a model: its records, which arguments are of them, what the wrapper calls, the sources."""

    records: Mapping[str, type]
    arguments: Mapping[str, str]  # the record of an argument by its name
    entries: Sequence[str]
    texts: Callable[[], Iterable[str]]


def damper_texts() -> list[str]:
    """The sources of kernel, effects, model and rules."""
    texts = [*sources.kernel_texts(), *sources.effect_texts(), sources.agreement_text()]
    return [*texts, sources.model_text(), sources.rule_text()]


def car_texts() -> list[str]:
    """The sources of the car without dampers, and the rules of times and roads."""
    return [*equation_texts(), sources.agreement_text(), sources.rule_text()]


DAMPER = Equations(
    {
        "Parameters": effects.Parameters,
        "Derived": Derived,
        "State": effects.State,
        "Flow": Flow,
        "Outputs": Outputs,
        "Violation": Violation,
        "Agreement": Agreement,
    },
    {"p": "Parameters", "d": "Derived", "s": "State", "f": "Flow", "o": "Outputs", "violation": "Violation"},
    (
        "set_up", "start", "advance", "publish", "curve_rule", "fit_rule", "stroke_limit", "time_slack", "possible",
        "parted", "followed",
    ),
    damper_texts,
)  # fmt: skip
CAR = Equations(
    {
        "Body": car.Body,
        "BodyMotion": car.BodyMotion,
        "Wheel": car.Wheel,
        "WheelMotion": car.WheelMotion,
        "Brakes": brakes.Brakes,
        "DriverInputs": signals.DriverInputs,
        "WheelInputs": signals.WheelInputs,
        "BodyOutputs": signals.BodyOutputs,
        "WheelOutputs": signals.WheelOutputs,
        "Course": signals.Course,
        "Agreement": Agreement,
    },
    {"car": "Wheel"},  # the corner of a quarter car; other records are in the annotations
    ("set_up_car", "start_car", "communication_step", "publish_body", "publish_wheel", "time_slack", "parted", "followed"),
    car_texts,
)
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


def signature(node: ast.FunctionDef, records: Mapping[str, str]) -> str:
    """The first line of a function with the types that pyccel needs; `records` are those of arguments by their names."""
    arguments = []
    for argument in node.args.args:
        written = ast.unparse(argument.annotation) if argument.annotation else "float"
        kind = records.get(argument.arg, written.replace("tuple[float, ...]", "float[:]"))
        arguments.append(f"{argument.arg}: {kind!r}")
    returned = ast.unparse(node.returns) if node.returns else "None"
    if node.name.startswith("effects_"):
        returns = any(isinstance(item, ast.Return) and item.value is not None for item in ast.walk(node))
        returned = ("int" if node.name in INTEGERS else "float") if returns else "None"
    arrow = "" if returned == "None" else f" -> {returned!r}"
    return f"def {node.name}({', '.join(arguments)}){arrow}:"


def functions(text: str, records: Mapping[str, str], values: dict[str, float]) -> dict[str, str]:
    """The functions of a source by name: typed, with constants in place of their names, comments kept.

    `values` are the constants of the sources before it; its own are added.

    pyccel would make global variables of the constants.
    """
    body = ast.parse(text).body
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
            texts[node.name] = f"{signature(node, records)}\n{inside}"
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


def joined_source(equations: Equations = DAMPER) -> str:
    """One typed module of all equations, as pyccel reads it."""
    typed: dict[str, str] = {}
    values: dict[str, float] = {"FV_POINTS": FV_POINTS}
    for text in equations.texts():
        typed |= functions(text, equations.arguments, values)
    parts = ["import math", *(record_source(name, record) for name, record in equations.records.items())]
    parts += [typed[name] for name in ordered(typed, equations.entries)]
    return "\n\n\n".join(parts) + "\n"


def digest(equations: Equations = DAMPER) -> str:
    """Of the joined source; stands in the translated file, so that a build sees whether it is current."""
    return hashlib.sha256(joined_source(equations).encode()).hexdigest()[:16]


class StaleTranslationError(RuntimeError):
    """The C of the equations is not the translation of the Python equations."""


def marked(body: str, equations: Equations = DAMPER) -> str:
    """The C under a line that says what it was translated from, and the digest of the body: a change by hand shows."""
    body_digest = hashlib.sha256(body.encode()).hexdigest()[:16]
    origin = digest(equations)
    return (
        f"/* Written by twintube/fmu/translate.py from the equations {origin}, body {body_digest}; do not edit. */\n{body}"
    )


def checked(text: str, equations: Equations = DAMPER) -> str:
    """The text of `kernel.h`; raises StaleTranslationError unless it is the unchanged translation of the equations."""
    if text != marked(text.split("\n", 1)[-1], equations):
        raise StaleTranslationError(
            "the C is not the translation of this package's equations: run `python -m twintube.fmu.translate` and "
            "`python -m twintube.explorer.translate` (needs pyccel), or build the Python kind"
        )
    return text
