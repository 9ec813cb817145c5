"""Hidden content of a trial: the numbers of each effect, drawn from a seed.

Strength 1 is typical. It scales the quantity to which the force is about proportional: the exponent of the viscosity, a
compliance, a rate, a force, a relative change.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from zlib import crc32

import numpy as np

from twintube.core.variables import Parameters
from twintube.rig.signals import AMPLITUDE
from worlds.bench.plan import chance
from worlds.blind_trials.excitation import VELOCITIES, harmonic

SMALLEST_STRENGTH = 1e-6  # [1] replaces strength 0 as a divisor
SMALL_OIL = 273e-6  # [m3] oil of a rear damper
UNITS = {"kN": (1e-3, 1.0), "lbf": (1 / 4.4482216, 1.0), "in": (1.0, 1 / 25.4)}


@dataclass
class Secret:
    """The hidden truth of a trial."""

    always: dict[str, float] = field(default_factory=dict)  # fields of `Hidden` in all records
    moving: dict[str, float] = field(default_factory=dict)  # the same, in all but the quasi-static record
    degraded: dict[str, float] = field(default_factory=dict)  # the same, in the degraded states
    parameters: dict[str, float] = field(default_factory=dict)  # changed parameters of the damper
    level_error: float = 0.0  # [1] true less recorded oil level in the degraded states
    measurement: dict[str, float] = field(default_factory=dict)  # numbers of the faults of the measurement
    truth: dict[str, float] = field(default_factory=dict)  # for reports


@dataclass(frozen=True)
class Dice:
    """Inputs of a draw: random numbers, strength, the damper's parameters."""

    rng: np.random.Generator
    strength: float
    p: Parameters

    def uniform(self, low: float, high: float) -> float:
        """A uniformly distributed number between the two."""
        return float(self.rng.uniform(low, high))

    def sign(self) -> float:
        """-1 or 1."""
        return float(self.rng.choice([-1.0, 1.0]))

    @property
    def force(self) -> float:
        """Rebound force of the intact damper at 1 m/s [N]."""
        return float(np.interp(1.0, self.p.v_re, self.p.F_re))


def oil_temperature(d: Dice, s: Secret) -> None:
    """Heat balance of the oil, thinner oil by Vogel's law."""
    # [J/K] less than that of a whole damper, so that the effect is visible
    capacity = d.uniform(120, 220) * (d.p.V_oil / SMALL_OIL)
    cooling = float(np.exp(d.uniform(np.log(30), np.log(300))))  # [s]
    s.always |= {"warming": 1 / capacity, "cooling": 1 / cooling, "thinning": 0.35 * d.strength}
    s.truth |= {"heat_capacity_J_K": capacity, "cooling_s": cooling}


def mount_compliance(d: Dice, s: Secret) -> None:
    """A progressive rubber mount and the rod's mass."""
    stiffness = d.uniform(6e5, 1.0e6) * (d.force / 1900) / max(d.strength, SMALLEST_STRENGTH)
    s.always |= {"mount": stiffness, "hardening": d.uniform(1e4, 5e4), "rubber": d.uniform(300, 800)}
    s.always |= {"mass": d.uniform(1.0, 3.0)}


def fluid_lag(d: Dice, s: Secret) -> None:
    """Compressible oil with some trapped air."""
    s.always |= {"give": d.strength / d.uniform(1.0e9, 1.5e9), "air": d.strength * d.uniform(0.002, 0.005)}


def smooth_transition(d: Dice, s: Secret) -> None:
    """Force that builds up over some oil depth at the valve."""
    s.always |= {"blend": d.strength * d.uniform(3.5e-3, 6e-3)}


def foam_decay(d: Dice, s: Secret) -> None:
    """Two classes of bubbles that drain."""
    s.always |= {"drain_fast": d.strength / d.uniform(1.5, 4.0), "drain_slow": d.strength / d.uniform(10.0, 30.0)}


def gas_redissolution(d: Dice, s: Secret) -> None:
    """Henry's law with the half-lives of oil."""
    half_life = d.uniform(6.1, 10.2)
    s.always |= {"dissolve": d.strength * float(np.log(2)) / half_life}
    s.truth |= {"half_life_s": half_life / max(d.strength, SMALLEST_STRENGTH)}


