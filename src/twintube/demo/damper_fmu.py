"""Instances of FMUs of dampers, stepped through fmpy's library handle with preallocated buffers."""

import shutil
from collections.abc import Mapping, Sequence
from ctypes import Array, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path
from types import TracebackType
from typing import Self

import fmpy
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

from twintube.errors import UserError

STATUS = ("OK", "Warning", "Discard", "Error", "Fatal", "Pending")
INPUTS = ("stroke", "velocity")
OUTPUTS = ("force", "force_fluid", "force_friction", "force_gas", "work", "k_degr")
KEEPS_NO_STATE = c_int(1)  # noSetFMUStatePriorToCurrentPoint
VOLUMES = tuple(f"V{chamber}.{phase}" for chamber in (1, 2, 3) for phase in ("oil", "gas", "foam"))


class FmuError(UserError, RuntimeError):
    """The FMU refused a step; the message contains its log."""


Buffer = tuple[Array[c_uint], c_size_t, Array[c_double]]


class Instance:
    """An FMU initialised with the given start values; a context manager that frees it. Raises FmuError.

    fmpy's functions convert and log on every call (4 to 7 us); bare handles with prepared arguments need a quarter of it.
    """

    def __init__(self, fmu: Path, start_values: Mapping[str, float], needed: Sequence[str]) -> None:
        description = fmpy.read_model_description(str(fmu))
        self.variables = {v.name: v for v in description.modelVariables}
        lacking = [name for name in (*needed, *start_values) if name not in self.variables]
        if lacking or description.coSimulation is None:
            raise FmuError(
                f"{fmu}: {lacking[0] if lacking else 'co-simulation'} is missing, this is not the FMU it should be"
            )
        self.folder = fmpy.extract(str(fmu))
        self.messages: list[str] = []
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="damper",
        )
        callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(self._log)
        callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
        callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
        self.fmu.instantiate(callbacks=callbacks, loggingOn=True)
        try:
            for name, value in start_values.items():
                variable = self.variables[name]
                if variable.type == "Integer":
                    self.fmu.setInteger([variable.valueReference], [int(value)])
                else:
                    self.fmu.setReal([variable.valueReference], [value])
            self.fmu.setupExperiment(startTime=0.0)
            self.fmu.enterInitializationMode()
            self.fmu.exitInitializationMode()
        except FMICallException as error:
            self.fmu.freeInstance()
            shutil.rmtree(self.folder, ignore_errors=True)
            raise FmuError(f"{error}: " + "; ".join(self.messages[-3:])) from None
        self.now = c_double(0.0)
        self._component = c_void_p(self.fmu.component)
        # Indexing with [] returns a function without prototype: the arguments prepared below pass without a conversion.
        self._set, self._step, self._get = (self.fmu.dll[f"fmi2{name}"] for name in ("SetReal", "DoStep", "GetReal"))

    def buffer(self, *names: str) -> Buffer:
        """Value references, their number, and room for the values."""
        n = len(names)
        return (c_uint * n)(*(self.variables[name].valueReference for name in names)), c_size_t(n), (c_double * n)()

    def _log(self, _environment: object, _instance: object, status: int, _category: object, message: bytes) -> None:
        self.messages.append(f"{STATUS[status]}: {message.decode()}")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)

    def advance(self, inputs: Buffer, dt: float) -> None:
        """A step of `dt` [s] with these inputs; raises FmuError if refused."""
        status = self._set(self._component, *inputs)
        if status <= 1:
            status = self._step(self._component, self.now, c_double(dt), KEEPS_NO_STATE)
        if status > 1:
            raise FmuError(f"the step returned {STATUS[status]}: " + "; ".join(self.messages[-3:]))
        self.now.value += dt

    def read(self, variables: Buffer) -> Array[c_double]:
        """The values of these variables."""
        self._get(self._component, *variables)
        return variables[2]


class DamperFmu(Instance):
    """The FMU of a damper initialised at stroke 0 with the given start values; raises FmuError."""

    def __init__(self, fmu: Path, **start_values: float) -> None:
        super().__init__(fmu, start_values, (*INPUTS, *OUTPUTS, *VOLUMES))
        self._inputs, self._force = self.buffer(*INPUTS), self.buffer("force")
        self._outputs, self._volumes = self.buffer(*OUTPUTS), self.buffer(*VOLUMES)

    def step(self, stroke: float, velocity: float, dt: float) -> float:
        """Force [N] after the step of `dt` [s] from `stroke` [m] at `velocity` [m/s]; raises FmuError if refused."""
        values = self._inputs[2]
        values[0] = stroke
        values[1] = velocity
        self.advance(self._inputs, dt)
        return self.read(self._force)[0]

    def outputs(self) -> dict[str, float]:
        """Forces [N], dissipated work [J] and k_degr after the last step."""
        return dict(zip(OUTPUTS, self.read(self._outputs), strict=True))

    def volumes(self) -> list[float]:
        """The nine phase volumes [m3] in the order of VOLUMES."""
        return list(self.read(self._volumes))
