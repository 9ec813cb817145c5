"""One record on its way from the motion of the rig to the channels, with hidden steps at one of three stages.

    setup    before the march: parameters, oil level, acts upon the volumes, the mount
    forces   after it: the parts of the force over the fine steps
    sensors  the channels

A step changes the run in place.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.engine.simulate import at_rest
from worlds.bench.plan import Channels, Motion, Record
from worlds.bench.sampler import Recorder, channels
from worlds.bench.valves import curve, since_reversal
from worlds.model.march import Act, Mount, march

Constants = Mapping[str, Any]


@dataclass(kw_only=True)
class Run(Channels):
    """A record being made; arrays (n,) over the fine steps."""

    damper: Damper  # its true parameters and state
    acts: list[Act] = field(default_factory=list)
    mount: Mount | None = None
    parts: dict[str, Array] = field(default_factory=dict)  # of the march

    @property
    def intact_fluid(self) -> Array:
        """Fluid force [N] of full chambers at the damper's velocity."""
        return curve(self.damper, self.parts["velocity"])

    @property
    def since_reversal(self) -> Array:
        """Stroke (n,) [m] of the damper since its last change of direction."""
        return since_reversal(self.parts["stroke"], self.parts["velocity"])

    def times(self, part: str, factor: Array | float) -> None:
        """Multiply a part of the force."""
        self.parts[part] = self.parts[part] * factor

    def plus(self, part: str, force: Array | float) -> None:
        """Add to a part of the force [N]."""
        self.parts[part] = self.parts[part] + force


@dataclass(frozen=True)
class Step:
    """Something hidden."""

    stage: str
    act: Callable[[Run], None]


def begun(record: Record, motion: Motion, damper: Damper) -> Run:
    """The run of a damper in the record's state, nothing hidden."""
    own = damper.with_(oil_level=record.level, gas_preload=int(record.preload))
    return Run(record=record, motion=motion, damper=own)


def finished(run: Run, steps: Sequence[Step] = ()) -> Run:
    """The run through all stages, from a run that is not marched, or is and has no step of `setup`."""
    for step in steps:
        if step.stage == "setup":
            step.act(run)
    if not run.parts:
        m = run.motion
        run.parts = march(run.damper, m.time, m.stroke, m.velocity, run.acts, mount=run.mount)
        run.stroke = m.stroke
    for step in steps:
        if step.stage == "forces":
            step.act(run)
    run.force = run.parts["fluid"] + run.parts["friction"] + run.parts["gas"]
    for step in steps:
        if step.stage == "sensors":
            step.act(run)
    return run


def copied(run: Run) -> Run:
    """A run that can be changed without changing this one."""
    return replace(run, parts=dict(run.parts))


def sampled(run: Run, recorder: Recorder, rng: np.random.Generator | None = None) -> list[Array]:
    """Times (m,) from 0, stroke, force and velocity, and the temperature where there is one; without `rng` no jitter."""
    kind = recorder.kind
    signals = [(run.stroke, kind if recorder.both else "point", None), (run.force, kind, run.force_time),
               (run.motion.velocity, "point", None)]  # fmt: skip
    if run.temperature is not None:
        signals.append((run.temperature, "point", None))
    return channels(run.time, run.start, signals, recorder, rng)


def derived_of(damper: Damper) -> Any:
    """What follows from the parameters, as the kernel prepares it."""
    return at_rest(damper, 0.0)[1]
