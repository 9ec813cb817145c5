"""The damper as an FMI 2.0 co-simulation slave: FMI only, the equations are in the kernel.

One step carries the damper from its own stroke to `stroke + velocity * step`: the inputs are the values at the start of
the step, and the velocity holds within it. A master that knows the mean velocity of the coming step (leapfrog) gives that.

Checks and messages are those of the native FMU. pythonfmu passes on what a step returns, OK or Discard, but not whether a
value or a state was accepted, and an exception would be Fatal, after which importers crash. A refused value or state is
therefore logged at once, changes nothing, and the coming step is refused too, so that the importer notices.

pythonfmu drops what is logged unless the importer has turned its debug logging on; Python's own logger "twintube.fmu" has
every message in any case.
"""

import json
import logging
import math
from collections.abc import Callable, Sequence
from dataclasses import Field, fields
from pathlib import Path
from typing import Any

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real
from pythonfmu.default_experiment import DefaultExperiment
from pythonfmu.enums import Fmi2Status

from twintube.core import messages
from twintube.core.checks import out_of_range, outside
from twintube.core.consistency import LONGEST, time_slack
from twintube.core.effects import Parameters
from twintube.core.instance import Instance, StateError
from twintube.core.variables import Inputs, Outputs, fmi_name

INSTANTIATED, INITIALIZING, STEPPING, TERMINATED = range(len(messages.MODES))
LOG = logging.getLogger("twintube.fmu")
LEVEL = {Fmi2Status.warning: logging.WARNING, Fmi2Status.error: logging.ERROR}
# Name and bounds of the inputs by their value references, and bounds that nothing keeps.
INPUTS = {i: (item.name, item.metadata["lower"], item.metadata["upper"]) for i, item in enumerate(fields(Inputs))}
REFUSED = ("", math.inf, -math.inf)


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
        content = json.loads((Path(self.resources) / "start.json").read_text(encoding="utf-8"))
        self.modelName = content["model_name"]
        self.identity = content["identity"]
        self.damper = Instance(content["parameters"])
        self.mode = INSTANTIATED
        self.time: float | None = None  # [s] where the last step ended
        self.stop = math.inf
        self.stale = True  # the start has to be computed again
        self.refusal = ""  # why the coming step is refused
        self._fields: list[tuple[Field[Any], Any, int]] = []  # by value references: field, causality, index in an array
        self._names: list[str] = []
        self._read: list[Callable[[], float]] = []
        self._register()

    def _register(self) -> None:
        for item in fields(Inputs):
            self._add(item, Fmi2Causality.input, Fmi2Variability.continuous)
        for item in fields(Outputs):
            self._add(item, Fmi2Causality.output, Fmi2Variability.continuous)
        for item in fields(Parameters):
            kind = Fmi2Variability.tunable if item.metadata["tunable"] else Fmi2Variability.fixed
            for i in range(item.metadata["size"]):
                self._add(item, Fmi2Causality.parameter, kind, i if item.metadata["size"] > 1 else -1)

    def _add(self, item: Field[Any], causality: Any, variability: Any, index: int = -1) -> None:
        name = fmi_name(item) + (f"[{index + 1}]" if index >= 0 else "")
        kind = Integer if item.metadata["integer"] else Real
        read = self._reader(item.name, causality, index)
        text = item.metadata["description"]
        self.register_variable(
            kind(name, causality=causality, variability=variability, description=text, getter=read), nested=False
        )
        self._fields.append((item, causality, index))
        self._names.append(name)
        self._read.append(read)

    def _reader(self, name: str, causality: Any, index: int) -> Callable[[], float]:
        if causality == Fmi2Causality.input:
            return lambda: getattr(self.damper.inputs, name)
        if causality == Fmi2Causality.output:
            return lambda: getattr(self.damper.o, name)
        if index < 0:
            return lambda: self.damper.wanted[name]
        return lambda: self.damper.wanted[name][index]

    # What is said

    def _say(self, text: str, status: Fmi2Status = Fmi2Status.error) -> None:
        text = text.replace("%", "?").replace("#", "?")  # importers read messages as formats
        self.log(text, status)
        LOG.log(LEVEL[status], "%s: %s", self.instance_name, text)

    def _refuse(self, text: str) -> None:
        """Log at once, and let the coming step say so to the importer."""
        self.refusal = text
        self._say(text)

    def _allowed(self, function: str, *modes: int) -> bool:
        if self.mode in modes:
            return True
        self._refuse(messages.NOT_NOW % (function, messages.MODES[self.mode]))
        return False

    # Values; pythonfmu's own accessors check types on every call, these are called in every step.

    def get_real(self, vrs: Sequence[int]) -> list[float]:
        if self.mode < STEPPING and self.stale:
            text = self._begin()
            if text:
                self._say(text)
        return [self._read[vr]() for vr in vrs]

    def set_real(self, vrs: Sequence[int], values: Sequence[float]) -> None:
        if self.mode == STEPPING:
            # The inputs of every step, without the detours of the other variables.
            for vr, value in zip(vrs, values, strict=True):
                _, low, high = INPUTS.get(vr, REFUSED)
                if not low <= value <= high:
                    break
            else:
                for vr, value in zip(vrs, values, strict=True):
                    setattr(self.damper.inputs, INPUTS[vr][0], value)
                return
        self._set("fmi2SetReal", False, vrs, values)

    def set_integer(self, vrs: Sequence[int], values: Sequence[int]) -> None:
        self._set("fmi2SetInteger", True, vrs, values)

    def _set(self, function: str, integer: bool, vrs: Sequence[int], values: Sequence[float]) -> None:
        """Set all values or, if one of them is refused, none."""
        if not self._allowed(function, INSTANTIATED, INITIALIZING, STEPPING):
            return
        for vr, value in zip(vrs, values, strict=True):
            text = self._unsettable(function, integer, vr, value)
            if text:
                self._refuse(text)
                return
        for vr, value in zip(vrs, values, strict=True):
            item, causality, index = self._fields[vr]
            if causality == Fmi2Causality.input:
                setattr(self.damper.inputs, item.name, value)
            else:
                self.damper.set_parameter(item.name, index, value)
            self.stale = self.mode < STEPPING

    def _unsettable(self, function: str, integer: bool, vr: int, value: float) -> str:
        if not 0 <= vr < len(self._fields) or self._fields[vr][0].metadata["integer"] != integer:
            return messages.NO_VARIABLE % (function, "Integer" if integer else "Real", vr)
        item, causality, _ = self._fields[vr]
        if causality == Fmi2Causality.output:
            return messages.NOT_SETTABLE % self._names[vr]
        if self.mode == STEPPING and causality == Fmi2Causality.parameter and not item.metadata["tunable"]:
            return messages.FIXED % self._names[vr]
        return out_of_range(item, value)

    # Start and end

    def setup_experiment(self, start_time: float, stop_time: float | None = None, _tolerance: float | None = None) -> None:
        if not self._allowed("fmi2SetupExperiment", INSTANTIATED):
            return
        text = outside("start time", start_time, -LONGEST, LONGEST, "s")
        if not text and stop_time is not None and not stop_time >= start_time:
            text = outside("stop time", stop_time, start_time, LONGEST, "s")
        if text:
            self._refuse(text)
            return
        self.time = start_time
        self.stop = math.inf if stop_time is None else stop_time

    def enter_initialization_mode(self) -> None:
        if self._allowed("fmi2EnterInitializationMode", INSTANTIATED):
            self.mode = INITIALIZING

    def exit_initialization_mode(self) -> None:
        if not self._allowed("fmi2ExitInitializationMode", INITIALIZING):
            return
        text = self._begin()
        if text:
            self._refuse(text)
        else:
            self.mode = STEPPING

    def terminate(self) -> None:
        if self._allowed("fmi2Terminate", STEPPING):
            self.mode = TERMINATED

    def _begin(self) -> str:
        """Compute the start where it has to be; a message where that cannot be."""
        text = self.damper.begin() if self.stale else ""
        self.stale = bool(text)
        return text

    # Steps

    def do_step(self, current_time: float, step_size: float) -> bool:
        text = self._step(current_time, step_size)
        if text:
            self._say(text)
        return not text

    def _step(self, time: float, h: float) -> str:  # noqa: PLR0911 - a return for each way to refuse a step
        """Make a step; a message, and the state as before, where it is refused."""
        if self.mode != STEPPING:
            text = messages.NOT_NOW % ("fmi2DoStep", messages.MODES[self.mode])
            return f"{text}: {self.refusal}" if self.refusal else text
        if self.refusal:
            text, self.refusal = self.refusal, ""
            return f"time {time:g} s: the step is refused because of what went before it: {text}"
        if not (-LONGEST <= time <= LONGEST and 0.0 <= h <= LONGEST):
            return outside("communication point", time, -LONGEST, LONGEST, "s") or outside(
                "communication step", h, 0.0, LONGEST, "s"
            )
        slack = time_slack(time, h)
        if self.time is not None and abs(time - self.time) > slack:
            return messages.MISTIMED % (time, self.time)
        if time + h > self.stop + slack:
            return messages.BEYOND_STOP % (h, time, self.stop)
        text = self.damper.move(time, h)
        if text:
            return text
        self.time = time + h
        for remark in self.damper.remarks:
            self._say(remark, Fmi2Status.warning)
        return ""

    # FMU state

    def _get_fmu_state(self) -> dict[str, Any]:
        return {
            "identity": self.identity,
            "mode": self.mode,
            "time": self.time,
            "stop": None if math.isinf(self.stop) else self.stop,
            "stale": self.stale,
            "refusal": self.refusal,
            "damper": self.damper.kept(),
        }

    def _set_fmu_state(self, state: Any) -> None:
        """Restore a state; one that is not of this FMU changes nothing."""
        if not isinstance(state, dict) or "identity" not in state:
            self._refuse(messages.NO_STATE % "fmi2SetFMUstate")
        elif state["identity"] != self.identity:
            self._refuse(messages.OTHER_STATE % "fmi2SetFMUstate")
        else:
            try:
                self._restore(state)
            except StateError:
                self._refuse(messages.DAMAGED_STATE % "fmi2SetFMUstate")

    def _restore(self, state: dict[str, Any]) -> None:
        """Take a state over; raises StateError, with nothing changed, unless every field is right."""
        if set(state) != set(self._get_fmu_state()):
            raise StateError("fields")
        mode, time, stop, stale, refusal = (state[key] for key in ("mode", "time", "stop", "stale", "refusal"))
        if type(mode) is not int or not 0 <= mode <= TERMINATED or type(stale) is not bool or not isinstance(refusal, str):
            raise StateError("mode")
        for value in (time, stop):
            if value is not None and (type(value) not in (int, float) or not abs(value) <= 2.0 * LONGEST):
                raise StateError("time")
        if stale and mode >= STEPPING:
            raise StateError("mode")
        self.damper = Instance.restored(state["damper"], begun=not stale)
        self.mode, self.time, self.stop = mode, time, math.inf if stop is None else stop
        self.stale, self.refusal = stale, refusal

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> dict[str, Any]:
        """What is not JSON becomes a state that `_set_fmu_state` refuses: an exception would be Fatal."""
        try:
            content = json.loads(state.decode("utf-8"))
        except (ValueError, RecursionError):
            return {}
        return content if isinstance(content, dict) else {}
