"""How strong a cause is in practice: each function draws one, in SI units, for the campaign of the day."""

import numpy as np

from twintube.lab.workshop.cause import Cause, Rubber
from twintube.lab.workshop.fluid_causes import (
    Heating,
    LateCheckValves,
    MixingLength,
    OilColumn,
    TiltedSurface,
    WarmOil,
    WornBleed,
    WornScale,
)
from twintube.lab.workshop.other_causes import (
    BentRod,
    Dissolving,
    FoamBump,
    FoamCollapse,
    Leak,
    OtherLaws,
    Refilled,
    ResidualPressure,
    RubberStop,
    SideLoad,
    WrongPreload,
)
from twintube.lab.workshop.plan import Day

Draw = np.random.Generator


def sign(draw: Draw) -> float:
    """Plus or minus."""
    return float(draw.choice([-1.0, 1.0]))


def between(draw: Draw, low: float, high: float) -> float:
    """Evenly over the logarithm."""
    return float(np.exp(draw.uniform(np.log(low), np.log(high))))


def widest(day: Day) -> float:
    """Largest stroke of the campaign [m]."""
    return max(float(np.abs(trial.x).max()) for trial in day.trials)


def warm_oil(draw: Draw, day: Day) -> list[Cause]:
    """15 to 60 K warmer, or some 15 to 25 K colder (a hall in winter)."""
    kelvin = float(draw.uniform(15.0, 60.0)) if draw.random() < 0.8 else -float(draw.uniform(12.0, 22.0))
    return [WarmOil("oil_temperature", "Vogel viscosity, all records alike", {"kelvin": kelvin}, kelvin=kelvin)]


def heating(draw: Draw, day: Day) -> list[Cause]:
    """The oil and what it touches: its heat capacity and some steel, 1900 J/kgK and 870 kg/m3 (Dixon)."""
    capacity = day.damper.parameters.V_oil * 870 * 1900 * float(draw.uniform(1.2, 1.8))
    cooling = float(draw.uniform(90.0, 400.0))
    return [Heating("oil_temperature", "lumped heat balance along the run", {"capacity": capacity, "cooling": cooling},
                    capacity=capacity, cooling=cooling)]  # fmt: skip


def linear_mount(draw: Draw, day: Day) -> list[Cause]:
    """Pin mount or eye bushing, 250 to 1200 N/mm; loss factor 0.1 to 0.2 at 10 Hz."""
    k = between(draw, 2.5e5, 1.2e6)
    c = k * float(draw.uniform(0.1, 0.2)) / (2 * np.pi * 10)
    return [Cause("mount_compliance", "Kelvin-Voigt", {"stiffness": k, "damping": c}, rubber=Rubber(k, 0.0, c))]


def hard_mount(draw: Draw, day: Day) -> list[Cause]:
    """Soft in the middle, twice as stiff after 2 to 4 mm."""
    k, at = between(draw, 2e5, 6e5), float(draw.uniform(1e-3, 2.5e-3))
    c, cubic = k * 0.15 / (2 * np.pi * 10), k / (3 * at**2)
    return [Cause("mount_compliance", "progressive", {"stiffness": k, "cubic": cubic}, rubber=Rubber(k, cubic, c))]


def oil_column(draw: Draw, day: Day) -> list[Cause]:
    """A^2 K / V with a bulk modulus lowered by air."""
    k = between(draw, 3e5, 1.5e6)
    return [OilColumn("fluid_lag", "Maxwell element", {"stiffness": k}, stiffness=k)]


def late_valves(draw: Draw, day: Day) -> list[Cause]:
    """0.5 to 2 mm."""
    way = between(draw, 0.5e-3, 2e-3)
    return [LateCheckValves("fluid_lag", "late check valves, linear over the stroke", {"stroke": way}, stroke=way)]


