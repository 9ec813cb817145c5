"""An instance of the damper FMU, stepped through fmpy's library handle with preallocated buffers."""

import shutil
from ctypes import c_double, c_uint
from pathlib import Path
from types import TracebackType

import fmpy
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave

STATUS = ("OK", "Warning", "Discard", "Error", "Fatal", "Pending")
OUTPUTS = ("force", "force_fluid", "force_friction", "force_gas", "work", "k_degr")
VOLUMES = tuple(f"V{chamber}.{phase}" for chamber in (1, 2, 3) for phase in ("oil", "gas", "foam"))


class FmuError(RuntimeError):
    """The FMU refused a step; the message holds what it logged."""


class DamperFmu:
    """The FMU initialised at stroke 0 with the given start values; a context manager that frees it. Raises FmuError.

    fmpy's own calls convert and log on every call (4 to 7 us); the raw handles with buffers made once take half of it.
    """

    def __init__(self, fmu: Path, **start_values: float) -> None:
        self.folder = fmpy.extract(str(fmu))
        description = fmpy.read_model_description(str(fmu))
        self.messages: list[str] = []
        assert description.coSimulation is not None
        self.fmu = FMU2Slave(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="damper",
        )
        variables = {v.name: v for v in description.modelVariables}
        callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(self._log)
        callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
        callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
        self.fmu.instantiate(callbacks=callbacks, loggingOn=True)
        try:
            for name, value in start_values.items():
                variable = variables[name]
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
        self.time = 0.0
        self._component = self.fmu.component
        self._set, self._step, self._get = self.fmu.dll.fmi2SetReal, self.fmu.dll.fmi2DoStep, self.fmu.dll.fmi2GetReal
        self._in_refs = (c_uint * 2)(*(variables[name].valueReference for name in ("stroke", "velocity")))
        self._in = (c_double * 2)()
        self._out_refs = (c_uint * len(OUTPUTS))(*(variables[name].valueReference for name in OUTPUTS))
        self._out = (c_double * len(OUTPUTS))()
        self._volume_refs = (c_uint * len(VOLUMES))(*(variables[name].valueReference for name in VOLUMES))
        self._volumes = (c_double * len(VOLUMES))()

    def _log(self, _environment: object, _instance: object, status: int, _category: object, message: bytes) -> None:
        self.messages.append(f"{STATUS[status]}: {message.decode()}")

    def __enter__(self) -> "DamperFmu":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)

    def step(self, stroke: float, velocity: float, dt: float) -> float:
        """Force [N] after the step of `dt` [s] from `stroke` [m] at `velocity` [m/s]; raises FmuError if refused."""
        buffer = self._in
        buffer[0] = stroke
        buffer[1] = velocity
        status = self._set(self._component, self._in_refs, 2, buffer)
        if status <= 1:
            status = self._step(self._component, self.time, dt, 1)
        if status > 1:
            raise FmuError(f"the step returned {STATUS[status]}: " + "; ".join(self.messages[-3:]))
        self.time += dt
        self._get(self._component, self._out_refs, 1, self._out)
        return self._out[0]

    def outputs(self) -> dict[str, float]:
        """Forces [N], dissipated work [J] and k_degr after the last step."""
        self._get(self._component, self._out_refs, len(OUTPUTS), self._out)
        return dict(zip(OUTPUTS, self._out, strict=True))

    def volumes(self) -> list[float]:
        """The nine phase volumes [m3] in the order of VOLUMES."""
        self._get(self._component, self._volume_refs, len(VOLUMES), self._volumes)
        return list(self._volumes)
