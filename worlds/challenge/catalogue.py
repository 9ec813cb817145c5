"""All hidden causes with their formulations: strength range, drawn constants, needs, and the values a diagnosis may give."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from worlds.bench import faults
from worlds.bench.plan import RNG, chance, sign
from worlds.challenge import fluid, mechanics, oil, sensors
from worlds.challenge.plan import Bench
from worlds.model.run import Constants, Run

Apply = Callable[[Run, float, Constants], None]
Draw = Callable[[RNG, Bench], dict[str, Any]]
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
    needs: frozenset[str] = frozenset()  # of the bench: degraded, intact, fast, cavitation, foam, rest, single_speed


@dataclass(frozen=True)
class Cause:
    """A hidden cause; `kind` is none, effect, fault or outside."""

    kind: str
    formulations: tuple[Formulation, ...]
    label: str = ""  # the contract's name where it is not the key


def signed(rng: RNG, bench: Bench) -> dict[str, Any]:
    """A sign, and the rate of the recorder."""
    return {"sign": sign(rng), "fs": bench.recorder.fs}


def drawn(function: Callable[[RNG], dict[str, Any]]) -> Draw:
    """A draw that needs no bench but its largest stroke."""
    return lambda rng, bench: {**function(rng), "reach": bench.reach}


def files(rng: RNG, bench: Bench) -> dict[str, Any]:
    """Some of the files, at most half, and a sign."""
    count = int(rng.integers(1, max(2, len(bench.records) // 3)))
    chosen = [int(i) for i in rng.choice(len(bench.records), count, replace=False)]
    return {**signed(rng, bench), "files": chosen, "from": len(bench.records) // 2, "file": chosen[0]}


def odd(rng: RNG, bench: Bench) -> dict[str, Any]:
    """One file, and another damper."""
    others = [f"SA{i}" for i in range(1, 9) if f"SA{i}" != bench.damper.name]
    return {**files(rng, bench), "damper": str(rng.choice(others))}


def units(rng: RNG, bench: Bench) -> dict[str, Any]:
    """A wrong unit of force or stroke."""
    unit = [(1 / 4.44822, 1.0), (1 / 9.80665, 1.0), (0.1, 1.0), (1.0, 1 / 25.4), (1e-3, 1.0)][int(rng.integers(5))]
    return {**files(rng, bench), "unit": unit}


def state(rng: RNG, bench: Bench) -> dict[str, Any]:
    """One of the degraded states, and a sign."""
    return {**signed(rng, bench), "state": float(rng.choice([r.level for r in bench.records if not r.preload]))}


def gas(rng: RNG, bench: Bench) -> dict[str, Any]:
    """In which states the gas is other than recorded, with which sign."""
    return mechanics.gas_constants(rng, bench.states)


def intact_gas(rng: RNG, bench: Bench) -> dict[str, Any]:
    """More or less pressure in the intact state."""
    return {"where": "intact", "sign": sign(rng), "n": rng.uniform(1.0, 1.3)}


def rig(rng: RNG, bench: Bench) -> dict[str, Any]:
    """What the outside troubles need."""
    return {
        "hertz": rng.uniform(40, 150), "zeta": rng.uniform(0.02, 0.1), "mains": float(rng.choice([50.0, 60.0])),
        "to_zero": chance(rng, 0.5), "seed": int(rng.integers(1 << 30)), "largest": bench.largest,
    }  # fmt: skip


def settling(rng: RNG, bench: Bench) -> dict[str, Any]:
    """Sign and settling time."""
    return {**signed(rng, bench), "settling": rng.uniform(5, 30)}


def some(apply: Apply) -> Apply:
    """In some files only."""
    return lambda run, x, c: apply(run, x, c) if run.record.number in c["files"] else None


def wrong_unit(run: Run, x: float, c: Constants) -> None:
    """A unit by name, another by number."""
    run.unit = c["unit"]


def later(run: Run, x: float, c: Constants) -> None:
    """The cell was set to zero anew in the middle of the campaign: wrong by `x` [N] from a record on."""
    if run.record.number >= c["from"]:
        faults.scaled(run, zero=c["sign"] * x)


def lost(run: Run, x: float, c: Constants) -> None:
    """The force channel holds its value or falls to zero six times, for the share `x` of the time in all."""
    starts = np.random.default_rng([c["seed"], run.record.number]).uniform(0, 1, 6)
    length = x * (run.time[-1] - run.start) / 6.0
    faults.dropouts(run, starts, np.full(6, length), to_zero=c["to_zero"])


def value(name: str, *, sign_: bool = True, more: float = 0.0) -> Truth:
    """The strength itself is the value, with its sign, added to `more`."""
    return lambda x, c: {name: more + x * (c["sign"] if sign_ else 1.0)}


def carried(rng: RNG, bench: Bench) -> dict[str, Any]:
    """Whether the leak goes on between the records."""
    return {"carried": chance(rng, 0.5)}


def power(rng: RNG, bench: Bench) -> dict[str, Any]:
    """The power of the foam's law."""
    return {"power": float(rng.choice([1.0, 1.0, 1.5]))}


