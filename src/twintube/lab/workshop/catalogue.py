"""The sixty cases: which cause has which strength, from practice, and which seed has which case."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from twintube.lab.workshop import fault_strengths, strengths
from twintube.lab.workshop.cause import Cause
from twintube.lab.workshop.plan import STYLES, Day, Wish

Maker = Callable[[np.random.Generator, Day], list[Cause]]


@dataclass(frozen=True)
class Case:
    """What is hidden."""

    kind: str
    causes: tuple[str, ...]
    make: Maker
    wish: Wish = field(default_factory=Wish)
    hidden: str = ""


def nothing(draw: np.random.Generator, day: Day) -> list[Cause]:
    """No cause."""
    return []


def both(first: Maker, second: Maker) -> Maker:
    """Two causes at once."""
    return lambda draw, day: [*first(draw, day), *second(draw, day)]


DEGRADED = Wish(states=1)
FOAMY = Wish(
    dampers=("SA2", "SA3", "SA5", "SA6", "SA8"),
    states=2,
    low=True,
    speed=0.786,
    styles=("velocities", "frequencies", "mixed"),
)
CAVITATING = Wish(dampers=("SA8", "SA8", "SA7", "SA5"), states=2, speed=1.31, styles=("recovery",))
RUBBERY = Wish(speed=1.05)
WIDE = Wish(wide=True)
LEAKING = Wish(states=2, styles=("velocities", "frequencies", "mixed", "triangles"))


QUIET = ("frequencies", "triangles", "sweep", "road", "recovery", "velocities")


def single(name: str, make: Maker, wish: Wish | None = None, kind: str = "effect", hidden: str = "") -> Case:
    """A case of one cause."""
    return Case(kind, (name,), make, wish or Wish(), hidden or name)


def all_cases() -> list[Case]:
    """Fourteen times nothing, 35 single causes, five pairs, six outside."""
    s, m = strengths, fault_strengths
    cases = [Case("none", ("none",), nothing, Wish(styles=(style,)), "none") for style in (*STYLES, *QUIET)]
    cases += [
        single("oil_temperature", s.warm_oil),
        single("oil_temperature", s.heating, Wish(speed=1.05, styles=("velocities", "frequencies", "triangles", "road"))),
        single("mount_compliance", s.linear_mount, RUBBERY),
        single("mount_compliance", s.hard_mount, RUBBERY),
        single("fluid_lag", s.oil_column, RUBBERY),
        single("fluid_lag", s.late_valves),
        single("smooth_transition", s.mixing, Wish(states=2, low=True)),
        single("smooth_transition", s.tilted, Wish(states=2, low=True)),
        single("foam_decay", s.foam_rate, FOAMY),
        single("foam_decay", s.foam_front, FOAMY),
        single("gas_redissolution", s.dissolving, CAVITATING),
        single("gas_redissolution", s.pressed, CAVITATING),
        single("gas_spring", s.preload),
        single("gas_spring", s.residual, DEGRADED),
        single("seal_leak", s.film, LEAKING),
        single("seal_leak", s.orifice, LEAKING),
        single("end_stop", s.rubber_stop, WIDE),
        single("end_stop", s.foam_bump, WIDE),
        single("side_load_friction", s.side_load),
        single("side_load_friction", s.bent_rod),
        single("valve_wear", s.scale),
        single("valve_wear", s.bleed),
        single("oil_level_error", s.all_levels, Wish(states=2)),
        single("oil_level_error", s.one_level, Wish(states=2, low=True)),
        single("recalibrate", s.laws, Wish(states=2), "recalibrate"),
        single("force_offset", m.offset, kind="fault"),
        single("force_gain", m.gain, kind="fault"),
        single("sign_flip", m.flip, kind="fault"),
        single("channel_delay", m.delay, kind="fault"),
        single("unit_error", m.unit, kind="fault"),
        single("stroke_gain", m.stroke, kind="fault"),
        single("zero_drift", m.drift, kind="fault"),
        single("time_base", m.clock, kind="fault"),
        single("odd_record", m.odd, kind="fault"),
    ]
    pairs: list[tuple[str, Maker, str, Maker, Wish]] = [
        ("oil_temperature", s.warm_oil, "side_load_friction", s.side_load, Wish()),
        ("mount_compliance", s.linear_mount, "gas_spring", s.preload, RUBBERY),
        ("valve_wear", s.scale, "oil_level_error", s.all_levels, Wish(states=2)),
        ("end_stop", s.rubber_stop, "valve_wear", s.worn_out, WIDE),
        ("fluid_lag", s.oil_column, "side_load_friction", s.bent_rod, RUBBERY),
    ]
    cases += [Case("pair", (a, b), both(f, g), wish, f"{a} and {b}") for a, f, b, g, wish in pairs]
    for name, make, words in (
        ("clipping", m.clipping, "load cell or amplifier at its limit"),
        ("backlash", m.play, "play in a joint"),
        ("rig_resonance", m.resonance, "resonance of frame and load cell"),
        ("mains_hum", m.hum, "mains hum in the force channel"),
        ("dropouts", m.dropouts, "samples of the force lost, read as 0"),
        ("clamp_inertia", m.inertia, "mass of clamp between load cell and damper"),
        ("backlash", m.play, "play in a joint"),
    ):
        kind = "fault" if name == "clamp_inertia" else "outside"
        cases.append(Case(kind, (name,), make, Wish(rates=(500.0, 1000.0, 2000.0)), words))
    return cases


def case_of(seed: int) -> Case:
    """The case of a seed from 1 on: of each sixty seeds every case is hidden in one, in an order of their own."""
    cases = all_cases()
    block, place = divmod(seed - 1, len(cases))
    order = np.random.default_rng((20261126, block) if block else 20261126).permutation(len(cases))
    return cases[int(order[place])]
