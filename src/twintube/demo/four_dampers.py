"""The four dampers of a car as FMUs of FMI 2.0: four instances, or one container FMU that holds them.

The compiled loops call the FMUs' functions by address, without an object of Python in between.
"""

from collections.abc import Sequence
from ctypes import c_void_p, cast
from itertools import pairwise
from pathlib import Path
from types import TracebackType
from typing import Self

import fmpy
import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import Damper, elements
from twintube.demo.damper_fmu import INPUTS, DamperFmu
from twintube.engine import compiled
from twintube.fmu.instance import FmuError, Instance
from twintube.vehicle.drive import CONDITIONING_STEP, conditioning
from twintube.vehicle.full.car import WHEELS

FOUND = ("force", "work")
FUNCTIONS = ("fmi2SetReal", "fmi2DoStep", "fmi2GetReal")


class FourDampers:
    """Dampers in the order of WHEELS that do their steps together; `instances` have as many of them each."""

    def __init__(self, instances: Sequence[Instance], names: Sequence[str], own_step: float = np.inf) -> None:
        """`names`: what stands before a variable's name, of the dampers of an instance. `own_step` [s]: its longest step."""
        self.instances, self.own_step = instances, own_step
        shape = (len(instances), 2, len(names))
        self.moved, self.found, self.now = np.zeros(shape), np.zeros(shape), np.zeros(1)
        self.moves = np.zeros((2, len(WHEELS)))
        self._kept, calls = [], []
        for unit, moved, found in zip(instances, self.moved, self.found, strict=True):
            row = [cast(unit.fmu.dll[name], c_void_p).value for name in FUNCTIONS] + [unit.fmu.component]
            for variables, values in ((INPUTS, moved), (FOUND, found)):
                buffer = unit.buffer(*(f"{name}{variable}" for variable in variables for name in names))
                self._kept.append(buffer)  # its references stay where they are
                row += [cast(buffer[0], c_void_p).value, buffer[1].value, values.ctypes.data]
            calls.append(row)
            found[:] = np.reshape(unit.read(buffer), found.shape)
        self.calls = np.array(calls, np.int64)

    def parts(self, dt: float) -> int:
        """The number of parts that a step of `dt` [s] has: within a longer one the FMU would hold the strokes."""
        return max(round(dt / self.own_step), 1)

    def check(self, refused: int) -> None:
        """Raise FmuError with the log of the FMU that refused its step, as `step_units` says it."""
        if refused:
            raise FmuError("the step was refused: " + "; ".join(self.instances[refused - 1].messages[-3:]))

    def step(self, strokes: Sequence[float], velocities: Sequence[float], dt: float) -> Array:
        """Forces (4,) [N] after a step of `dt` [s] from `strokes` (4,) [m] at `velocities` (4,) [m/s]; raises FmuError."""
        parts = self.parts(dt)
        self.moves[:] = strokes, velocities
        self.check(compiled.module().step_units(self.calls, self.moved, self.found, self.now, self.moves, parts, dt / parts))
        return self.forces()

    def forces(self) -> Array:
        """Forces (4,) [N] after the last step."""
        return self.found[:, 0].flatten()

    def works(self) -> Array:
        """Dissipated work (4,) [J]."""
        return self.found[:, 1].flatten()


class SingleFmus(FourDampers):
    """Four instances of damper FMUs, which their owner frees; raises FmuError where one is not the damper it should be."""

    def __init__(self, fmus: Sequence[DamperFmu], dampers: Sequence[Damper]) -> None:
        for wheel, fmu, damper in zip(WHEELS, fmus, dampers, strict=True):
            check_damper(wheel, fmu, damper)
        super().__init__(fmus, [""])


class ContainerFmu(FourDampers):
    """The FMU that `twintube ssp --container` writes, initialised at stroke 0; a context manager. Raises FmuError."""

    def __init__(self, fmu: Path, **start_values: float) -> None:
        names = [f"{wheel}." for wheel in WHEELS]
        self.unit = Instance(fmu, start_values, [f"{name}{variable}" for variable in (*INPUTS, *FOUND) for name in names])
        super().__init__([self.unit], names, float(fmpy.read_model_description(str(fmu)).defaultExperiment.stepSize))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.unit.__exit__(kind, error, trace)


def check_damper(wheel: str, fmu: DamperFmu, damper: Damper) -> None:
    """Raise FmuError where the FMU has other parameters than the damper that the car reckons with."""
    if fmu.new:
        raise FmuError(f"{wheel}: the FMU is of FMI 3.0, must be of FMI 2.0")
    for name, item, _, value in elements(damper):
        reference = fmu.variables[name].valueReference
        (is_value,) = fmu.fmu.getInteger([reference]) if item.metadata["integer"] else fmu.fmu.getReal([reference])
        if is_value != value:
            raise FmuError(f"{wheel}: the FMU is not that of {damper.name}: its {name} is {is_value:g}, must be {value:g}")


def precondition_four(dampers: FourDampers) -> None:
    """The paper's six oscillations at 0.05 m/s of all four; they end at stroke 0."""
    for z, following in pairwise(conditioning().tolist()):
        velocity = (following - z) / CONDITIONING_STEP
        dampers.step([z] * len(WHEELS), [velocity] * len(WHEELS), CONDITIONING_STEP)
