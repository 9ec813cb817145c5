"""A damper that is stepped from outside: parameters that wait for the next step, start, steps, state.

What `fmu_src/native/step.h` is for the native FMU. Messages instead of exceptions: the FMU around it has to answer.
"""

import math
import sys
from dataclasses import asdict, fields
from operator import attrgetter
from types import SimpleNamespace
from typing import Any

from twintube.core import messages
from twintube.core.agreement import Agreement, followed, parted, ways
from twintube.core.checks import out_of_bounds, out_of_range, outside, problems
from twintube.core.consistency import SAFE_STEP, possible, time_slack
from twintube.core.effects import Parameters, State
from twintube.core.frame import stroke_limit
from twintube.core.kernel.temperature import within_law
from twintube.core.model import advance, set_up, start
from twintube.core.publishing import NAMES, publish
from twintube.core.variables import Derived, Flow, Inputs, blank
from twintube.core.variables import State as PaperState

LARGEST = sys.float_info.max
# What a step changes: without effects the kernel's state only.
PAPER, FULL, FLOW = (tuple(item.name for item in fields(record)) for record in (PaperState, State, Flow))
paper_of, full_of, flow_of = attrgetter(*PAPER), attrgetter(*FULL), attrgetter(*FLOW)


class StateError(ValueError):
    """Serialized fields that are not those of a damper."""


def record_of(kind: type, values: Any) -> Any:
    """A record from its serialized fields; raises StateError unless each has finite numbers of its type."""
    if not isinstance(values, dict) or set(values) != {item.name for item in fields(kind)}:
        raise StateError(kind.__name__)
    for item in fields(kind):
        size, types = item.metadata["size"], (int,) if item.metadata["integer"] else (int, float)
        numbers = values[item.name] if size > 1 else [values[item.name]]
        if not isinstance(numbers, list | tuple) or len(numbers) != size:
            raise StateError(item.name)
        for number in numbers:
            if type(number) not in types or not -LARGEST <= number <= LARGEST:
                raise StateError(item.name)
    return kind(**values)


