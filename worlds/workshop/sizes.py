"""Which cause has which strength in practice."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from twintube.dampers import load, names
from worlds.bench import faults
from worlds.bench.plan import RNG, chance, sign, span
from worlds.model.march import Mount
from worlds.model.run import Run, Step
from worlds.workshop import fluid, others
from worlds.workshop.plan import Day

MIDDLE = 0.5  # of the range of a share: towards it there is room

Values = dict[str, Any]


@dataclass(frozen=True)
class Sized:
    """A cause with its strengths in practice."""

    key: str
    name: str
    formulation: str
    practice: str  # how strong it is
    draw: Callable[[RNG, Day], Values]  # SI units, by the names of the acts
    acts: tuple[tuple[str, Callable[..., Any]], ...]  # by stage
    remembers: bool = False  # from record to record: the act is made anew for each campaign

    def steps(self, values: Values) -> list[Step]:
        """What acts in a campaign."""
        return [Step(stage, act(**values) if self.remembers else partial(act, **values)) for stage, act in self.acts]


def mounted(run: Run, stiffness: float, damping: float, cubic: float = 0.0) -> None:
    """A mount at the rod."""
    run.mount = Mount(stiffness, cubic, damping)


def stretched(run: Run, factor: float) -> None:
    """Another rate than the one in the header."""
    run.stretch *= factor


def ranged(run: Run, record: int, gain: float = 1.0, damper: str = "") -> None:
    """One record, counted from 1, with another range of the amplifier."""
    if run.record.number == record - 1:
        faults.scaled(run, gain)


def of_another(run: Run, record: int, gain: float = 1.0, damper: str = "") -> None:
    """One record, counted from 1, of another damper with the level that stands on the sheet."""
    if damper and run.record.number == record - 1:
        state = {"oil_level": run.record.level, "gas_preload": int(run.record.preload)}
        run.damper = load(damper, as_published=True).with_(**state)


def lost(run: Run, count: int, seed: int) -> None:
    """Samples lost on the way of a telemetry: the force is 0 for up to 30 ms, some times per record."""
    draw = np.random.default_rng((seed, run.record.number))
    faults.dropouts(run, draw.random(count), 0.03 * draw.uniform(0.3, 1.0, count), to_zero=True)


def uniform(draw: RNG, low: float, high: float) -> float:
    """Evenly between the two."""
    return float(draw.uniform(low, high))


def hot_or_cold(draw: RNG, day: Day) -> Values:
    """Mostly warmer than at identification."""
    return {"kelvin": uniform(draw, 15.0, 60.0) if chance(draw, 0.8) else -uniform(draw, 12.0, 22.0)}


def linear_mount(draw: RNG, day: Day) -> Values:
    """Loss factor 0.1 to 0.2 at 10 Hz."""
    k = span(draw, 2.5e5, 1.2e6)
    return {"stiffness": k, "damping": k * uniform(draw, 0.1, 0.2) / (2 * np.pi * 10)}


def hard_mount(draw: RNG, day: Day) -> Values:
    """Loss factor 0.15; twice as stiff where 3 k3 u^2 is k."""
    k, at = span(draw, 2e5, 6e5), uniform(draw, 1e-3, 2.5e-3)
    return {"stiffness": k, "damping": k * 0.15 / (2 * np.pi * 10), "cubic": k / (3 * at**2)}


def scaled_by(draw: RNG, day: Day) -> Values:
    """One direction or both."""
    size = span(draw, 0.05, 0.35)
    re, co = [(size, 0.0), (0.0, size), (size, size * uniform(draw, 0.5, 1.0))][int(draw.integers(3))]
    return {"rebound": re, "compression": co}


def bled_by(draw: RNG, day: Day) -> Values:
    """Rebound, and often compression."""
    re = span(draw, 0.02, 0.12)
    return {"rebound": re, "compression": 0.0 if chance(draw, 0.4) else re * uniform(draw, 0.5, 1.5)}


def other_laws(draw: RNG, day: Day) -> Values:
    """The flows of the degradation laws moved by 0.1 to 0.3."""
    old = {name: float(getattr(day.damper.parameters, name)) for name in ("X_Re", "X_Co1", "X_Co2", "G_PV")}
    sizes = {name: uniform(draw, 0.1, 0.3) for name in old}
    return {name: round(v + sizes[name] if v < MIDDLE else v - sizes[name], 3) for name, v in old.items()}


def drifting(draw: RNG, day: Day) -> Values:
    """Linear over the whole run."""
    record, motion = day.records[-1]
    return {"rate": sign(draw) * span(draw, 20.0, 90.0) / (record.began + float(motion.time[-1]))}


def odd_one(draw: RNG, day: Day) -> Values:
    """Not the first record."""
    only = 1 + int(draw.integers(1, len(day.records)))
    if chance(draw, 0.5):
        return {"record": only, "gain": 0.5}
    own = day.damper.name
    return {"record": only, "damper": str(draw.choice([x for x in names() if x != own and (int(x[2]) + int(own[2])) % 2]))}


def wear(draw: RNG, day: Day) -> Values:
    """The upper part of the range, in both directions."""
    b = span(draw, 0.06, 0.14)
    return {"rebound": b, "compression": b}


def case(  # noqa: PLR0917 - a row of the table
    name: str, key: str, formulation: str, practice: str, draw: Callable[[RNG, Day], Values], stage: str,
    act: Callable[..., Any], *more: tuple[str, Callable[..., Any]], remembers: bool = False,
) -> Sized:  # fmt: skip
    """A cause that acts at one stage, or at more."""
    return Sized(key, name, formulation, practice, draw, ((stage, act), *more), remembers)


SIZES = {item.key: item for item in (
    case("oil_temperature", "warm_oil", "Vogel viscosity, all records alike",
         "15 to 60 K warmer, or some 15 to 25 K colder (a hall in winter)", hot_or_cold, "forces", fluid.warmed),
    case("oil_temperature", "heating", "lumped heat balance along the run",
         "the oil and what it touches: its heat capacity and some steel, 1900 J/kgK and 870 kg/m3 (Dixon)",
         lambda r, d: {"capacity": d.damper.parameters.V_oil * 870 * 1900 * uniform(r, 1.2, 1.8),
                       "cooling": uniform(r, 90.0, 400.0)}, "forces", fluid.heating, remembers=True),
    case("mount_compliance", "linear_mount", "Kelvin-Voigt", "pin mount or eye bushing, 250 to 1200 N/mm", linear_mount,
         "setup", mounted),
    case("mount_compliance", "hard_mount", "progressive", "soft in the middle, twice as stiff after 1 to 2.5 mm", hard_mount,
         "setup", mounted),
    case("fluid_lag", "oil_column", "Maxwell element", "A^2 K / V with a bulk modulus lowered by air",
         lambda r, d: {"stiffness": span(r, 3e5, 1.5e6)}, "forces", fluid.oil_column),
    case("fluid_lag", "late_valves", "late check valves, linear over the stroke", "0.5 to 2 mm",
         lambda r, d: {"stroke": span(r, 0.5e-3, 2e-3)}, "forces", fluid.late_check_valves),
    case("smooth_transition", "mixing", "first order over the stroke", "3 to 12 mm",
         lambda r, d: {"length": span(r, 3e-3, 12e-3)}, "forces", fluid.mixing_length),
    case("smooth_transition", "tilted", "mean over a height, both sides", "6 to 20 mm",
         lambda r, d: {"height": span(r, 6e-3, 20e-3)}, "forces", fluid.tilted_surface),
    case("foam_decay", "foam_rate", "first order in time", "half-lives of 0.7 to 4 s",
         lambda r, d: {"rate": float(np.log(2) / span(r, 0.7, 4.0))}, "setup", others.foam_collapse),
    case("foam_decay", "foam_front", "constant rate", "5 to 25 mL/s: a front of 0.5 to 3 cm/s over the cross-section",
         lambda r, d: {"front": span(r, 5e-6, 25e-6)}, "setup", others.foam_collapse),
    case("gas_redissolution", "dissolving", "first order in time", "half-lives of 1 to 10 s (8 s in the paper)",
         lambda r, d: {"rate": float(np.log(2) / span(r, 1.0, 10.0))}, "setup", others.dissolving),
    case("gas_redissolution", "pressed", "rate grows with pressure", "slower at rest, faster under pressure",
         lambda r, d: {"rate": float(np.log(2) / span(r, 3.0, 15.0)), "twice_at": 500.0}, "setup", others.dissolving),
    case("gas_spring", "preload", "pressure of the intact damper", "2 to 9 bar where 5 were meant",
         lambda r, d: {"ratio": float(r.choice([r.uniform(2.0, 3.5), r.uniform(6.5, 9.0)])) / 5.0}, "setup",
         others.wrong_preload),
    case("gas_spring", "residual", "residual pressure, polytropic", "0.5 to 2.5 bar left",
         lambda r, d: {"pressure": uniform(r, 0.5e5, 2.5e5), "exponent": uniform(r, 1.1, 1.35)}, "forces",
         others.residual_pressure),
    case("seal_leak", "film", "film per stroke, each state filled afresh",
         "a damaged seal: 3 to 12 % over the longest state",
         lambda r, d: {"film": uniform(r, 0.03, 0.12) * d.damper.parameters.V_oil / d.longest_way}, "setup", others.leak,
         remembers=True),
    case("seal_leak", "orifice", "orifice, goes on through all states", "a cut lip: 3 to 10 % over the whole run, at 15 bar",
         lambda r, d: {"orifice": uniform(r, 0.03, 0.1) * d.damper.parameters.V_oil / d.seconds / float(np.sqrt(15.0))},
         "setup", others.leak, remembers=True),
    case("end_stop", "rubber_stop", "rubber, power law, rebound", "touched over the last 2 to 7 mm",
         lambda r, d: {"onset": d.widest - uniform(r, 2e-3, 7e-3), "at_10mm": span(r, 600.0, 3000.0),
                       "power": uniform(r, 1.3, 2.0)}, "forces", others.rubber_stop),
    case("end_stop", "foam_bump", "cellular stop, rational, compression", "soft polyurethane over the last 4 to 10 mm",
         lambda r, d: {"onset": d.widest - uniform(r, 4e-3, 10e-3), "stiffness": span(r, 1.5e4, 6e4)}, "forces",
         others.foam_bump),
    case("side_load_friction", "side_load", "Coulomb", "side force of 0.3 to 1.5 kN, friction coefficient near 0.1",
         lambda r, d: {"extra": span(r, 30.0, 150.0)}, "forces", others.side_load),
    case("side_load_friction", "bent_rod", "bent rod, growing with extension", "as above at the middle of the stroke",
         lambda r, d: {"extra": span(r, 30.0, 130.0), "overhang": uniform(r, 0.1, 0.5)}, "forces", others.bent_rod),
    case("valve_wear", "scale", "scaled", "5 to 35 %, in one or both directions", scaled_by, "forces", fluid.worn_scale),
    case("valve_wear", "bleed", "orifice beside the valves", "0.02 to 0.12 m/s at 1000 N", bled_by, "forces",
         fluid.worn_bleed),
    case("valve_wear", "worn_out", "orifice beside the valves", "0.06 to 0.14 m/s", wear, "forces", fluid.worn_bleed),
    case("oil_level_error", "all_levels", "all degraded states", "1.5 to 6 %: what stayed in the tubes, or a wrong scale",
         lambda r, d: {"shift": sign(r) * uniform(r, 0.015, 0.06)}, "setup", others.refilled),
    case("oil_level_error", "one_level", "one state", "2.5 to 6 % in the lowest state",
         lambda r, d: {"shift": sign(r) * uniform(r, 0.025, 0.06), "level": min(x.level for x, _ in d.records)}, "setup",
         others.refilled),
    case("recalibrate", "laws", "other flow shares", "another sample of the damper", other_laws, "setup", others.other_laws),
    case("force_offset", "offset", "zero of the load cell", "10 to 80 N",
         lambda r, d: {"zero": sign(r) * span(r, 10.0, 80.0)}, "sensors", faults.scaled),
    case("force_gain", "gain", "gain of the load cell", "1 to 8 %",
         lambda r, d: {"gain": 1.0 + sign(r) * span(r, 0.01, 0.08)}, "sensors", faults.scaled),
    case("sign_flip", "flip", "force negative in rebound", "the force channel's sign", lambda r, d: {"gain": -1.0},
         "sensors", faults.scaled),
    case("channel_delay", "delay", "force late", "1.2 to 6 samples, at least 1 ms",
         lambda r, d: {"force": max(1e-3, uniform(r, 1.2, 6.0) / d.recorder.fs)}, "sensors", faults.late),
    case("unit_error", "unit", "pounds or kilograms written as N", "lbf or kgf",
         lambda r, d: {"gain": [1 / 4.4482216, 1 / 9.80665][int(r.integers(2))]}, "sensors", faults.scaled),
    case("stroke_gain", "stroke", "gain of the stroke sensor", "2 to 8 %",
         lambda r, d: {"stroke": 1.0 + sign(r) * span(r, 0.02, 0.08)}, "sensors", faults.scaled),
    case("zero_drift", "drift", "linear over the run", "20 to 90 N over the run", drifting, "sensors",
         partial(faults.drift, carried=True)),
    case("time_base", "clock", "times scaled", "2 to 8 %", lambda r, d: {"factor": 1.0 + sign(r) * span(r, 0.02, 0.08)},
         "sensors", stretched),
    case("odd_record", "odd", "one record of another damper, or with another range", "half the range", odd_one, "setup",
         of_another, ("sensors", ranged)),
    case("clipping", "clipping", "load cell or amplifier at its limit", "300 to 1000 N",
         lambda r, d: {"limit": uniform(r, 300.0, 1000.0)}, "sensors", faults.clipped),
    case("backlash", "play", "play operator", "0.3 to 1.5 mm", lambda r, d: {"play": span(r, 3e-4, 1.5e-3)}, "setup",
         others.play, ("forces", others.floating)),
    case("rig_resonance", "resonance", "second order", "40 to 120 Hz, damping 0.02 to 0.06",
         lambda r, d: {"hertz": uniform(r, 40.0, 120.0), "zeta": uniform(r, 0.02, 0.06)}, "sensors", faults.resonance),
    case("mains_hum", "hum", "50 and 150 Hz", "10 to 60 N", lambda r, d: {"amplitude": span(r, 10.0, 60.0), "hertz": 50.0},
         "sensors", faults.hum),
    case("dropouts", "dropouts", "samples read as 0", "3 to 12 per record, up to 30 ms",
         lambda r, d: {"count": int(r.integers(3, 13)), "seed": int(r.integers(1 << 20))}, "sensors", lost),
    case("clamp_inertia", "inertia", "mass of clamp between load cell and damper", "2 to 6 kg",
         lambda r, d: {"mass": uniform(r, 2.0, 6.0)}, "forces", others.inertia),
)}  # fmt: skip
