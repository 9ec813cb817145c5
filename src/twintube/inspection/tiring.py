"""A plate that watches whether the damper tires: its velocity at a constant shake, first against later cycles.

A weak curve, a stiff tyre or a worn bushing answers every cycle alike. A damper that lost oil frees gas in every stroke that
is faster than `v_cav`, and has less force in the next one. So the answer grows within the run.

The same holds for heat, in every damper, but less of it (LIMIT), and it stays over a rest of REST seconds, in which gas
dissolves again.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from twintube.common.arrays import Array, freeze_arrays
from twintube.dampers import Damper
from twintube.dampers.variants import self_heating
from twintube.engine.simulate import work_between
from twintube.inspection.plate import Plate, motion
from twintube.vehicle.drive import drive
from twintube.vehicle.quarter_car import Car
from twintube.vehicle.ride import FAILED

FREQUENCY: Final = 12.0  # [Hz] wheels of cars resonate at 11 to 13 Hz: the damper is fastest there for a given amplitude
# [m] in turn, until one tires the damper: of a fast one all is lost before the first cycle is read, a slow one is not felt.
# At 12 Hz 10 mm accelerate the plate by 57 m/s2; EUSAMA's 3 mm at 25 Hz do by 74 m/s2.
AMPLITUDES: Final = (6e-3, 8e-3, 10e-3)
RUN_UP: Final = 3.0 * FREQUENCY / 25.0  # [s] at the acceleration of the EUSAMA plate
COAST: Final = 15.0 * FREQUENCY / 25.0  # [s] at its deceleration
# [s] of shaking: the middle half-life of freed gas is 8 s, so that an equilibrium is nearly reached; more would only heat.
HOLD: Final = 20.0
SETTLING: Final = (
    2  # cycles, after which the intact SA8's wheel, damping ratio 0.31, keeps exp(-2 pi 0.31 2) = 2 % of a swing
)
CYCLES: Final = (
    6  # half a second: less is unsteady where the wheel hops, after more the SA8 with 80 % oil has lost its force
)
HIGHEST: Final = 1.05  # [m/s] v_cav of Table 9, for a tester that does not know the damper
ENOUGH: Final = HIGHEST / math.sqrt(0.75)  # [m/s] of the first cycles: half of a sine's stroke is faster than HIGHEST
REST: Final = 30.0  # [s]: freed gas has a half-life of 6 to 10 s, the heat of a damper one of minutes
RETURNED: Final = 0.5  # of the growth: what has a half-life shorter than the rest has returned by more, heat by less
# Of the growth. The heat of the run alone lets the answer of an intact damper grow up to 1.25-fold (SA7): the six that
# cavitate, 30 draws of the scatter, all plates, 700 J/K, a force that fades by 0.3 to 0.6 %/K (`python -m benchmarks
# tiring_heat`). Above that it is not such heat, and every intact damper passes.
LIMIT: Final = 1.27
COLLAPSED: Final = (
    "not judged: collapsed before it is read, it does less than half of the work of the intact damper in the same motion "
    "from the first half second on; see the other benches, or a smaller plate"
)


def shaker(amplitudes: Iterable[float] = AMPLITUDES) -> tuple[Plate, ...]:
    """Plates of these amplitudes [m]; raises InputError for one that no tester has."""
    return tuple(Plate(amplitude, FREQUENCY, RUN_UP, HOLD, COAST) for amplitude in amplitudes)


PLATES: Final = shaker()


@dataclass(frozen=True)
class Shake:
    """A plate run up to its frequency and held there: heights [m] and rates [m/s] (n,), and where the cycles begin."""

    plate: Plate
    dt: float  # [s]
    heights: Array
    rates: Array
    begins: NDArray[np.intp]  # (m,) samples at which the groups of CYCLES begin, and the end of the last one

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)


@dataclass(frozen=True)
class Tired:
    """What a run says."""

    plate: Plate
    time: Array  # (m,) [s] from the start, middle of each group of CYCLES
    answer: Array  # (m,) [m/s] root mean square of the damper's velocity in each group
    force: Array  # (m,) [N] root mean square of the plate's force about its mean, which a tester measures already
    peak: float  # [m/s] largest velocity of the first group
    contact_lost: float  # share of the time at the frequency in which the wheel is off the plate
    work: float  # [J] that heats the damper

    def __post_init__(self) -> None:
        """Shared by all who read it."""
        freeze_arrays(self)

    @property
    def growth(self) -> float:
        """Largest answer over the first one."""
        return float(self.answer.max() / self.answer[0])

    @property
    def force_growth(self) -> float:
        """The same of the plate's force."""
        return float(self.force.max() / self.force[0])


@lru_cache(maxsize=16)
def shake(plate: Plate, dt: float) -> Shake:
    """The plate's motion up to the end of its hold."""
    whole = motion(plate, dt)
    n = whole.coasting.start
    first = int(np.searchsorted(whole.time, plate.run_up))
    turns = np.arange(math.ceil(whole.angle[first] / (2 * np.pi)) + SETTLING, whole.angle[n - 1] / (2 * np.pi), CYCLES)
    begins = np.searchsorted(whole.angle[:n], 2 * np.pi * turns)
    return Shake(plate, dt, np.array(whole.heights[:n]), np.array(whole.rates[:n]), begins)


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def groups(run: Shake, values: Array) -> Array:
    """Root mean square (m,) of values (n,) in each group of cycles."""
    pairs = zip(run.begins[:-1], run.begins[1:], strict=True)
    return np.array([rms(values[i:j]) for i, j in pairs])


