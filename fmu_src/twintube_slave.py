"""The damper as an FMI 2.0 co-simulation slave: FMI only, the equations are in the kernel.

One step carries the damper from its own stroke to `stroke + velocity * step`: the inputs are the values at the start of
the step, and the velocity holds within it. A master that knows the mean velocity of the coming step (leapfrog) gives that.

pythonfmu can answer OK, Discard or Fatal, not Error: a refused step is answered by Discard, with a message of status
Error in the log and the state as before, because Fatal would take the importer down.
"""

import json
from collections.abc import Callable
from dataclasses import Field, asdict, fields
from operator import attrgetter
from pathlib import Path
from typing import Any

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real
from pythonfmu.default_experiment import DefaultExperiment
from pythonfmu.enums import Fmi2Status

from twintube.core.checks import bad_input, outside, problems, stroke_limit
from twintube.core.effects import Parameters, State
from twintube.core.model import advance, set_up, start
from twintube.core.variables import Derived, Flow, Inputs, Outputs, blank, fmi_name

# Beyond this difference [m] between the stroke that is set and the one that the velocity led to, the log has a warning.
STROKE_JUMP = 0.02

READ: dict[str, Callable[[State], float]] = {
    "force": lambda s: s.F_fluid + s.F_friction + s.F_gas,
    "force_fluid": attrgetter("F_fluid"),
    "force_friction": attrgetter("F_friction"),
    "force_gas": attrgetter("F_gas"),
}