class Instance:
    """A damper with the given parameters, at rest at stroke 0 until `begin` puts it to where its inputs are."""

    RECORDS = ("parameters", "wanted", "inputs", "state", "flow", "agreement")

    def __init__(self, parameters: dict[str, Any]) -> None:
        self.p = Parameters(**parameters)  # in force
        self.wanted = asdict(self.p)  # with what was set since the last step
        self.inputs: Inputs = blank(Inputs)
        self.inputs.temperature = self.p.T_curve
        self.d: Derived = blank(Derived)
        self.s: State = blank(State)
        self.f: Flow = blank(Flow)
        self.o = SimpleNamespace(**dict.fromkeys(NAMES, 0.0))
        self.limit = 0.0  # [m] largest stroke to each side
        self.held: tuple[float, ...] = ()  # `s` after the last step, for a step that has to be taken back
        self.changed = False  # `wanted` differs from `p`
        self.a: Agreement = blank(Agreement)
        self.warned = False  # that velocity and stroke have parted; then nobody looks any more
        self.long_step = False  # that a step longer than SAFE_STEP was warned of
        self.beyond_law = False  # that a temperature beyond the law of the damper was warned of
        self.remarks: list[str] = []  # of the last step

    def set_parameter(self, name: str, index: int, value: float) -> None:
        """Let a value wait for the next step; `index` is that in an array, -1 for a single value."""
        if index >= 0:
            values = self.wanted[name]
            self.wanted[name] = (*values[:index], value, *values[index + 1 :])
        else:
            self.wanted[name] = value
        self.changed = True

    def take_over(self) -> str:
        """Put the parameters in force that wait; a message, and nothing changed, where they are not admissible."""
        p = Parameters(**self.wanted)
        texts = problems(p)
        if not texts:
            self.p, self.changed = p, False
            self.derive()
        return "; ".join(texts)

    def derive(self) -> None:
        """What follows from the parameters in force."""
        set_up(self.p, self.d)
        self.limit = stroke_limit(self.d)

    def begin(self) -> str:
        """Put the damper at rest at the stroke that is set; a message where that cannot be."""
        z, v = self.inputs.stroke, self.inputs.velocity
        text = self.take_over() or outside("stroke", z, -self.limit, self.limit, "m")
        if text:
            return text
        self.s, self.f, self.a = blank(State), blank(Flow), blank(Agreement)
        self.a.stroke, self.a.velocity = z, v
        try:
            start(self.p, self.d, self.s, z)
            self.s.temperature = self.inputs.temperature
            advance(self.p, self.d, self.s, self.f, z, v, v, 0.0)
            publish(self.d, self.s, self.o)
        except (ArithmeticError, ValueError):
            return messages.NO_START
        return "" if self.computed() else messages.NO_START

    def computed(self) -> bool:
        """Whether all is a number; then it is held for a step that has to be taken back."""
        values: tuple[float, ...] = (full_of if self.d.extended else paper_of)(self.s)
        # The sum is not a number where one of them is not.
        if not math.isfinite(sum(values) + self.o.force) and not all(map(math.isfinite, (*values, self.o.force))):
            return False
        self.held = values
        return True

    def move(self, time: float, h: float) -> str:
        """One step of `h` >= 0 [s] from `time` [s]; a message, and the state as before, where it is refused."""
        if self.changed:
            text = self.take_over()
            if text:
                self.wanted, self.changed = asdict(self.p), False
                return text
        z, v, limit, s = self.inputs.stroke, self.inputs.velocity, self.limit, self.s
        end = z + v * h
        if not (-limit <= z <= limit and -limit <= end <= limit):
            text = outside("stroke", z, -limit, limit, "m")
            return text or outside("stroke at the end of the step", end, -limit, limit, "m")
        flow = flow_of(self.f)
        s.temperature = self.inputs.temperature
        try:
            done = advance(self.p, self.d, s, self.f, end, v, v, h)
            publish(self.d, s, self.o)
        except (ArithmeticError, ValueError):
            done = False
        if not done or not self.computed():
            for record, names, values in ((s, FULL if self.d.extended else PAPER, self.held), (self.f, FLOW, flow)):
                for name, value in zip(names, values, strict=True):
                    setattr(record, name, value)
            publish(self.d, s, self.o)
            return messages.NO_STEP % time
        self.remarks = self.warnings(time, h)
        return ""

    def warnings(self, time: float, h: float) -> list[str]:
        """What is to be said of the step, each kind of warning once in a run."""
        texts = []
        if not self.long_step and h > SAFE_STEP + time_slack(time, h):
            self.long_step = True
            texts.append(messages.LONG_STEP % (time, h, SAFE_STEP))
        if not self.beyond_law and not within_law(self.p, self.s.T):
            self.beyond_law = True
            texts.append(f"time {time:g} s: " + messages.BEYOND_LAW % (self.s.T, self.p.T_cold, self.p.T_hot))
        if not self.warned and parted(self.a, self.inputs.stroke, self.inputs.velocity, h):
            self.warned = True
            texts.append(messages.parted(time, *ways(self.a)))
        return texts

    def kept(self) -> dict[str, Any]:
        """The state as numbers and lists."""
        return {
            "changed": self.changed,
            "warned": self.warned,
            "long_step": self.long_step,
            "beyond_law": self.beyond_law,
            "parameters": asdict(self.p),
            "wanted": dict(self.wanted),
            "inputs": asdict(self.inputs),
            "state": asdict(self.s),
            "flow": asdict(self.f),
            "agreement": asdict(self.a),
        }

    @classmethod
    def restored(cls, state: Any, *, begun: bool) -> "Instance":
        """A damper in a state that was kept; raises StateError otherwise. `begun`: the start was computed."""
        flags = ("changed", "warned", "long_step", "beyond_law")
        if not isinstance(state, dict) or set(state) != {*flags, *cls.RECORDS}:
            raise StateError("fields")
        if any(type(state[flag]) is not bool for flag in flags):
            raise StateError("flags")
        p, wanted = record_of(Parameters, state["parameters"]), record_of(Parameters, state["wanted"])
        new = cls(asdict(p))
        new.wanted = asdict(wanted)
        for flag in flags:
            setattr(new, flag, state[flag])
        kinds = {"inputs": Inputs, "state": State, "flow": Flow, "agreement": Agreement}
        new.inputs, new.s, new.f, new.a = (record_of(kind, state[key]) for key, kind in kinds.items())
        beyond = [out_of_range(item, getattr(new.inputs, item.name)) for item in fields(Inputs)]
        if out_of_bounds(p) or out_of_bounds(wanted) or any(beyond) or not followed(new.a) or (begun and problems(p)):
            raise StateError("bounds")
        if begun:
            new.derive()
            publish(new.d, new.s, new.o)
            if not new.computed() or not possible(new.d, new.s):
                raise StateError("state")
        return new
