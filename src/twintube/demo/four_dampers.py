"""The four dampers of a car as FMUs: four instances, or one container FMU that holds them."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Protocol

import fmpy
import numpy as np

from twintube.dampers import Damper, elements
from twintube.demo.damper_fmu import INPUTS, DamperFmu
from twintube.fmu.instance import FmuError, Instance
from twintube.vehicle.drive import CONDITIONING_STEP, conditioning
from twintube.vehicle.full.car import WHEELS


class FourDampers(Protocol):
    """Dampers in the order of WHEELS that do their steps together."""

    def step(self, strokes: Sequence[float], velocities: Sequence[float], dt: float) -> Sequence[float]:
        """Forces (4,) [N] after a step of `dt` [s] from `strokes` (4,) [m] at `velocities` (4,) [m/s]."""

    def forces(self) -> Sequence[float]:
        """Forces (4,) [N] after the last step."""

    def works(self) -> Sequence[float]:
        """Dissipated work (4,) [J]."""


class SingleFmus:
    """Four instances of damper FMUs, which their owner frees; raises FmuError where one is not the damper it should be."""

    def __init__(self, fmus: Sequence[DamperFmu], dampers: Sequence[Damper]) -> None:
        self.fmus = fmus
        for wheel, fmu, damper in zip(WHEELS, fmus, dampers, strict=True):
            check_damper(wheel, fmu, damper)

    def step(self, strokes: Sequence[float], velocities: Sequence[float], dt: float) -> list[float]:
        """As FourDampers."""
        return [fmu.step(z, v, dt) for fmu, z, v in zip(self.fmus, strokes, velocities, strict=True)]

    def forces(self) -> list[float]:
        """As FourDampers."""
        return [fmu.outputs()["force"] for fmu in self.fmus]

    def works(self) -> list[float]:
        """As FourDampers."""
        return [fmu.outputs()["work"] for fmu in self.fmus]


class ContainerFmu(Instance):
    """The FMU that `twintube container` writes, initialised at stroke 0; a context manager. Raises FmuError."""

    def __init__(self, fmu: Path, **start_values: float) -> None:
        named = {name: [f"{wheel}.{name}" for wheel in WHEELS] for name in (*INPUTS, "force", "work")}
        super().__init__(fmu, start_values, [name for names in named.values() for name in names])
        self._inputs = self.buffer(*named["stroke"], *named["velocity"])
        self._forces, self._works = self.buffer(*named["force"]), self.buffer(*named["work"])
        self.own_step = float(fmpy.read_model_description(str(fmu)).defaultExperiment.stepSize)

    def step(self, strokes: Sequence[float], velocities: Sequence[float], dt: float) -> Sequence[float]:
        """As FourDampers, in steps of the container's own length, which `dt` must be a multiple of."""
        # Within a longer step the container would hold the strokes.
        for at in np.arange(max(round(dt / self.own_step), 1)) * self.own_step:
            self._inputs[2][:] = [*(z + at * v for z, v in zip(strokes, velocities, strict=True)), *velocities]
            self.advance(self._inputs, min(dt, self.own_step))
        return list(self.read(self._forces))

    def forces(self) -> Sequence[float]:
        """As FourDampers."""
        return list(self.read(self._forces))

    def works(self) -> Sequence[float]:
        """As FourDampers."""
        return list(self.read(self._works))


def check_damper(wheel: str, fmu: DamperFmu, damper: Damper) -> None:
    """Raise FmuError where the FMU has other parameters than the damper that the car reckons with."""
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
