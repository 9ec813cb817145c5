"""Instances of FMUs of FMI 2.0 and 3.0, stepped through fmpy's library handle with preallocated buffers."""

import contextlib
import shutil
from collections.abc import Mapping, Sequence
from ctypes import Array, byref, c_bool, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import fmpy
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from twintube.errors import UserError

STATUS = ("OK", "Warning", "Discard", "Error", "Fatal", "Pending")
WHOLE = ("Integer", "Int32")  # types of whole numbers in the two versions


class FmuError(UserError, RuntimeError):
    """The FMU refused a step; the message contains its log."""


# Value references, their number, room for the values; in FMI 3.0 the number of values too.
Buffer = tuple[Any, ...]


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
        self.new = description.fmiVersion.startswith("3")
        self.messages: list[str] = []
        self.folder = fmpy.extract(str(fmu))
        try:
            with contextlib.chdir(Path.cwd()):  # fmpy stays in the library's folder where it cannot load it
                self._open(description)
        except Exception as error:  # fmpy has no narrower one for a library that cannot be loaded or instantiated
            shutil.rmtree(self.folder, ignore_errors=True)
            raise FmuError(f"{fmu}: {'; '.join([*str(error).splitlines(), *self.messages[-3:]])}") from None
        try:
            for name, value in start_values.items():
                self._start(name, value)
            if not self.new:
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
        version, number = (3, "Float64") if self.new else (2, "Real")
        names = (f"fmi{version}{name}" for name in (f"Set{number}", "DoStep", f"Get{number}"))
        self._set, self._step, self._get = (self.fmu.dll[name] for name in names)
        # What follows the step: no state before it will be set; in FMI 3.0 where it says what became of it.
        self._event, self._ended, self._early, self._reached = c_bool(), c_bool(), c_bool(), c_double()
        said = tuple(byref(word) for word in (self._event, self._ended, self._early, self._reached))
        self._rest: tuple[Any, ...] = (c_bool(True), *said) if self.new else (c_int(1),)

    def _open(self, description: Any) -> None:
        """Load the library and instantiate it with a log."""
        named = {
            "guid": description.guid,
            "unzipDirectory": self.folder,
            "modelIdentifier": description.coSimulation.modelIdentifier,
            "instanceName": "damper",
        }
        if self.new:
            self.fmu = FMU3Slave(**named)
            self.fmu.instantiate(loggingOn=True, logMessage=lambda _environment, *said: self._log(_environment, None, *said))
            return
        self.fmu = FMU2Slave(**named)
        callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(self._log)
        callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
        callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.free)
        self.fmu.instantiate(callbacks=callbacks, loggingOn=True)

    def _start(self, name: str, value: float) -> None:
        """Set a start value by fmpy's own function of its type."""
        variable = self.variables[name]
        whole = variable.type in WHOLE
        getattr(self.fmu, f"set{variable.type}")([variable.valueReference], [int(value) if whole else value])

    def buffer(self, *names: str) -> Buffer:
        """Value references, their number, and room for the values, as the functions want them."""
        n = len(names)
        references: Array[c_uint] = (c_uint * n)(*(self.variables[name].valueReference for name in names))
        return (references, c_size_t(n), (c_double * n)(), *((c_size_t(n),) if self.new else ()))

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
            status = self._step(self._component, self.now, c_double(dt), *self._rest)
        if status > 1:
            raise FmuError(f"the step returned {STATUS[status]}: " + "; ".join(self.messages[-3:]))
        self.now.value += dt

    def read(self, variables: Buffer) -> Array[c_double]:
        """The values of these variables."""
        self._get(self._component, *variables)
        values: Array[c_double] = variables[2]
        return values