def heated(damper: Damper, fade: float) -> Damper:
    """The damper whose fluid force fades by `fade` [1/K] with the heat of its work, all of which stays in it."""
    return damper.with_(**self_heating(fade)) if fade > 0.0 else damper


def tired(run: Shake, begin: int, velocity: Array, load: Array, work: float) -> Tired:
    """What the run says that begins at sample `begin` of a velocity and a wheel load (n,)."""
    first, second, last = (begin + run.begins[i] for i in (0, 1, -1))
    return Tired(
        plate=run.plate,
        time=0.5 * (run.begins[:-1] + run.begins[1:]) * run.dt,
        answer=groups(run, velocity[begin:]),
        force=groups(run, load[begin:] - load[first:last].mean()),
        peak=float(np.abs(velocity[first:second]).max()),
        contact_lost=float(np.mean(load[first:last] <= 0.0)),
        work=work,
    )


def run_on(
    damper: Damper, car: Car, plate: Plate, dt: float, measured: Callable[[Array], Array] = lambda velocity: velocity
) -> Tired:
    """A run with a rested damper; raises InputError if the piston leaves the tube."""
    run = shake(plate, dt)
    result = drive(damper, car, run.heights, dt, rates=run.rates, preconditioned=True)
    return tired(run, 0, measured(result.velocity), result.wheel_load, float(result.work[-1]))


def runs(
    damper: Damper,
    car: Car,
    plates: Iterable[Plate],
    dt: float,
    *,
    fade: float = 0.0,
    measured: Callable[[Array], Array] = lambda velocity: velocity,
) -> list[Tired]:
    """The runs on the plates in turn, each with a rested damper, up to one that tires it or shakes it ENOUGH.

    `fade` [1/K] is that of the fluid force by the heat of the run, `measured` makes a sensor's velocity (n,) [m/s] of the
    damper's. Raises InputError if the piston leaves the tube.
    """
    found, warming = [], heated(damper, fade)
    for plate in plates:
        found.append(run_on(warming, car, plate, dt, measured))
        if found[-1].growth > LIMIT or found[-1].peak >= ENOUGH:
            break
    return found


def twice(damper: Damper, car: Car, plate: Plate, dt: float, fade: float = 0.0) -> tuple[Tired, Tired]:
    """A run, the coast of the plate, a rest of REST seconds, and the run again."""
    run, whole = shake(plate, dt), motion(plate, dt)
    still = np.zeros(round(REST / dt))
    heights, rates = (
        np.concatenate([once, still, again]) for once, again in ((whole.heights, run.heights), (whole.rates, run.rates))
    )
    result = drive(heated(damper, fade), car, heights, dt, rates=rates, preconditioned=True)
    ends, begin = len(run.heights), len(heights) - len(run.heights)
    first = tired(run, 0, result.velocity[:ends], result.wheel_load, float(result.work[ends - 1]))
    return first, tired(run, begin, result.velocity, result.wheel_load, float(result.work[-1] - result.work[begin]))


def returned(first: Tired, again: Tired) -> float:
    """Share of the growth of the first run that is gone when the second one begins."""
    top = float(first.answer.max())
    return (top - float(again.answer[0])) / (top - float(first.answer[0]))


def force_left(damper: Damper, car: Car, plate: Plate, dt: float) -> float:
    """Work of a rested damper in the first group of cycles over the intact one's in the same motion [1].

    A weak curve does not lower it. Raises InputError if the piston leaves the tube.
    """
    run = shake(plate, dt)
    marks = run.begins[:2].astype(np.int64)
    heights, rates = (values[: marks[1] + 1] for values in (run.heights, run.rates))
    done = drive(damper, car, heights, dt, rates=rates, preconditioned=True)
    intact = damper.with_(oil_level=1.0, gas_preload=1)
    return float(np.diff(done.work[marks])[0] / work_between(intact, done.stroke, done.velocity, marks, done.time)[0])


def not_judged(damper: Damper, car: Car, found: Sequence[Tired], dt: float) -> str:
    """Why runs on a car say nothing of a damper; empty where they do. Raises InputError if the piston leaves the tube."""
    p = damper.parameters
    if max(p.Y_Re_cav, p.Y_Co_cav) <= 0.0:
        return "not judged: in this damper's parameter set cavitation frees no gas (Y = 0), so nothing can tire it"
    fast = [run for run in found if run.peak >= p.v_cav]
    if not fast:
        return (
            f"not judged: damper velocity {max(run.peak for run in found):.2f} m/s stays below {p.v_cav:g} m/s, where this "
            "damper cavitates; a larger amplitude is needed"
        )
    tires = any(run.growth > LIMIT for run in found)
    return "" if tires or any(force_left(damper, car, run.plate, dt) >= FAILED for run in fast) else COLLAPSED
