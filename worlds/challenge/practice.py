"""Strengths as they occur in practice, and which seed of the workshop hides what; they do not go by the noise.

Sources: Reimpell (wear of 5 to 35 %, side forces of 0.3 to 1.5 kN), Dixon (valves, mounts), data sheets of load cells and
stroke sensors, and what workshops report of seals and fills.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Final

import numpy as np

from worlds.bench.plan import RNG, span
from worlds.challenge import fluid, mechanics, sensors
from worlds.challenge.catalogue import CAUSES, HEAT, Cause, F, Formulation, effect, fault, signed
from worlds.challenge.plan import Bench

Strength = tuple[float, float] | Callable[[RNG, Bench], float]  # a range, evenly over the logarithm, or a draw
NOTHING: Final = 14  # of each block of seeds
# What the challenge does not hide.
MORE: Final[Mapping[str, Cause]] = {
    "oil_temperature": effect(F("warm", "forces", fluid.warm, 1.0, 60.0, HEAT)),
    "time_base": fault(("header", sensors.stretched, 0.005, 0.1, signed)),
    "clamp_inertia": Cause("fault", (F("clamp", "forces", mechanics.inertia, 0.5, 10.0),)),
}


def preload(rng: RNG, bench: Bench, low: float, high: float) -> float:
    """A share of the gas force [N] at 5 bar."""
    return float(bench.damper.parameters.F_0 * rng.uniform(low, high))


def leaked(rng: RNG, bench: Bench, low: float, high: float) -> float:
    """A film [m3] per metre out: a share of the oil over a state's records, which do some twenty oscillations each."""
    way = (
        2.0
        * bench.reach
        * sum(order.count + order.turns for order in bench.orders)
        / len({record.level for record in bench.records})
    )
    return float(bench.damper.parameters.V_oil * rng.uniform(low, high) / way)


def drift(rng: RNG, bench: Bench) -> float:
    """20 to 90 N over the whole run, in N/s."""
    return span(rng, 20.0, 90.0) / max(bench.records[-1].began, 30.0)


PRACTICE: Final[Mapping[str, Mapping[str, Strength]]] = {
    "oil_temperature": {"warm": (15.0, 60.0), "walther": (0.8, 1.25)},  # all records warmer; each heats itself
    "mount_compliance": {"kelvin_voigt": (8e-7, 4e-6), "cubic": (1.7e-6, 5e-6)},  # 250 to 1200 N/mm; soft in the middle
    "fluid_lag": {"bulk_modulus": (3.0, 15.0), "late_valves": (0.5e-3, 2e-3)},  # softer by air; the plates' gap
    "smooth_transition": {"sigmoid": (2e-3, 6e-3), "mixing_length": (3e-3, 12e-3)},
    "foam_decay": {"half_life": (0.17, 1.0), "drainage": (0.17, 1.0)},  # half-lives of 0.7 to 4 s
    "gas_redissolution": {"first_order": (0.07, 0.7), "henry": (0.046, 0.23)},  # of 1 to 10 s (8 s in the paper)
    "gas_pressure": {"intact": partial(preload, low=0.3, high=0.8)},  # 2 to 9 bar where 5 were meant
    "gas_spring": {"polytropic": partial(preload, low=0.1, high=0.5)},  # 0.5 to 2.5 bar
    "seal_leak": {"film": partial(leaked, low=0.03, high=0.12), "orifice": (1e-7, 1e-6)},  # a damaged seal; a cut lip
    "end_stop": {"linear": (6e4, 3e5), "progressive": (6e4, 3e5)},  # 0.6 to 3 kN after 10 mm
    "side_load_friction": {"coulomb": (30.0, 150.0), "bent_rod": (30.0, 130.0)},
    "valve_wear": {"uniform": (0.05, 0.35), "bleed": (0.02, 0.12), "blow_off": (0.1, 0.4)},
    "oil_level_error": {"all_states": (0.015, 0.06), "single_state": (0.025, 0.06)},  # what stayed in the tubes
    "recalibrate": {"drawn": (0.3, 1.0)},  # another sample of the damper
    "force_offset": {"all": (10.0, 80.0)},
    "force_gain": {"straight": (0.01, 0.08)},
    "sign_flip": {"force": (1.0, 1.0)},
    "channel_delay": {"force_late": lambda rng, bench: max(1e-3, float(rng.uniform(1.2, 6.0)) / bench.recorder.fs)},
    "unit_error": {"all": (1.0, 1.0)},
    "stroke_gain": {"span": (0.02, 0.08)},
    "zero_drift": {"carried_on": drift},
    "time_base": {"header": (0.02, 0.08)},
    "odd_record": {"setting": (0.3, 0.6), "damper": (1.0, 1.0)},
    "clamp_inertia": {"clamp": (2.0, 6.0)},  # [kg]
    "clipping": {"outside": lambda rng, bench: 1.0 - min(0.9, float(rng.uniform(300.0, 1000.0)) / bench.largest)},
    "backlash": {"outside": (3e-4, 1.5e-3)},
    "rig_resonance": {"outside": (0.5, 1.0)},
    "mains_hum": {"outside": (10.0, 60.0)},
    "dropouts": {"outside": (0.005, 0.05)},
}
PAIRS: Final = (
    (("oil_temperature", "warm"), ("side_load_friction", "coulomb")), (("end_stop", "progressive"), ("valve_wear", "bleed")),
    (("mount_compliance", "kelvin_voigt"), ("gas_pressure", "intact")),
    (("valve_wear", "uniform"), ("oil_level_error", "all_states")),
    (("fluid_lag", "bulk_modulus"), ("side_load_friction", "bent_rod")),
)  # fmt: skip
SINGLES: Final = tuple(((cause, name),) for cause, rows in PRACTICE.items() for name in rows)
CASES: Final[Sequence[Sequence[tuple[str, str]]]] = (*SINGLES, *PAIRS, *((),) * NOTHING)


def case_of(seed: int) -> Sequence[tuple[str, str]]:
    """Causes and their formulations of a seed from 1 on: each block of seeds hides every case once, in its own order."""
    block, place = divmod(seed - 1, len(CASES))
    return CASES[int(np.random.default_rng([20261129, block]).permutation(len(CASES))[place])]


def formulation(cause: str, name: str) -> Formulation:
    """A cause's formulation of that name."""
    several = [item for table in (CAUSES, MORE) if cause in table for item in table[cause].formulations]
    return next(item for item in several if item.name == name)


def strength(rng: RNG, bench: Bench, cause: str, name: str) -> float:
    """A strength of practice, within what the formulation can be."""
    drawn = PRACTICE[cause][name]
    return span(rng, *drawn) if isinstance(drawn, tuple) else drawn(rng, bench)
