"""What the effects share: the state of an extended step, and the force at the valves.

The paper's kernel does not know these; `model.py` fills them around `kernel.step`, the files in `effects/` read and change
them. The functions here are in the kernel's own subset.
"""

import math
from dataclasses import dataclass

from twintube.core.kernel.forces import fluid_force
from twintube.core.variables import Derived, Parameters, State, var

# Longest part of a step [s] for effects whose force has a memory of milliseconds, and the most parts of a step.
PART = 6e-4
MAX_PARTS = 4.0
# The piston may come this close [m] to the ends of its chambers.
CLEARANCE = 1e-6


@dataclass(slots=True)
class Frame(State):
    """The kernel's state, and what an extended step remembers beside it. `z` is the stroke of the piston."""

    z_rod: float = var("frame", "z", "m", "stroke at the end of the last step, mount included", default=0.0)
    goal_z: float = var("frame", "z", "m", "where this step carries the piston", default=0.0)
    goal_v0: float = var("frame", "z_dot", "m/s", "velocity of the piston at the start of the step", default=0.0)
    goal_v1: float = var("frame", "z_dot", "m/s", "velocity of the piston at the end of the step", default=0.0)
    k_flow: float = var("frame", "k_degr", "1", "k_degr of the phases alone", default=1.0)
    k_re: float = var("frame", "k_degr", "1", "latest k_degr in rebound, all effects", default=1.0)
    k_co: float = var("frame", "k_degr", "1", "latest k_degr in compression, all effects", default=1.0)
    impulse: float = var("frame", "", "N.s", "integral of the damper's force over the time since the start", default=0.0)
    F_valve: float = var("frame", "F_Fl", "N", "fluid force at the valves at the end of the step", default=0.0)
    F_mean: float = var("frame", "F_Fl", "N", "mean of the fluid force over the time of the step", default=0.0)
    k_mean: float = var("frame", "k_degr", "1", "mean of k_degr over the step, all effects", default=1.0)
    W_step: float = var("frame", "W", "J", "work dissipated in the step", default=0.0)
    duration: float = var("frame", "", "s", "duration of the step", default=0.0)
    elapsed: float = var("frame", "t", "s", "time since the start", default=0.0)


def stroke_limit(d: Derived) -> float:
    """Largest stroke [m] to each side that keeps the piston inside the tube."""
    return d.half_length - CLEARANCE


def valve_force(p: Parameters, u: float, k_re: float, k_co: float) -> float:
    """Fluid force [N] while the oil passes the valves as at the piston speed `u` [m/s]; it rises with `u`."""
    return fluid_force(p, u) * (k_re if u >= 0.0 else k_co)


def end_weight(q: float) -> float:
    """Weight [1] of the rate at the end of a step of `q` time constants: the linear decay is met exactly (0.5 at 0, 1 late).

    Exponentially fitted theta method: Liniger and Willoughby 1970, SIAM Journal on Numerical Analysis 7.
    """
    if q < 1e-3:
        return 0.5 + q / 12.0
    if q > 500.0:
        return 1.0
    return 1.0 / (1.0 - math.exp(-q)) - 1.0 / q


def parts_of(dt: float) -> int:
    """Number of parts for a step of `dt` [s]."""
    # The smaller one first: C has no integer for the number of parts of a very long step.
    return max(1, math.ceil(min(MAX_PARTS, dt / PART - 1e-6)))
