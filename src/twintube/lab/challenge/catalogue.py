"""All hidden causes with their formulations: strength range, drawn constants, needs, and the values a diagnosis may give."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from twintube.lab.challenge import fluid, mechanics, oil, sensors
from twintube.lab.challenge.plan import Bench
from twintube.lab.challenge.run import Apply, Constants

Draw = Callable[[np.random.Generator, Bench], dict[str, Any]]
Truth = Callable[[float, Constants], dict[str, float]]


@dataclass(frozen=True)
class Formulation:
    """One way in which a cause shows."""

    name: str
    stage: str  # setup, forces or sensors
    apply: Apply
    lowest: float  # strength, in the unit of `apply`
    highest: float
    draw: Draw = lambda rng, bench: {}
    truth: Truth = lambda x, c: {}
    needs: frozenset[str] = frozenset()  # of the bench: degraded, fast, foam, rest, sine, single_speed


@dataclass(frozen=True)
class Cause:
    """A hidden cause; `kind` is none, effect, fault, recalibrate or outside."""

    kind: str
    formulations: tuple[Formulation, ...]
    label: str = ""  # the contract's name where it is not the key


def signed(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """A sign."""
    return {"sign": float(rng.choice([-1.0, 1.0]))}


def drawn(function: Callable[[np.random.Generator], dict[str, Any]]) -> Draw:
    """A draw that needs no bench but its largest stroke."""
    return lambda rng, bench: {**function(rng), "reach": bench.reach}


def files(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """Some of the files, at most half, and a sign."""
    count = int(rng.integers(1, max(2, len(bench.records) // 3)))
    chosen = [int(i) for i in rng.choice(len(bench.records), count, replace=False)]
    return {**signed(rng, bench), "files": chosen, "from": len(bench.records) // 2, "file": chosen[0]}


def odd(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """One file, and another damper."""
    others = [f"SA{i}" for i in range(1, 9) if f"SA{i}" != bench.damper.name]
    return {**files(rng, bench), "damper": str(rng.choice(others))}


def units(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """A wrong unit of force or stroke."""
    force, stroke = [(1 / 4.44822, 1.0), (1 / 9.80665, 1.0), (0.1, 1.0), (1.0, 1 / 25.4), (1e-3, 1.0)][int(rng.integers(5))]
    return {**files(rng, bench), "force": force, "stroke": stroke}


def gas_draw(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """States of the bench for the gas."""
    return mechanics.gas_constants(rng, bench.states)


def pressure_draw(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """More or less pressure in the intact state."""
    return {"where": "intact", "sign": float(rng.choice([-1.0, 1.0])), "n": rng.uniform(1.0, 1.3)}


def state_draw(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """One of the degraded states, and a sign."""
    return {**signed(rng, bench), "state": float(rng.choice([r.level for r in bench.records if not r.preload]))}


def set_draw(function: Callable[[np.random.Generator, Any], dict[str, Any]]) -> Draw:
    """Other degradation parameters."""
    return lambda rng, bench: function(rng, bench.damper.parameters)


def rig_draw(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """What the outside troubles need."""
    return {
        "hertz": rng.uniform(40, 150), "zeta": rng.uniform(0.02, 0.1), "mains": float(rng.choice([50.0, 60.0])),
        "to_zero": bool(rng.random() < 0.5), "seed": int(rng.integers(1 << 30)), "largest": bench.largest,
    }  # fmt: skip


def strength_as(name: str, *, signed_: bool = True) -> Truth:
    """The strength itself is the value, with its sign."""
    return lambda x, c: {name: x * (c["sign"] if signed_ else 1.0)}


def gain_of(name: str) -> Truth:
    """One plus the strength."""
    return lambda x, c: {name: 1.0 + c["sign"] * x}


def worn(x: float, c: Constants) -> dict[str, float]:
    """Relative change of both branches."""
    return {"wear_re": c["sign"] * x * c["re"], "wear_co": c["sign"] * x * c["co"]}


def foam_rate(x: float, c: Constants) -> dict[str, float]:
    """The rate, where the law is of first order."""
    return {"foam_decay_rate": x} if c["power"] == 1.0 else {}


def seconds_draw(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """Sampling, settling time, sign."""
    return {**signed(rng, bench), "fs": bench.fs, "settling": rng.uniform(5, 30)}


def carried_draw(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """Whether the leak goes on between the records."""
    return {"carried": bool(rng.random() < 0.5)}


def power_draw(rng: np.random.Generator, bench: Bench) -> dict[str, Any]:
    """The power of the foam's law."""
    return {"power": float(rng.choice([1.0, 1.0, 1.5]))}


