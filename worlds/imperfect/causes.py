"""What may have changed between two days: one cause each, its strength drawn from practice.

A range begins where no bench sees the cause; `source` says where it ends, and why.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from worlds.bench.plan import RNG, chance, sign, span
from worlds.imperfect.law import Law

Fields = dict[str, Any]  # of State or Fault


@dataclass(frozen=True)
class Cause:
    """One way in which later records may differ."""

    key: str
    kind: str  # state | effect | fault | outside
    name: str  # as in truth.json
    weight: float
    source: str
    draw: Callable[[RNG, Law, float], Fields]  # the float is the largest amplitude [m] of the later records
    also: tuple[str, ...] = ()  # other names for the same in a reader's catalogue


def evenly(rng: RNG, low: float, high: float) -> float:
    """Evenly between the two."""
    return float(rng.uniform(low, high))


def either(rng: RNG, change: float) -> tuple[float, float]:
    """The change in rebound or in compression; in a quarter of the cases half of it on the other side, too."""
    other = 0.5 * change if chance(rng, 0.25) else 0.0
    return (change, other) if chance(rng, 0.5) else (other, change)


def stop_contact(rng: RNG, law: Law, amplitude: float) -> Fields:
    """From where the motion goes further, by a share of the amplitude."""
    contact = amplitude - min(span(rng, 0.2e-3, 8e-3), 0.6 * amplitude)
    return {"stop": (sign(rng) * contact, 1e3 * 1000**1.5 * span(rng, 0.01, 0.2))}


def leak(rng: RNG, law: Law, amplitude: float) -> Fields:
    """From full, or from what was lost before."""
    begin = 1.0 if chance(rng, 0.5) else float(rng.uniform(0.6, 1.0))
    return {"oil_level": begin, "oil_level_end": begin - span(rng, 0.02, 0.4), "gas_preload": int(chance(rng, 0.5))}


def aired(dead: float, remains: float) -> Fields:
    """Dead stroke [m] at the start of the session, and what remains of it at the end."""
    return {"dead_stroke": (dead, remains * dead)}


OUTSIDE: Final = 0.8  # weight of each; together a tenth of all changes

CAUSES: Final = {item.key: item for item in (
    Cause("oil_lost", "state", "state", 2.0,
        "seals weep for years before a damper is replaced; the paper's own specimens were at 30 to 90 %",
        lambda rng, law, a: {"oil_level": 1.0 - span(rng, 0.03, 0.65), "gas_preload": 1}),
    Cause("oil_and_gas_lost", "state", "state", 2.5,
        "the same, with the gas gone first, as where the rod seal is torn",
        lambda rng, law, a: {"oil_level": 1.0 - span(rng, 0.03, 0.65), "gas_preload": 0}),
    Cause("preload_lost", "state", "state", 1.5, "valve or seal: 5 bar on the rod's cross-section, all or nothing",
        lambda rng, law, a: {"gas_preload": 0}, ("gas_spring",)),
    Cause("gas_leaked", "effect", "gas_spring", 1.5, "gas diffuses through the seal, 5 to 10 % per year; 5 to 80 % less",
        lambda rng, law, a: {"gas_share": 1.0 - span(rng, 0.05, 0.8)}, ("state",)),
    Cause("hot_run", "effect", "oil_temperature", 2.5, "benches stop at 80 to 120 degC; 3 to 60 K within a run",
        lambda rng, law, a: {"heating": (0.0, span(rng, 3.0, 60.0))}),
    Cause("bleed_wear", "effect", "valve_wear", 1.5,
        "erosion or dirt on the discs: 3 to 50 % less at low velocity; clogged notches: up to 50 % more",
        lambda rng, law, a: {"bleed": either(rng, sign(rng) * span(rng, 0.03, 0.5))}),
    Cause("blow_off_wear", "effect", "valve_wear", 1.5, "set or broken discs: 3 to 40 % above the knee, rarely more force",
        lambda rng, law, a: {"blow_off": either(rng, (1 if chance(rng, 0.2) else -1) * span(rng, 0.03, 0.4))}),
    Cause("seal_friction", "outside", "outside:seal_friction", 1.5, "20 to 60 N when new; worn 40 % of it, dry 3 times",
        lambda rng, law, a: {"friction": span(rng, 0.4, 3.0)}, ("side_load_friction",)),
    Cause("side_load", "effect", "side_load_friction", 1.5,
        "struts: 100 to 1000 N across the guide, coefficient 0.03 to 0.1: 3 to 100 N",
        lambda rng, law, a: {"side_friction": span(rng, 3.0, 100.0)}),
    Cause("bush", "effect", "mount_compliance", 2.0, "top mounts 0.3 to 3 kN/mm, clevises in poor threads up to 10",
        lambda rng, law, a: {"bush": 1.0 / span(rng, 0.4e6, 1e7)}),
    Cause("leak", "effect", "seal_leak", 2.0, "a torn seal wets the rig within minutes: 2 to 40 % of the oil",
        leak, ("state",)),
    Cause("aeration", "effect", "fluid_lag", 1.5, "0.2 to 8 % of air in 100 mm of oil: 0.2 to 8 mm per reversal",
        lambda rng, law, a: aired(span(rng, 0.2e-3, 8e-3), 1.0), ("foam_decay",)),
    Cause("foam", "effect", "foam_decay", 1.5, "the same, from a fast run before, separating while the bench runs slower",
        lambda rng, law, a: aired(span(rng, 0.4e-3, 10e-3), evenly(rng, 0.05, 0.3)), ("fluid_lag",)),
    Cause("stop", "effect", "end_stop", 2.0, "wrong middle by 0.2 to 8 mm: rebound stop or buffer, 0.3 to 6 kN after 10 mm",
        stop_contact),
    Cause("gain", "fault", "force_gain", 2.0, "bridge supply, wrong range or shunt: 1.5 to 20 %; a calibration holds 1 %",
        lambda rng, law, a: {"gain": 1.0 + sign(rng) * span(rng, 0.015, 0.2)}),
    Cause("zero", "fault", "force_offset", 2.0, "not tared with the fixture on: 3 to 150 N",
        lambda rng, law, a: {"zero": sign(rng) * span(rng, 3.0, 150.0)}),
    Cause("delay", "fault", "channel_delay", 2.0, "filters or buses that differ between the channels: 0.3 to 10 ms",
        lambda rng, law, a: {"delay": span(rng, 0.3e-3, 10e-3)}),
    Cause("stroke", "fault", "stroke_gain", 2.0, "wrong lever or scale of the sensor: 0.5 to 15 %",
        lambda rng, law, a: {"stroke_gain": 1.0 + sign(rng) * span(rng, 0.005, 0.15)}),
    Cause("signs", "fault", "sign_flip", 0.5, "another program on the machine, which counts compression positive",
        lambda rng, law, a: {"sign": -1}),
    Cause("unit", "fault", "unit_error", 0.5, "lbf, kgf or daN in a column that says N",
        lambda rng, law, a: {"unit": float(rng.choice([4.448222, 9.80665, 10.0]))}),
    Cause("loose_nut", "outside", "outside:loose_piston_nut", OUTSIDE, "heard from 0.1 mm on; threads give 2 mm",
        lambda rng, law, a: {"play": span(rng, 0.1e-3, 2e-3)}),
    Cause("foot_valve", "outside", "outside:stuck_foot_valve", OUTSIDE, "the check disc closes late by 0.3 to 12 mm",
        lambda rng, law, a: {"late_compression": span(rng, 0.3e-3, 12e-3)}),
    Cause("chatter", "outside", "outside:valve_chatter", OUTSIDE, "chatter of blow-off discs: 60 to 180 Hz, 0.5 to 15 %",
        lambda rng, law, a: {"chatter": (span(rng, 0.005, 0.15), evenly(rng, 60.0, 180.0))}),
    Cause("bent_rod", "outside", "outside:bent_rod", OUTSIDE, "a dent or bend over 5 to 20 mm of the rod, 3 to 150 N",
        lambda rng, law, a: {"rod_bump": (span(rng, 3.0, 150.0), a * evenly(rng, -0.6, 0.6), evenly(rng, 5e-3, 20e-3))},
        ("side_load_friction",)),
    Cause("frame", "outside", "outside:bench_resonance", OUTSIDE, "a loose crossbeam: 25 to 70 Hz, damping 2 to 10 %",
        lambda rng, law, a: {"ringing": (span(rng, 0.1, 2.0), evenly(rng, 25.0, 70.0), evenly(rng, 0.02, 0.1))}),
    Cause("connector", "outside", "outside:loose_connector", OUTSIDE, "steps of the bridge signal, 2 to 80 N",
        lambda rng, law, a: {"contact": span(rng, 2.0, 80.0)}),
)}  # fmt: skip