def mixing(draw: Draw, day: Day) -> list[Cause]:
    """3 to 12 mm."""
    length = between(draw, 3e-3, 12e-3)
    return [MixingLength("smooth_transition", "first order over the stroke", {"length": length}, length=length)]


def tilted(draw: Draw, day: Day) -> list[Cause]:
    """6 to 20 mm."""
    height = between(draw, 6e-3, 20e-3)
    return [TiltedSurface("smooth_transition", "mean over a height, both sides", {"height": height}, height=height)]


def foam_rate(draw: Draw, day: Day) -> list[Cause]:
    """Half-lives of 0.7 to 4 s."""
    rate = float(np.log(2) / between(draw, 0.7, 4.0))
    return [FoamCollapse("foam_decay", "first order in time", {"rate": rate}, rate=rate)]


def foam_front(draw: Draw, day: Day) -> list[Cause]:
    """5 to 25 mL/s: a front of 0.5 to 3 cm/s over the cross-section."""
    front = between(draw, 5e-6, 25e-6)
    return [FoamCollapse("foam_decay", "constant rate", {"front": front}, front=front)]


def dissolving(draw: Draw, day: Day) -> list[Cause]:
    """Half-lives of 1 to 10 s (8 s in the paper)."""
    rate = float(np.log(2) / between(draw, 1.0, 10.0))
    return [Dissolving("gas_redissolution", "first order in time", {"rate": rate}, rate=rate)]


def pressed(draw: Draw, day: Day) -> list[Cause]:
    """Slower at rest, faster under pressure."""
    rate = float(np.log(2) / between(draw, 3.0, 15.0))
    return [
        Dissolving(
            "gas_redissolution", "rate grows with pressure", {"rate": rate, "twice_at": 500.0}, rate=rate, pressed=500.0
        )
    ]


def preload(draw: Draw, day: Day) -> list[Cause]:
    """2 to 9 bar where 5 were meant."""
    bar = float(draw.choice([draw.uniform(2.0, 3.5), draw.uniform(6.5, 9.0)]))
    return [WrongPreload("gas_spring", "pressure of the intact damper", {"bar": bar}, ratio=bar / 5.0)]


def residual(draw: Draw, day: Day) -> list[Cause]:
    """0.5 to 2.5 bar left, polytropic."""
    p, n = float(draw.uniform(0.5e5, 2.5e5)), float(draw.uniform(1.1, 1.35))
    return [
        ResidualPressure(
            "gas_spring", "residual pressure, polytropic", {"pressure": p, "exponent": n}, pressure=p, exponent=n
        )
    ]


def film(draw: Draw, day: Day) -> list[Cause]:
    """A damaged seal: 3 to 12 % of the oil over the longest state."""
    way = longest_state(day)
    q = float(draw.uniform(0.03, 0.12)) * day.damper.parameters.V_oil / way
    return [Leak("seal_leak", "film per stroke, each state filled afresh", {"film": q}, film=q)]


def orifice(draw: Draw, day: Day) -> list[Cause]:
    """A cut lip: 3 to 10 % of the oil over the whole run, at 15 bar."""
    time = sum(len(trial.x) / trial.rate for trial in day.trials)
    q = float(draw.uniform(0.03, 0.1)) * day.damper.parameters.V_oil / time / float(np.sqrt(15.0))
    return [Leak("seal_leak", "orifice, goes on through all states", {"orifice": q}, orifice=q, refilled=False)]


def longest_state(day: Day) -> float:
    """Way [m] of the state that moves most."""
    ways: dict[tuple[float, bool], float] = {}
    for trial in day.trials:
        state = (trial.level, trial.preload)
        ways[state] = ways.get(state, 0.0) + float(np.abs(np.diff(trial.x)).sum())
    return max(ways.values())