class TwinTube(Fmi2Slave):  # type: ignore[misc]  # pythonfmu is untyped
    """A degraded twin-tube shock absorber."""

    author = "twintube"
    license = "MIT"
    description = (
        "Twin-tube shock absorber after oil and gas loss (Schramm, Zwosta, Prokop 2025): stroke and velocity in, force out"
    )
    default_experiment = DefaultExperiment(start_time=0.0, stop_time=1.0, step_size=1e-3)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        start = json.loads((Path(self.resources) / "start.json").read_text(encoding="utf-8"))
        self.modelName = start["model_name"]
        self.p = Parameters(**start["parameters"])
        self.d: Derived = blank(Derived)
        self.s: State = blank(State)
        self.f: Flow = blank(Flow)
        self.inputs: Inputs = blank(Inputs)
        self.running = False
        self.problem = ""  # why the parameters cannot be used; every step is refused with it
        self.changed: dict[tuple[str, int], float] = {}  # tunable parameters set since the last step
        self.warned = False
        self.limit = 0.0
        self._read: list[Callable[[], float]] = []
        self._write: list[Callable[[float], None]] = []
        self._register()
        self._start()

    def _register(self) -> None:
        for item in fields(Inputs):
            self._add(item, fmi_name(item), Fmi2Causality.input, Fmi2Variability.continuous, self._input_access(item.name))
        for item in fields(Outputs):
            self._add(item, fmi_name(item), Fmi2Causality.output, Fmi2Variability.continuous, self._output_access(item.name))
        for item in fields(Parameters):
            kind = Fmi2Variability.tunable if item.metadata["tunable"] else Fmi2Variability.fixed
            for i in range(item.metadata["size"]):
                index = i if item.metadata["size"] > 1 else -1
                name = fmi_name(item) + (f"[{i + 1}]" if index >= 0 else "")
                self._add(item, name, Fmi2Causality.parameter, kind, self._parameter_access(item.name, index))

    def _add(self, item: Field[Any], name: str, causality: Any, variability: Any, access: Any) -> None:
        read, write = access
        kind = Integer if item.metadata["integer"] else Real
        variable = kind(
            name,
            causality=causality,
            variability=variability,
            description=item.metadata["description"],
            getter=read,
            setter=write,
        )
        self.register_variable(variable, nested=False)
        self._read.append(read)
        self._write.append(write)

    def _input_access(self, name: str) -> Any:
        return lambda: getattr(self.inputs, name), lambda value: setattr(self.inputs, name, value)

    def _output_access(self, name: str) -> Any:
        if name == "V3_gas":
            return lambda: max(0.0, self.d.V_reserve - self.s.V3_oil - self.s.V3_foam), None
        read = READ.get(name, attrgetter(name))
        return lambda: read(self.s), None

    def _parameter_access(self, name: str, index: int) -> Any:
        def read() -> float:
            value = getattr(self.p, name)
            return value[index] if index >= 0 else value  # type: ignore[no-any-return]

        def write(value: float) -> None:
            if self.running:
                self.changed[name, index] = value
            elif index >= 0:
                getattr(self.p, name)[index] = value
            else:
                setattr(self.p, name, value)

        return read, write

    # pythonfmu's own accessors look the variable up and check its type on every call; these are called in every step.
    def set_real(self, vrs: list[int], values: list[float]) -> None:
        for vr, value in zip(vrs, values, strict=True):
            self._write[vr](value)

    def get_real(self, vrs: list[int]) -> list[float]:
        if not self.running:
            self._start()
        return [self._read[vr]() for vr in vrs]

    def set_integer(self, vrs: list[int], values: list[int]) -> None:
        for vr, value in zip(vrs, values, strict=True):
            self._write[vr](value)

    def _start(self) -> None:
        """Check the parameters and put the damper at rest at the stroke that is set."""
        found = problems(self.p)
        if not found:
            set_up(self.p, self.d)
            self.limit = stroke_limit(self.d)
            message = bad_input(self.inputs.stroke, self.inputs.velocity, self.limit)
            found = [message] if message else []
        self.problem = "; ".join(found)
        if not found:
            z, v = self.inputs.stroke, self.inputs.velocity
            start(self.p, self.d, self.s, z)
            advance(self.p, self.d, self.s, self.f, z, v, v, 0.0)

    def exit_initialization_mode(self) -> None:
        self._start()
        self.running = True
        if self.problem:
            self.log(self.problem, Fmi2Status.error)

    def do_step(self, current_time: float, step_size: float) -> bool:
        z, v = self.inputs.stroke, self.inputs.velocity
        end = z + v * step_size
        if (
            self.problem
            or self.changed
            or not (
                -self.limit <= z <= self.limit
                and -self.limit <= end <= self.limit
                and step_size >= 0.0
                and -20.0 <= v <= 20.0
            )
        ):
            refusal = self.problem or self._apply_changes() or self._refusal(current_time, step_size)
            if refusal:
                self.log(f"time {current_time:g} s: {refusal}", Fmi2Status.error)
                return False
        s = self.s
        if not self.warned and not -STROKE_JUMP < z - s.z < STROKE_JUMP:
            self.warned = True
            self.log(
                f"time {current_time:g} s: stroke = {z:g} m, but the velocity led to {s.z:g} m; check its sign and unit",
                Fmi2Status.warning,
            )
        try:
            done = advance(self.p, self.d, s, self.f, end, v, v, step_size)
        except ArithmeticError:
            done = False
        if not done:
            self.problem = "the step could not be computed; please report this parameter set"
            self.log(f"time {current_time:g} s: {self.problem}", Fmi2Status.error)
            return False
        return True

    def _refusal(self, time: float, step_size: float) -> str:
        if not step_size >= 0.0:
            return f"communication step = {step_size:g} s: must be at least 0 s"
        z, v = self.inputs.stroke, self.inputs.velocity
        return bad_input(z, v, self.limit) or outside(
            "stroke at the end of the step", z + v * step_size, -self.limit, self.limit, "m"
        )

    def _apply_changes(self) -> str:
        """Take over the tunable parameters that were set; a message, and all as before, if they are not admissible."""
        if not self.changed:
            return ""
        tunable = {item.name for item in fields(Parameters) if item.metadata["tunable"]}
        fixed = [name for name, _ in self.changed if name not in tunable]
        if fixed:
            self.changed.clear()
            return f"{', '.join(fixed)}: fixed, cannot change after the initialization"
        before = asdict(self.p)
        for (name, index), value in self.changed.items():
            if index >= 0:
                getattr(self.p, name)[index] = value
            else:
                setattr(self.p, name, value)
        self.changed.clear()
        found = problems(self.p)
        if found:
            self.p = Parameters(**before)
            return "; ".join(found)
        set_up(self.p, self.d)
        return ""

    def _get_fmu_state(self) -> dict[str, Any]:
        return {
            "parameters": asdict(self.p),
            "state": asdict(self.s),
            "inputs": asdict(self.inputs),
            "running": self.running,
            "problem": self.problem,
            "warned": self.warned,
            "changed": [[name, index, value] for (name, index), value in self.changed.items()],
        }

    def _set_fmu_state(self, state: dict[str, Any]) -> None:
        self.p = Parameters(**state["parameters"])
        self.s = State(**state["state"])
        self.inputs = Inputs(**state["inputs"])
        self.running, self.problem, self.warned = state["running"], state["problem"], state["warned"]
        self.changed = {(name, index): value for name, index, value in state["changed"]}
        if not problems(self.p):
            set_up(self.p, self.d)
            self.limit = stroke_limit(self.d)