HEAT, LAG, WEAR = drawn(fluid.heat_constants), drawn(fluid.lag_constants), drawn(fluid.wear_constants)
RUB, STOP, BUSH = drawn(mechanics.friction_constants), drawn(mechanics.stop_constants), drawn(mechanics.mount_constants)
FLIPPED: Apply = lambda run, x, c: faults.scaled(run, -1.0)  # noqa: E731 - as those of the table, which names it twice
DEGRADED, FOAMING = frozenset({"degraded"}), frozenset({"degraded", "foam", "rest"})
CAVITATING, SINGLE = frozenset({"degraded", "fast", "cavitation", "rest"}), frozenset({"single_speed"})
F = Formulation


def effect(*formulations: Formulation, label: str = "") -> Cause:
    """A cause in the damper."""
    return Cause("effect", formulations, label)


def fault(*formulations: tuple[Any, ...]) -> Cause:
    """A cause in the measurement."""
    return Cause("fault", tuple(F(name, "sensors", *rest) for name, *rest in formulations))


CAUSES: Mapping[str, Cause] = {
    "none": Cause("none", ()),
    "none_history": Cause("none", (), "none"),
    "oil_temperature": effect(
        F("walther", "forces", fluid.laminar_fade, 0.02, 6.0, HEAT),
        F("linear", "forces", fluid.linear_fade, 0.02, 6.0, HEAT),
    ),
    "heat_run": effect(
        F("endurance", "forces", fluid.heat_run, 0.05, 3.0, HEAT, needs=SINGLE), label="oil_temperature"
    ),
    "mount_compliance": effect(
        F("kelvin_voigt", "setup", mechanics.kelvin_voigt, 2e-9, 2e-6, BUSH, value("C_mount", sign_=False)),
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
        F("half_life", "setup", oil.foam_half_life, 1e-4, 5.0, power,
          lambda x, c: {"foam_decay_rate": x} if c["power"] == 1.0 else {}, FOAMING),
        F("drainage", "setup", oil.foam_drainage, 1e-4, 5.0, needs=FOAMING),
    ),
    "gas_redissolution": effect(
        F("first_order", "setup", oil.dissolving, 1e-3, 3.0, signed, value("redissolution_rate", sign_=False), CAVITATING),
        F("henry", "setup", partial(oil.dissolving, henry=True), 1e-3, 3.0, needs=CAVITATING),
    ),
    "gas_spring": effect(
        F("linear", "forces", mechanics.linear_gas, 1.0, 400.0, gas, value("F_residual")),
        F("polytropic", "forces", mechanics.polytropic_gas, 1.0, 400.0, gas, value("F_residual")),
    ),
    "gas_pressure": effect(
        F("intact", "forces", mechanics.polytropic_gas, 1.0, 400.0, intact_gas, value("F_residual"), frozenset({"intact"})),
        label="gas_spring",
    ),
    "seal_leak": effect(
        F("film", "setup", oil.film_leak, 1e-9, 1e-4, carried, needs=DEGRADED),
        F("orifice", "setup", oil.orifice_leak, 1e-11, 2e-5, carried),
    ),
    "end_stop": effect(
        F("linear", "forces", mechanics.linear_stop, 30.0, 1e6, STOP),
        F("progressive", "forces", mechanics.progressive_stop, 30.0, 1e6, STOP),
        F("single", "forces", mechanics.single_stop, 30.0, 1e6, STOP),
    ),
    "side_load_friction": effect(
        F("coulomb", "forces", mechanics.coulomb, 0.5, 600.0, RUB, value("side_load_N", sign_=False)),
        F("lugre", "forces", mechanics.lugre, 0.5, 600.0, RUB, value("side_load_N", sign_=False)),
        F("bent_rod", "forces", mechanics.growing_friction, 0.5, 600.0, RUB),
    ),
    "valve_wear": effect(
        F("uniform", "forces", fluid.uniform_wear, 0.002, 0.6, WEAR,
          lambda x, c: {"wear_re": c["sign"] * x * c["re"], "wear_co": c["sign"] * x * c["co"]}),
        F("bleed", "forces", fluid.bleed_wear, 5e-4, 0.5, WEAR),
        F("blow_off", "forces", fluid.lost_preload, 0.002, 0.9, WEAR),
    ),
    "oil_level_error": effect(
        F("all_states", "setup", oil.level_wrong, 1e-4, 0.15, signed, value("level_error"), DEGRADED),
        F("single_state", "setup", oil.level_wrong, 1e-4, 0.15, state, needs=DEGRADED),
    ),
    "recalibrate": effect(
        F("drawn", "setup", oil.recalibrated, 0.01, 1.0, drawn(oil.drawn_parameters), needs=DEGRADED),
        F("borrowed", "setup", oil.recalibrated, 0.01, 1.0, drawn(oil.borrowed_parameters), needs=DEGRADED),
    ),
    "force_offset": fault(
        ("all", lambda run, x, c: faults.scaled(run, zero=c["sign"] * x), 0.2, 500.0, files, value("force_offset")),
        ("from_a_record_on", later, 0.2, 500.0, files),
    ),
    "force_gain": fault(
        ("straight", lambda run, x, c: faults.scaled(run, 1.0 + c["sign"] * x), 0.002, 0.3, signed,
         value("force_gain", more=1.0)),
        ("bent", lambda run, x, c: faults.bent_gain(run, c["sign"] * x), 0.002, 0.3, signed),
    ),
    "sign_flip": fault(
        ("force", FLIPPED, 1.0, 1.0), ("some_files", some(FLIPPED), 1.0, 1.0, files),
        ("stroke", lambda run, x, c: faults.scaled(run, stroke=-1.0), 1.0, 1.0),
    ),
    "channel_delay": fault(
        ("force_late", lambda run, x, c: faults.late(run, force=x), 2e-5, 3e-2, signed, lambda x, c: {"channel_delay": x}),
        ("stroke_late", lambda run, x, c: faults.late(run, stroke=x), 2e-5, 3e-2, signed,
         lambda x, c: {"channel_delay": -x}),
    ),
    "unit_error": fault(("all", wrong_unit, 1.0, 1.0, units), ("some_files", some(wrong_unit), 1.0, 1.0, units)),
    "stroke_gain": fault(
        ("span", lambda run, x, c: faults.scaled(run, stroke=1 + c["sign"] * x), 0.03, 0.08, signed,
         value("stroke_gain", more=1)),
        ("string", lambda run, x, c: faults.string_pot(run, c["sign"] * x, 0.1 * x / c["reach"]), 0.03, 0.08,
         lambda rng, bench: {**signed(rng, bench), "reach": bench.reach}),
    ),
    "zero_drift": fault(
        ("reset", lambda run, x, c: faults.drift(run, c["sign"] * x), 0.01, 50.0, signed, value("zero_drift")),
        ("carried_on", lambda run, x, c: faults.drift(run, c["sign"] * x, carried=True), 0.002, 20.0, signed,
         value("zero_drift")),
        ("warming", lambda run, x, c: faults.drift(run, c["sign"] * x, settling=c["settling"]), 0.01, 100.0, settling),
    ),
    "clock_error": fault(
        ("constant", lambda run, x, c: faults.fast_clock(run, c["sign"] * x), 1e-3, 5e-3, signed, value("clock_error")),
        ("lost_samples", lambda run, x, c: faults.lost_samples(run, x, c["fs"]), 1e-3, 5e-3, signed),
    ),
    "odd_record": fault(
        ("setting", sensors.odd_setting, 0.1, 0.6, odd), ("state", sensors.odd_state, 0.1, 0.4, odd),
        ("damper", sensors.odd_damper, 1.0, 1.0, odd),
    ),
    **{
        name: Cause("outside", (F("outside", "sensors", apply, low, high, rig),))
        for name, apply, low, high in (
            ("clipping", lambda run, x, c: faults.clipped(run, (1.0 - x) * c["largest"]), 0.1, 0.85),
            ("backlash", lambda run, x, c: faults.backlash(run, x), 2e-5, 3e-3),
            ("rig_resonance", lambda run, x, c: faults.resonance(run, c["hertz"], c["zeta"], x), 0.02, 1.0),
            ("mains_hum", lambda run, x, c: faults.hum(run, x, c["mains"]), 0.5, 500.0),
            ("coarse_quantisation", lambda run, x, c: faults.coarse(run, x), 2.0, 1000.0),
            ("dropouts", lost, 0.001, 0.1),
        )
    },
}  # fmt: skip
PAIRS = (
    ("oil_temperature", "side_load_friction"), ("valve_wear", "side_load_friction"), ("gas_spring", "valve_wear"),
    ("mount_compliance", "side_load_friction"), ("fluid_lag", "oil_temperature"), ("oil_level_error", "side_load_friction"),
    ("foam_decay", "side_load_friction"), ("end_stop", "valve_wear"),
)  # fmt: skip