def oil_displacement(d: Dice, s: Secret) -> None:
    """Oil displaced by freed gas is still in the damper: a share of it stays in the reserve."""
    s.always |= {"give_way": min(d.strength * d.uniform(0.4, 0.7), 1.0)}


def gas_exhaustion(d: Dice, s: Secret) -> None:
    """The oil frees at most its dissolved gas: a tenth of its volume at 1 bar, more at the lower pressure of the gas."""
    solubility, pressure = d.uniform(0.093, 0.113), d.uniform(0.2, 0.5)  # [1] gas at 1 bar per oil, [bar]
    s.always |= {"scarce": d.strength * pressure / solubility}


def gas_spring(d: Dice, s: Secret) -> None:
    """Residual pressure although the preload is recorded as lost."""
    s.degraded |= {"residual": d.strength * d.uniform(1.0e5, 2.0e5), "polytropic": d.uniform(1.05, 1.35)}


def seal_leak(d: Dice, s: Secret) -> None:
    """A film on the rod, independent of the oil level; strength 1 loses 9 to 16 % of half the oil in the longest record."""
    lost = d.strength * d.uniform(0.09, 0.16) * 0.5 * d.p.V_oil
    longest = harmonic(min(VELOCITIES))
    times = np.linspace(0.0, longest.duration, 20000)
    film = float(np.trapezoid(np.sqrt(np.abs(longest.sampled(times)[1])), times))
    s.always |= {"leak": lost / film}
    s.truth |= {"lost_in_longest_record_m3": lost}


def end_stop(d: Dice, s: Secret) -> None:
    """A rubber stop on one side or both."""
    engaged = d.uniform(0.1, 0.3) * AMPLITUDE
    scale = engaged / d.uniform(1.5, 3.0)
    peak = d.strength * d.uniform(0.15, 0.35) * d.force
    sides = ((1.0, 0.0), (0.0, 1.0), (1.0, 1.0))[int(d.rng.integers(3))]
    base = peak / float(np.expm1(engaged / scale))
    s.always |= {"stop_at": AMPLITUDE - engaged, "stop_scale": scale, "stop_loss": d.uniform(0.1, 0.25)}
    s.always |= {"stop_out": sides[0] * base, "stop_in": sides[1] * base}
    s.truth |= {"peak_N": peak}


def side_load_friction(d: Dice, s: Secret) -> None:
    """Coulomb friction of a bent or side-loaded rod; the quasi-static record may be without the side load."""
    side = {"side": d.strength * d.uniform(0.03, 0.06) * d.force, "side_v": d.uniform(2e-3, 1e-2)}
    also = float(chance(d.rng, 0.3))
    if also:
        side["side_v"] = 1e-4  # acts at 1 mm/s too
        s.always |= side
    else:
        s.moving |= side
    s.truth |= {"in_quasi_static": also}


def position_friction(d: Dice, s: Secret) -> None:
    """A side force on the rod; the reactions of guide and piston depend on the stroke by the lever arms."""
    s.always |= {"lever": d.strength, "span": d.uniform(0.075, 0.1), "overhang": d.uniform(0.04, 0.07)}


def valve_wear(d: Dice, s: Secret) -> None:
    """Each branch changed by its own velocity-dependent factor."""
    for branch in ("re", "co"):
        change = d.sign() * d.strength * d.uniform(0.10, 0.18)
        s.always |= {f"wear_{branch}": change, f"wear_{branch}_slow": change * d.uniform(0.3, 1.2)}
    s.always["wear_v"] = d.uniform(0.15, 0.5)


def oil_level_error(d: Dice, s: Secret) -> None:
    """The degraded states hold less or more oil than recorded."""
    s.level_error = d.sign() * d.strength * d.uniform(0.055, 0.07)
    s.truth |= {"level_error": s.level_error}


def recalibrate(d: Dice, s: Secret) -> None:
    """The base model's own parameters differ."""
    for name in ("X_Re", "X_Co1", "X_Co2", "G_PV", "S_BV", "S_PV"):
        value, shift = getattr(d.p, name), d.sign() * d.strength * d.uniform(0.08, 0.2)
        s.parameters[name] = value + shift if 0.0 <= value + shift <= 1.0 else min(max(value - shift, 0.0), 1.0)
    for name, spread in (("B", 0.3), ("E", 0.4), ("Y_Co_cav", 0.5), ("Y_Re_cav", 0.5)):
        factor = float(np.exp(d.sign() * d.strength * spread * d.uniform(0.7, 1.3)))
        s.parameters[name] = min(getattr(d.p, name) * factor, 100.0 if name == "E" else 1.0)


