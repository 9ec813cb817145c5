"""One record on its way from the motion of the rig to the channels, with a hidden cause at one of three stages.

    setup    before the march: parameters, oil level, changes of the state, the mount
    forces   after it: the parts of the force over the fine steps
    sensors  the channels

A formulation of a cause is a function of a run, a strength and its drawn constants; it changes the run in place.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

import numpy as np

from twintube.arrays import Array
from twintube.dampers import Damper
from twintube.engine.simulate import at_rest
from twintube.lab.challenge.excitation import Motion
from twintube.lab.challenge.march import Between, march

Constants = Mapping[str, Any]


@dataclass(frozen=True)
class Record:
    """What is said about a record: its place in the dataset, state and start."""

    name: str
    number: int
    level: float  # as recorded
    preload: bool
    speed: float  # [m/s]
    measurement: str
    temperature: float  # [degC] at the start
    began: float  # [s] since the start of the campaign


@dataclass
class Run:
    """A record being made; arrays (n,) over the fine steps."""

    record: Record
    motion: Motion
    damper: Damper
    between: Between = field(default_factory=Between)
    parts: dict[str, Array] = field(default_factory=dict)  # columns of the march
    stroke: Array = field(default_factory=lambda: np.empty(0))  # of the channel
    force: Array = field(default_factory=lambda: np.empty(0))
    temperature: Array | None = None  # [degC] of the outer tube
    force_time: Callable[[Array], Array] | None = None  # when the force of a sample was taken, over its time in the file
    stroke_time: Callable[[Array], Array] | None = None
    unit: tuple[float, float] = (1.0, 1.0)  # factors of force and stroke on the way to the file

    @property
    def time(self) -> Array:
        """Times [s] since the rig began to move."""
        return self.motion.time

    @property
    def start(self) -> float:
        """Time [s] of the first sample of the file."""
        return float(self.motion.time[self.motion.first])


Apply = Callable[[Run, float, Constants], None]


@dataclass(frozen=True)
class Step:
    """A formulation with its strength, ready to be applied."""

    stage: str
    apply: Apply
    strength: float
    constants: Constants


def begun(record: Record, motion: Motion, damper: Damper) -> Run:
    """The run of a damper in the record's state, nothing hidden."""
    return Run(record, motion, damper.with_(oil_level=record.level, gas_preload=int(record.preload)))


def marched(run: Run) -> Run:
    """The run with its march done."""
    m = run.motion
    run.parts = march(run.damper, m.time, m.stroke, m.velocity, run.between)
    run.stroke = m.stroke
    return run


def finished(run: Run, steps: list[Step]) -> Run:
    """The run through all stages, from a run that is not marched, or is and has no step of `setup`."""
    for step in steps:
        if step.stage == "setup":
            step.apply(run, step.strength, step.constants)
    if not run.parts:
        marched(run)
    for step in steps:
        if step.stage == "forces":
            step.apply(run, step.strength, step.constants)
    run.force = run.parts["fluid"] + run.parts["friction"] + run.parts["gas"]
    for step in steps:
        if step.stage == "sensors":
            step.apply(run, step.strength, step.constants)
    return run


def copied(run: Run) -> Run:
    """A run that can be changed without changing this one."""
    return replace(run, between=Between(**vars(run.between)), parts=dict(run.parts))


def derived_of(damper: Damper) -> Any:
    """What follows from the parameters, as the kernel prepares it."""
    return at_rest(damper, 0.0)[1]


def curve(damper: Damper, velocity: Array) -> Array:
    """The F-v curve's force [N] at velocities [m/s] (n,)."""
    p = damper.parameters
    v = np.abs(velocity)

    def branch(velocities: tuple[float, ...], forces: tuple[float, ...]) -> Array:
        return np.interp(v, (0.0, *velocities), (0.0, *forces))

    return np.where(velocity >= 0.0, branch(p.v_re, p.F_re), -branch(p.v_co, p.F_co))


@cache
def with_numba(function: Callable[..., Any]) -> Callable[..., Any]:
    """A function compiled at its first call."""
    import numba

    compiled_function: Callable[..., Any] = numba.njit(error_model="numpy", nogil=True)(function)
    return compiled_function
