"""The result of evaluating a claim, the bench settings, and the simulated runs that claims share."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.dampers.freed_gas import AS_PUBLISHED, DEFAULT, with_freed_gas
from twintube.engine.simulate import simulate, work_between
from twintube.engine.simulation import Simulation
from twintube.rig.plan import amplitude, at_oil_level
from twintube.rig.signals import START, Signal, harmonic_block

Dampers = dict[str, Damper]
FRONT = ("SA1", "SA3", "SA5", "SA7")
REAR = ("SA2", "SA4", "SA6", "SA8")
MODEL_ERROR = 0.10  # largest error of the model on the first oscillation (Section 3.4): smaller differences do not count
VISIBLE = 0.01  # line width of a diagram over the length of its axis: smaller differences are not visible
NUMERIC = 1e-3  # relative error of a block's work from its sampling
PAPER, READING, STAND_IN = "paper", "reading", "stand-in"
# Why a claim is no evidence: an assumed value alone decides; the code has it written in; nobody measured it.
ASSUMPTION, CONSTRUCTION, EXPECTATION = "by assumption", "by construction", "expectation"
FV_STANDIN = "F-v curves (assumed stand-ins)"
DEAD = "dead lengths (assumed, calibrated)"


@dataclass(frozen=True)
class Bench:
    """Settings that the paper does not state: of the test rig, and what freed gas does."""

    start: str = START  # one of rig.STARTS
    position: float = 0.0  # middle of all strokes [m]
    reach: float = 0.0  # amplitude of the blocks [m]; 0: the value of `plan.amplitude`
    freed_gas: str = ""  # of every run; empty: `stays` for blocks, the default for drives


BENCH = Bench()


@dataclass(frozen=True)
class Claim:
    """One statement of the paper and its evaluation with the model."""

    id: str
    quote: str  # the paper's own words
    statement: str
    source: str
    tested: str  # what is compared, with the limits and their sources
    holds: bool
    figures: dict[str, object]
    needs: str  # unpublished data that the check depends on, with the stand-in used
    because: str = ""  # cause of the failure: paper, reading or stand-in
    reason: str = ""  # why it does not hold, with the numerical experiment that shows it
    calibrated: tuple[str, ...] = ()  # the dampers whose dead length was chosen on this claim
    no_evidence: str = ""  # ASSUMPTION, CONSTRUCTION or EXPECTATION

    def __post_init__(self) -> None:
        object.__setattr__(self, "holds", bool(self.holds))  # numpy's bool cannot be written as JSON

    @property
    def kind(self) -> str:
        """`evidence`, or why it is none: `calibrated` or one of ASSUMPTION, CONSTRUCTION and EXPECTATION."""
        return "calibrated" if self.calibrated else self.no_evidence or "evidence"

    @property
    def evidence(self) -> bool:
        """True where the claim can tell something about the model."""
        return self.kind == "evidence"


class Keyed:
    """A damper with a hash of its parameters, so that runs that claims share are simulated once."""

    def __init__(self, damper: Damper) -> None:
        self.damper = damper
        self.key = repr(damper.parameters)

    def __hash__(self) -> int:
        return hash(self.key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Keyed) and self.key == other.key


def block(damper: Damper, velocity: float, bench: Bench = BENCH, samples: int = 400) -> Signal:
    """The harmonic block of a damper with the maximum `velocity` [m/s] and about `samples` samples per oscillation."""
    reach = bench.reach or amplitude(damper)
    dt = max(0.2 / samples, 2 * np.pi * reach / velocity / samples)
    return harmonic_block(velocity, reach, dt, start=bench.start, position=bench.position)


def condition(damper: Damper, oil_level: float, bench: Bench = BENCH, *, drive: bool = False) -> Damper:
    """The damper at an oil level with the bench's way of the freed gas; below 100 % the gas preload is lost."""
    return with_freed_gas(at_oil_level(damper, oil_level), bench.freed_gas or (DEFAULT if drive else AS_PUBLISHED))


@lru_cache(maxsize=20000)
def cached_works(damper: Keyed, velocity: float, bench: Bench) -> Array:
    """Works [J] of the 19 oscillations."""
    signal = block(damper.damper, velocity, bench)
    return work_between(damper.damper, signal.stroke, signal.velocity, signal.marks, signal.time)


def works(damper: Damper, oil_level: float, velocity: float, bench: Bench = BENCH) -> Array:
    """Works [J] of the 19 oscillations at the maximum `velocity` [m/s]; below 100 % oil the gas preload is lost."""
    return cached_works(Keyed(condition(damper, oil_level, bench)), velocity, bench)


def fluid_works(damper: Damper, oil_level: float, velocity: float, bench: Bench = BENCH) -> Array:
    """As `works`, without the friction, whose rise with the oil loss is assumed."""
    return works(damper.with_(F_FrS=0.0), oil_level, velocity, bench)


def relative(damper: Damper, oil_level: float, velocity: float, bench: Bench = BENCH) -> Array:
    """Works of the 19 oscillations relative to the first one of the intact damper [1]."""
    ratio: Array = works(damper, oil_level, velocity, bench) / works(damper, 1.0, velocity, bench)[0]
    return ratio


def fluid_relative(damper: Damper, oil_level: float, velocity: float, bench: Bench = BENCH) -> Array:
    """As `relative`, without friction."""
    return relative(damper.with_(F_FrS=0.0), oil_level, velocity, bench)


def friction_floor(damper: Damper, velocity: float, bench: Bench = BENCH) -> float:
    """Work of the damper without any oil, friction alone, relative to intact [1]."""
    return float(relative(damper, 0.0, velocity, bench)[-1])


def run(
    damper: Damper,
    oil_level: float,
    velocity: float,
    bench: Bench = BENCH,
    *,
    preload: float | None = None,
    samples: int = 400,
) -> tuple[Signal, Simulation]:
    """The block and its simulation; `preload` overrides the preload of the paper's states (for C12)."""
    state = condition(damper, oil_level, bench)
    if preload is not None:
        state = state.with_(gas_preload=preload)
    signal = block(damper, velocity, bench, samples)
    return signal, simulate(state, signal.stroke, signal.velocity, signal.time)


def rounded(value: float, digits: int = 3) -> float:
    """A number rounded for a report."""
    return float(np.round(value, digits))
