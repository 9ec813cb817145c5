"""Physical effects beyond the paper's model: one file each, nothing else names it.

A file `<effect>.py` in this folder has the constants TITLE, CAUSE, ABSENCE, DECIDES, STRENGTH and NEEDS_TIME, the records
`Parameters` and (optional) `State`, whose own fields join the table of variables, and functions called `<effect>_<hook>` in
the kernel's subset of Python. An effect acts if one of its parameters named by STRENGTH is not 0. From the files this
module makes the full records and one function per hook, which calls the hooks of the active effects by the order of their
names; the interpreter executes its text, `compiled.py` joins it to the kernel.

    hook            signature                         makes
    derive          (p, d)                            changes of `d` after kernel.prepare
    level           (p, level) -> level               the true oil level [1] at the start
    parts           (p, dt) -> number                 of parts that a step is divided into, the largest counts
    motion          (p, d, s, z, v0, v1, dt)          s.goal_z, s.goal_v0, s.goal_v1: what the piston sees
    phases          (p, s, way, dt)                   changes of the phases, before kernel.step
    transition      (p, s, f, v, dz)                  s.k_degr, f.k_degr, f.k_mean after kernel.step
    scale_fluid     (p, s, v) -> factor               of the fluid force in the direction of v
    scale_friction  (p, z, v) -> factor               of the friction force at the stroke z and the velocity v
    elastic         (p, z) -> force [N]               beside the gas force, no work
    rub             (p, z, v) -> force [N]            beside the friction, with the sign of v
    series          (p, s, F, dt) -> speed [m/s]      taken up in series with the valves at the fluid force F
    felt            (p, s, F, dt) -> force [N]        after the step, if the fluid force at the valves is F
    force           (p, s, v, dz, dt)                 s.F_fluid, s.F_valve, s.F_mean, s.W_step of a force with memory
    finish          (p, s, dt)                        what follows from forces and work
"""

import ast
import importlib
import re
from collections.abc import Callable
from dataclasses import Field, dataclass, field, fields, make_dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from twintube.core import variables
from twintube.core.frame import Frame

HOOKS = {
    "derive": ("p, d", "call"),
    "level": ("p, value", "chain"),
    "parts": ("p, dt", "most"),
    "motion": ("p, d, s, z, v0, v1, dt", "call"),
    "phases": ("p, s, way, dt", "call"),
    "transition": ("p, s, f, v, dz", "call"),
    "scale_fluid": ("p, s, v", "product"),
    "scale_friction": ("p, z, v", "product"),
    "elastic": ("p, z", "sum"),
    "rub": ("p, z, v", "sum"),
    "series": ("p, s, F, dt", "sum"),
    "felt": ("p, s, value, dt", "chain"),
    "force": ("p, s, v, dz, dt", "call"),
    "finish": ("p, s, dt", "call"),
}
FIRST = {"call": "", "chain": "", "sum": "    value = 0.0\n", "product": "    value = 1.0\n", "most": "    value = 1\n"}
LINE = {
    "call": "{}",
    "chain": "value = {}",
    "sum": "value += {}",
    "product": "value *= {}",
    "most": "value = max(value, {})",
}


@dataclass(frozen=True)
class Effect:
    """One effect: `parameters` are its fields in the table, `strength` those that are 0 when it does not act."""

    name: str
    title: str
    cause: str
    absence: str
    decides: str  # the measurement that tells it from its look-alikes
    strength: tuple[str, ...]
    needs_time: bool
    parameters: tuple[Field[Any], ...]
    states: tuple[Field[Any], ...]

    def acts(self, p: Any) -> bool:
        """Whether the effect acts in a parameter set."""
        return any(getattr(p, name) != 0.0 for name in self.strength)


def sources() -> dict[str, str]:
    """The text of every effect's file, by the effect's name."""
    files = sorted(Path(__file__).parent.glob("[a-z]*.py"))
    return {path.stem: path.read_text(encoding="utf-8") for path in files}


def strengths(text: str) -> tuple[str, ...]:
    """The constant STRENGTH of a file, read without importing it: effects call the functions made from it."""
    for node in ast.parse(text).body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name) and node.targets[0].id == "STRENGTH":
            return tuple(ast.literal_eval(node.value))
    raise ImportError("an effect without STRENGTH")


