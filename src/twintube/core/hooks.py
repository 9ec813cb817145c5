"""From the effects' files to records and functions: what `core/effects/__init__.py` executes.

A file `<effect>.py` in the folder `effects` has the constants TITLE, CAUSE, ABSENCE, DECIDES and NEEDS_TIME, the records
`Parameters` and (optional) `State`, whose own fields join the table of variables, and functions called `<effect>_<hook>` in
the kernel's subset of Python. Every parameter says its role (ROLES); an effect acts if one of its strengths is not 0.

    hook            signature                         result
    derive          (p, d)                            changes of `d` after kernel.prepare
    level           (p, level) -> level               the true oil level [1] at the start
    parts           (p, dt) -> number                 of parts that a step is divided into, the largest counts
    motion          (p, d, s, z, v0, v1, dt)          s.goal_z, s.goal_v0, s.goal_v1: what the piston sees
    phases          (p, s, way, dt)                   changes of the phases, before kernel.step
    transition      (p, s, f, v, dz)                  s.k_degr, f.k_degr, f.k_mean after kernel.step
    scale_fluid     (p, s, v) -> factor               of the fluid force in the direction of v
    scale_valve     (p, u) -> factor                  of the intact fluid force at the speed u at the valves
    bypass          (p, F) -> speed [m/s]             past the valves at their intact force F, as scale_valve says
    scale_friction  (p, s, z, v) -> factor            of the friction force at the stroke z and the velocity v
    elastic         (p, s, z) -> force [N]            added to the gas force, no work
    rub             (p, z, v) -> force [N]            added to the friction, with the sign of v
    series          (p, s, F, dt) -> speed [m/s]      taken up in series with the valves at the fluid force F
    rebalance       (p, d, s, v, dt)                  s.goal_v1 after the step has changed s.k_re or s.k_co
    felt            (p, s, F, dt) -> force [N]        after the step, if the fluid force at the valves is F
    force           (p, s, v, dz, dt)                 s.F_fluid, s.F_valve, s.F_mean, s.W_step of a force with memory
    finish          (p, s, dt)                        what follows from forces and work
    lost            (p, duration, way, square)        oil [m3] that a record takes along, for those after it; not in a step
"""

import ast
import re
from collections.abc import Callable
from dataclasses import Field, dataclass, field, fields, make_dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from twintube.core import variables
from twintube.core.frame import Frame

FOLDER = Path(__file__).parent / "effects"
# Arguments of a hook and their types, its result, and how the results of several effects are joined.
HOOKS = {
    "derive": ("p: Parameters, d: Derived", "None", "call"),
    "level": ("p: Parameters, value: float", "float", "chain"),
    "parts": ("p: Parameters, dt: float", "int", "most"),
    "motion": ("p: Parameters, d: Derived, s: State, z: float, v0: float, v1: float, dt: float", "None", "call"),
    "phases": ("p: Parameters, s: State, way: float, dt: float", "None", "call"),
    "transition": ("p: Parameters, s: State, f: Flow, v: float, dz: float", "None", "call"),
    "scale_fluid": ("p: Parameters, s: State, v: float", "float", "product"),
    "scale_valve": ("p: Parameters, u: float", "float", "product"),
    "bypass": ("p: Parameters, F: float", "float", "sum"),
    "scale_friction": ("p: Parameters, s: State, z: float, v: float", "float", "product"),
    "elastic": ("p: Parameters, s: State, z: float", "float", "sum"),
    "rub": ("p: Parameters, z: float, v: float", "float", "sum"),
    "series": ("p: Parameters, s: State, F: float, dt: float", "float", "sum"),
    "rebalance": ("p: Parameters, d: Derived, s: State, v: float, dt: float", "None", "call"),
    "felt": ("p: Parameters, s: State, value: float, dt: float", "float", "chain"),
    "force": ("p: Parameters, s: State, v: float, dz: float, dt: float", "None", "call"),
    "finish": ("p: Parameters, s: State, dt: float", "None", "call"),
    "lost": ("p: Parameters, level: float, z: float, duration: float, way: float, square: float", "float", "sum"),
}
FIRST = {"call": "", "chain": "", "sum": "    value = 0.0\n", "product": "    value = 1.0\n", "most": "    value = 1\n"}
LINE = {
    "call": "{}",
    "chain": "value = {}",
    "sum": "value += {}",
    "product": "value *= {}",
    "most": "value = max(value, {})",
}
NEEDED = ("TITLE", "CAUSE", "ABSENCE", "DECIDES", "NEEDS_TIME", "Parameters")
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


def names_of(arguments: str) -> str:
    """`p, d` of `p: Parameters, d: Derived`."""
    return ", ".join(part.split(":")[0] for part in arguments.split(", "))


def dispatch_source() -> str:
    """The text of the functions `effects_<hook>`, and of two that say whether any effect acts, or has a force of its own."""
    texts = sources()
    guard = {name: " or ".join(f"p.{item} != 0.0" for item in strengths(text)) for name, text in texts.items()}
    parts = [
        "def effects_active(p):\n"
        + "".join(f"    if {condition}:\n        return 1\n" for condition in guard.values())
        + "    return 0\n"
    ]
    memory = [guarded for name, guarded in guard.items() if re.search(rf"^def {name}_force\(", texts[name], re.M)]
    parts.append(
        "def effects_remember(p):\n"
        + "".join(f"    if {condition}:\n        return 1\n" for condition in memory)
        + "    return 0\n"
    )
    for hook, (typed, _, kind) in HOOKS.items():
        arguments, body = names_of(typed), FIRST[kind]
        for name, text in texts.items():
            if re.search(rf"^def {name}_{hook}\(", text, re.MULTILINE):
                line = LINE[kind].format(f"{name}_{hook}({arguments})")
                body += f"    if {guard[name]}:\n        {line}\n"
        body += "    return\n" if kind == "call" else "    return value\n"
        parts.append(f"def effects_{hook}({arguments}):\n{body}")
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
        own(module.State, Frame) if hasattr(module, "State") else (),
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
    return "def effects_reset(s):\n" + "".join(f"    s.{item.name} = {item.metadata['default']!r}\n" for item in extra)