def fault(name: str, low: float, high: float, signed: bool = True) -> Callable[[Dice, Secret], None]:
    """A fault of the measurement described by one number."""

    def draw(d: Dice, s: Secret) -> None:
        s.measurement[name] = (d.sign() if signed else 1.0) * d.strength * d.uniform(low, high)

    return draw


def channel_delay(d: Dice, s: Secret) -> None:
    """A delay of one channel."""
    late = d.strength * d.uniform(4e-3, 5.3e-3)
    s.measurement["force_late" if chance(d.rng, 0.5) else "stroke_late"] = late


def unit_error(d: Dice, s: Secret) -> None:
    """A unit other than that in the header."""
    name = str(d.rng.choice(sorted(UNITS)))
    s.measurement["force_factor"], s.measurement["stroke_factor"] = UNITS[name]


def sign_flip(d: Dice, s: Secret) -> None:
    """The force with the opposite sign."""
    s.measurement["force_factor"] = -1.0


def rig_resonance(d: Dice, s: Secret) -> None:
    """The rig's frame vibrates."""
    s.always |= {"mode": 2 * np.pi * d.uniform(25, 60), "mode_loss": d.uniform(0.02, 0.06)}
    s.always["mode_share"] = min(d.strength * d.uniform(0.5, 0.9), 1.0)


def backlash(d: Dice, s: Secret) -> None:
    """Play in the joint of the rod."""
    s.always["play"] = d.strength * d.uniform(0.4e-3, 0.65e-3)


Draw = Callable[[Dice, Secret], None]
IN_THE_DAMPER: tuple[Draw, ...] = (
    oil_temperature, mount_compliance, fluid_lag, smooth_transition, foam_decay, gas_redissolution, oil_displacement,
    gas_exhaustion, gas_spring, seal_leak, end_stop, side_load_friction, valve_wear, oil_level_error, position_friction,
)  # fmt: skip
EFFECTS = tuple(draw.__name__ for draw in IN_THE_DAMPER)
OTHERS: dict[str, Draw] = {
    "force_offset": fault("offset", 0.038, 0.042), "force_gain": fault("gain", 0.09, 0.13), "sign_flip": sign_flip,
    "channel_delay": channel_delay, "unit_error": unit_error,
}  # fmt: skip
STRANGE: dict[str, Draw] = {
    "rig_resonance": rig_resonance, "backlash": backlash, "mains_hum": fault("hum", 0.038, 0.042, signed=False),
    "clipping": fault("clip", 0.27, 0.33, signed=False),
}  # fmt: skip
FAULTS, OUTSIDE = tuple(OTHERS), tuple(STRANGE)
DRAWS: dict[str, Draw] = dict(zip(EFFECTS, IN_THE_DAMPER, strict=True)) | OTHERS | STRANGE
DRAWS |= {"recalibrate": recalibrate, "none": lambda d, s: None}
KINDS = tuple(DRAWS)


def secret(kind: str, seed: int, p: Parameters, strength: float | None) -> tuple[Secret, float]:
    """The hidden content of a `kind`, also "a+b", and the strength of the first; raises ValueError for an unknown kind."""
    hidden, strengths = Secret(), []
    for single_kind in kind.split("+"):
        if single_kind not in DRAWS:
            raise ValueError(f"unknown kind {single_kind!r}, must be one of {', '.join(KINDS)}, or two joined by +")
        rng = np.random.default_rng([seed, crc32(single_kind.encode())])
        drawn = float(rng.uniform(0.5, 1.5))
        strengths.append(drawn if strength is None else strength)
        DRAWS[single_kind](Dice(rng, strengths[-1], p), hidden)
        hidden.truth[f"strength_{single_kind}"] = strengths[-1]
    for numbers in (hidden.always, hidden.moving, hidden.degraded, hidden.parameters, hidden.measurement):
        hidden.truth |= numbers
    return hidden, strengths[0]