def rubber_stop(draw: Draw, day: Day) -> list[Cause]:
    """Touched over the last 2 to 7 mm."""
    onset, side = widest(day) - float(draw.uniform(2e-3, 7e-3)), 1.0
    force, power = between(draw, 600.0, 3000.0), float(draw.uniform(1.3, 2.0))
    said = {"onset": onset, "at_10mm": force, "power": power}
    law = "rubber, power law, rebound"
    return [RubberStop("end_stop", law, said, side=side, onset=onset, at_10mm=force, power=power)]


def foam_bump(draw: Draw, day: Day) -> list[Cause]:
    """Soft polyurethane over the last 4 to 10 mm."""
    onset, k = widest(day) - float(draw.uniform(4e-3, 10e-3)), between(draw, 1.5e4, 6e4)
    return [
        FoamBump(
            "end_stop", "cellular stop, rational, compression", {"onset": onset, "stiffness": k}, onset=onset, stiffness=k
        )
    ]


def side_load(draw: Draw, day: Day) -> list[Cause]:
    """Side force of 0.3 to 1.5 kN, friction coefficient near 0.1."""
    extra = between(draw, 30.0, 150.0)
    return [SideLoad("side_load_friction", "Coulomb", {"extra": extra}, extra=extra)]


def bent_rod(draw: Draw, day: Day) -> list[Cause]:
    """As above at the middle of the stroke."""
    extra = between(draw, 30.0, 130.0)
    overhang = float(draw.uniform(0.1, 0.5))
    said = {"extra": extra, "overhang": overhang}
    return [BentRod("side_load_friction", "bent rod, growing with extension", said, extra=extra, overhang=overhang)]


def scale(draw: Draw, day: Day) -> list[Cause]:
    """5 to 35 %, in one or both directions."""
    size = between(draw, 0.05, 0.35)
    re, co = [(size, 0.0), (0.0, size), (size, size * float(draw.uniform(0.5, 1.0)))][int(draw.integers(3))]
    return [WornScale("valve_wear", "scaled", {"rebound": re, "compression": co}, rebound=re, compression=co)]


def bleed(draw: Draw, day: Day) -> list[Cause]:
    """A leak that takes 0.02 to 0.12 m/s at 1000 N."""
    re = between(draw, 0.02, 0.12)
    co = 0.0 if draw.random() < 0.4 else re * float(draw.uniform(0.5, 1.5))
    return [
        WornBleed("valve_wear", "orifice beside the valves", {"rebound": re, "compression": co}, rebound=re, compression=co)
    ]


def worn_out(draw: Draw, day: Day) -> list[Cause]:
    """The upper part of that range, in both directions."""
    b = between(draw, 0.06, 0.14)
    return [WornBleed("valve_wear", "orifice beside the valves", {"rebound": b, "compression": b}, rebound=b, compression=b)]


def all_levels(draw: Draw, day: Day) -> list[Cause]:
    """1.5 to 6 % of the oil in all degraded states: what stayed in the tubes, or a wrong scale."""
    shift = sign(draw) * float(draw.uniform(0.015, 0.06))
    return [Refilled("oil_level_error", "all degraded states", {"shift": shift}, shift=shift)]


def one_level(draw: Draw, day: Day) -> list[Cause]:
    """2.5 to 6 % in the lowest state."""
    level = min(trial.level for trial in day.trials)
    shift = sign(draw) * float(draw.uniform(0.025, 0.06))
    return [Refilled("oil_level_error", "one state", {"shift": shift, "level": level}, shift=shift, levels=(level,))]


def laws(draw: Draw, day: Day) -> list[Cause]:
    """Another sample of the damper: the flows of the degradation laws moved by 0.1 to 0.3."""
    p, changes = day.damper.parameters, {}
    for name in ("X_Re", "X_Co1", "X_Co2", "G_PV"):
        value = float(getattr(p, name))
        size = float(draw.uniform(0.1, 0.3))
        changes[name] = round(value + size if value < 0.5 else value - size, 3)
    return [OtherLaws("recalibrate", "other flow shares", dict(changes), changes=changes)]