HEAT, LAG, WEAR = drawn(fluid.heat_constants), drawn(fluid.lag_constants), drawn(fluid.wear_constants)
RUB, STOP, BUSH = drawn(mechanics.friction_constants), drawn(mechanics.stop_constants), drawn(mechanics.mount_constants)
DEGRADED, FOAMING = frozenset({"degraded"}), frozenset({"degraded", "foam", "rest"})
CAVITATING, SINE = frozenset({"degraded", "fast", "cavitation", "rest"}), frozenset({"sine"})
INTACT = frozenset({"intact"})
F = Formulation


def effect(*formulations: Formulation, label: str = "") -> Cause:
    """A cause in the damper."""
    return Cause("effect", formulations, label)


def fault(*formulations: Formulation) -> Cause:
    """A cause in the measurement."""
    return Cause("fault", formulations)


CAUSES: Mapping[str, Cause] = {
    "none": Cause("none", ()),
    "none_history": Cause("none", (), "none"),
    "oil_temperature": effect(
        F("walther", "forces", fluid.laminar_fade, 0.02, 6.0, HEAT),
        F("linear", "forces", fluid.linear_fade, 0.02, 6.0, HEAT),
    ),
    "heat_run": effect(
        F("endurance", "forces", fluid.heat_run, 0.05, 3.0, HEAT, needs=frozenset({"single_speed"})), label="oil_temperature"
    ),
    "mount_compliance": effect(
        F("kelvin_voigt", "setup", mechanics.kelvin_voigt, 2e-9, 2e-6, BUSH, strength_as("C_mount", signed_=False)),
        F("cubic", "setup", mechanics.cubic_mount, 2e-9, 3e-6, BUSH),
        F("filled_rubber", "setup", mechanics.filled_rubber, 2e-9, 2e-6, BUSH),
    ),
    "fluid_lag": effect(
        F("bulk_modulus", "forces", fluid.bulk_modulus, 1e-3, 30.0, LAG),
        F("first_order", "forces", fluid.first_order_lag, 5e-5, 2e-2, LAG),
        F("late_valves", "forces", fluid.late_valves, 2e-5, 5e-3, LAG),
    ),
    "smooth_transition": effect(
        F("sigmoid", "forces", fluid.sigmoid, 1e-5, 1e-2, LAG, needs=DEGRADED),
        F("mixing_length", "forces", fluid.mixing_length, 1e-6, 2e-2, LAG, needs=DEGRADED),
    ),
    "foam_decay": effect(
        F("half_life", "setup", oil.foam_half_life, 1e-4, 5.0, power_draw, foam_rate, FOAMING),
        F("drainage", "setup", oil.foam_drainage, 1e-4, 5.0, power_draw, needs=FOAMING),
    ),
    "gas_redissolution": effect(
        F(
            "first_order",
            "setup",
            oil.dissolving,
            1e-3,
            3.0,
            signed,
            strength_as("redissolution_rate", signed_=False),
            CAVITATING,
        ),
        F("henry", "setup", oil.dissolving_under_pressure, 1e-3, 3.0, needs=CAVITATING),
    ),
    "gas_spring": effect(
        F("linear", "forces", mechanics.linear_gas, 1.0, 400.0, gas_draw, strength_as("F_residual")),
        F("polytropic", "forces", mechanics.polytropic_gas, 1.0, 400.0, gas_draw, strength_as("F_residual")),
    ),
    "gas_pressure": effect(
        F("intact", "forces", mechanics.polytropic_gas, 1.0, 400.0, pressure_draw, strength_as("F_residual"), INTACT),
        label="gas_spring",
    ),
    "seal_leak": effect(
        F("film", "setup", oil.film_leak, 1e-9, 1e-4, carried_draw, needs=DEGRADED),
        F("orifice", "setup", oil.orifice_leak, 1e-11, 2e-5, carried_draw),
    ),
    "end_stop": effect(
        F("linear", "forces", mechanics.linear_stop, 30.0, 1e6, STOP),
        F("progressive", "forces", mechanics.progressive_stop, 30.0, 1e6, STOP),
        F("single", "forces", mechanics.single_stop, 30.0, 1e6, STOP),
    ),
    "side_load_friction": effect(
        F("coulomb", "forces", mechanics.coulomb, 0.5, 600.0, RUB, strength_as("side_load_N", signed_=False)),
        F("lugre", "forces", mechanics.lugre, 0.5, 600.0, RUB, strength_as("side_load_N", signed_=False)),
        F("bent_rod", "forces", mechanics.growing_friction, 0.5, 600.0, RUB),
    ),
    "valve_wear": effect(
        F("uniform", "forces", fluid.uniform_wear, 0.002, 0.6, WEAR, worn),
        F("bleed", "forces", fluid.bleed_wear, 5e-4, 0.5, WEAR),
        F("blow_off", "forces", fluid.lost_preload, 0.002, 0.9, WEAR),
    ),
    "oil_level_error": effect(
        F("all_states", "setup", oil.level_everywhere, 1e-4, 0.15, signed, strength_as("level_error"), DEGRADED),
        F("single_state", "setup", oil.level_once, 1e-4, 0.15, state_draw, needs=DEGRADED),
    ),
    "recalibrate": Cause(
        "recalibrate",
        (
            F("drawn", "setup", oil.recalibrated, 0.01, 1.0, set_draw(oil.drawn_parameters), needs=DEGRADED),
            F("borrowed", "setup", oil.recalibrated, 0.01, 1.0, set_draw(oil.borrowed_parameters), needs=DEGRADED),
        ),
    ),
    "force_offset": fault(
        F("all", "sensors", sensors.offset, 0.2, 500.0, files, strength_as("force_offset")),
        F("from_a_record_on", "sensors", sensors.offset_later, 0.2, 500.0, files),
    ),
    "force_gain": fault(
        F("straight", "sensors", sensors.gain, 0.002, 0.3, signed, gain_of("force_gain")),
        F("bent", "sensors", sensors.bent_gain, 0.002, 0.3, signed),
    ),
    "sign_flip": fault(
        F("force", "sensors", sensors.flip_force, 1.0, 1.0),
        F("some_files", "sensors", sensors.flip_some, 1.0, 1.0, files),
        F("stroke", "sensors", sensors.flip_stroke, 1.0, 1.0),
    ),
    "channel_delay": fault(
        F("force_late", "sensors", sensors.force_late, 2e-5, 3e-2, signed, lambda x, c: {"channel_delay": x}),
        F("stroke_late", "sensors", sensors.stroke_late, 2e-5, 3e-2, signed, lambda x, c: {"channel_delay": -x}),
    ),
    "unit_error": fault(
        F("all", "sensors", sensors.wrong_unit, 1.0, 1.0, units),
        F("some_files", "sensors", sensors.wrong_unit_some, 1.0, 1.0, units),
    ),
    "stroke_gain": fault(
        F("span", "sensors", sensors.stroke_gain, 0.03, 0.08, signed, gain_of("stroke_gain")),
        F(
            "string",
            "sensors",
            sensors.string_pot,
            0.03,
            0.08,
            lambda rng, bench: {**signed(rng, bench), "reach": bench.reach},
        ),
    ),
    "zero_drift": fault(
        F("reset", "sensors", sensors.drift, 0.01, 50.0, seconds_draw, strength_as("zero_drift")),
        F("carried_on", "sensors", sensors.drift_on, 0.002, 20.0, seconds_draw, strength_as("zero_drift")),
        F("warming", "sensors", sensors.warming_cell, 0.01, 100.0, seconds_draw),
    ),
    "clock_error": fault(
        F("constant", "sensors", sensors.force_clock, 1e-3, 5e-3, seconds_draw, strength_as("clock_error")),
        F("lost_samples", "sensors", sensors.lost_samples, 1e-3, 5e-3, seconds_draw),
    ),
    "odd_record": fault(
        F("setting", "sensors", sensors.odd_setting, 0.1, 0.6, odd),
        F("state", "sensors", sensors.odd_state, 0.1, 0.4, odd),
        F("damper", "sensors", sensors.odd_damper, 1.0, 1.0, odd),
    ),
    **{
        name: Cause("outside", (F("outside", "sensors", apply, low, high, rig_draw),))
        for name, apply, low, high in (
            ("clipping", sensors.clipping, 0.1, 0.85),
            ("backlash", sensors.backlash, 2e-5, 3e-3),
            ("rig_resonance", sensors.resonance, 0.02, 1.0),
            ("mains_hum", sensors.hum, 0.5, 500.0),
            ("coarse_quantisation", sensors.coarse, 2.0, 1000.0),
            ("dropouts", sensors.dropouts, 0.001, 0.1),
        )
    },
}
PAIRS = (
    ("oil_temperature", "side_load_friction"), ("valve_wear", "side_load_friction"), ("gas_spring", "valve_wear"),
    ("mount_compliance", "side_load_friction"), ("fluid_lag", "oil_temperature"), ("oil_level_error", "side_load_friction"),
    ("foam_decay", "side_load_friction"), ("end_stop", "valve_wear"),
)  # fmt: skip


def label_of(name: str) -> str:
    """The contract's name of a cause."""
    return CAUSES[name].label or name