def dispatch_source() -> str:
    """The text of the functions `effects_<hook>`, and of `effects_active`, which says whether any effect acts."""
    texts = sources()
    guard = {name: " or ".join(f"p.{item} != 0.0" for item in strengths(text)) for name, text in texts.items()}
    parts = [
        "def effects_active(p):\n"
        + "".join(f"    if {condition}:\n        return 1\n" for condition in guard.values())
        + "    return 0\n"
    ]
    for hook, (arguments, kind) in HOOKS.items():
        body = FIRST[kind]
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


def load(name: str) -> Effect:
    """Import an effect's file and put its hooks beside the functions that call them."""
    module = importlib.import_module(f"{__name__}.{name}")
    globals().update({key: value for key, value in vars(module).items() if key.startswith(f"{name}_") and callable(value)})
    return Effect(
        name,
        module.TITLE,
        module.CAUSE,
        module.ABSENCE,
        module.DECIDES,
        strengths(sources()[name]),
        module.NEEDS_TIME,
        own(module.Parameters, variables.Parameters),
        own(module.State, Frame) if hasattr(module, "State") else (),
    )


def joined(name: str, base: type, groups: list[tuple[Field[Any], ...]], text: str) -> type:
    """A record of `base` with the fields of all effects."""
    added: list[Any] = [(item.name, item.type, field(metadata=item.metadata)) for group in groups for item in group]
    names = [item[0] for item in added] + [item.name for item in fields(base)]
    twice = {item for item in names if names.count(item) > 1}
    if twice:
        raise ImportError(f"effects share the names {', '.join(sorted(twice))}")
    made = make_dataclass(name, added, bases=(base,), slots=True, namespace={"__module__": __name__})
    made.__doc__ = text
    return made


def reset_source() -> str:
    """The text of `effects_reset(s)`, which puts the states of all effects to their defaults."""
    extra = own(State, variables.State)
    return "def effects_reset(s):\n" + "".join(f"    s.{item.name} = {item.metadata['default']!r}\n" for item in extra)


# The functions come first: an effect's file may import those that sum up other effects.
exec(compile(dispatch_source(), "<effects>", "exec"))
EFFECTS: dict[str, Effect] = {name: load(name) for name in sources()}

if TYPE_CHECKING:

    class Parameters(variables.Parameters):
        """The paper's parameters and those of all effects."""

        def __getattr__(self, name: str) -> float: ...

    class State(Frame):
        """The state of the kernel, of the extended step and of all effects."""

        def __getattr__(self, name: str) -> float: ...

    effects_active: Callable[..., int]
    effects_derive: Callable[..., None]
    effects_level: Callable[..., float]
    effects_parts: Callable[..., int]
    effects_motion: Callable[..., None]
    effects_phases: Callable[..., None]
    effects_transition: Callable[..., None]
    effects_scale_fluid: Callable[..., float]
    effects_scale_friction: Callable[..., float]
    effects_elastic: Callable[..., float]
    effects_rub: Callable[..., float]
    effects_series: Callable[..., float]
    effects_felt: Callable[..., float]
    effects_force: Callable[..., None]
    effects_finish: Callable[..., None]
    effects_reset: Callable[..., None]
else:
    Parameters = joined(
        "Parameters",
        variables.Parameters,
        [effect.parameters for effect in EFFECTS.values()],
        "The paper's parameters and those of all effects.",
    )
    State = joined(
        "State",
        Frame,
        [effect.states for effect in EFFECTS.values()],
        "The state of the kernel, of the extended step and of all effects.",
    )
    exec(compile(reset_source(), "<effects>", "exec"))


def neutral(p: variables.Parameters) -> dict[str, float]:
    """Parameters by name that make `p` the paper's model again: 0 for every strength that is not."""
    found = [name for effect in EFFECTS.values() for name in effect.strength]
    return {name: 0.0 for name in found if getattr(p, name) != 0.0}


def active(p: variables.Parameters) -> tuple[str, ...]:
    """Names of the effects that act in a parameter set."""
    return tuple(name for name, effect in EFFECTS.items() if effect.acts(p))


def needing_time(p: variables.Parameters) -> tuple[str, ...]:
    """Names of the active effects for which a record must have a time."""
    return tuple(name for name in active(p) if EFFECTS[name].needs_time)
