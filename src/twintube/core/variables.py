"""The one table of variables: every name, symbol, unit, bound and source of the model.

Four records hold all numbers of a damper: `Parameters` (given), `Derived` (follows from them), `State` (changes
with time) and `Outputs`. The metadata of their fields is the only place where a variable is described; the FMI
description, the bounds of an optimiser, the documentation and the checks on reading are made from it.

Standard library only: this file travels inside the Python FMU. All values are SI.
"""

from dataclasses import Field, dataclass, field, fields
from typing import Any, Generic, TypeVar

from twintube.core.units import NOMINAL, UNITS

# Points of each branch of the F-v curve; a shorter measured table is continued along its last segment.
FV_POINTS = 20


def var(  # noqa: PLR0913 - a column of the table each
    group: str,
    symbol: str,
    unit: str,
    description: str,
    *,
    lower: float | None = None,
    upper: float | None = None,
    source: str = "",
    tunable: bool = False,
    integer: bool = False,
    size: int = 1,
    default: float | None = None,
    role: str = "",
    nominal: float | None = None,
    fmi: str = "",
    value: str = "",
) -> Any:
    """A record's field with its description; `unit` is an FMI base-unit expression, "1" where there is none.

    `nominal` is the usual magnitude [unit], by default that of the unit. Raises ValueError for a unit that `core/units.py`
    does not define: files for importers would lack it.
    """
    if unit != "1" and unit not in UNITS:
        raise ValueError(f"unit {unit!r} of {group or 'variable'} ({description}): must be 1 or one of {', '.join(UNITS)}")
    metadata = {
        "group": group,
        "symbol": symbol,
        "unit": unit,
        "description": description,
        "lower": lower,
        "upper": upper,
        "source": source,
        "tunable": tunable,
        "integer": integer,
        "size": size,
        "default": default,
        "role": role,
        "nominal": NOMINAL.get(unit, 1.0) if nominal is None else nominal,
        "fmi": fmi,
        "value": value,
    }
    return field(metadata=metadata)


def fmi_name(item: Field[Any]) -> str:
    """The structured name of a field, as in the FMU: `geometry.D_li`, `V1.oil`, or `oil_level` where it has no group."""
    name: str = item.metadata["fmi"] or item.name
    group: str = item.metadata["group"]
    return f"{group}.{name}" if group else name


@dataclass(frozen=True, slots=True)
class Parameters:
    """Everything that is given about a damper and its condition; cannot be changed, `dataclasses.replace` makes another."""

    oil_level: float = var("", "", "1", "oil over the intact oil volume", lower=0, upper=1,
                           source="Table 2", default=1.0)
    gas_preload: float = var("", "", "1", "gas pressure above ambient over the nominal: 1 present, 0 lost", lower=0, upper=1,
                             source="Section 2", default=1.0)

    D_a: float = var("geometry", "D_a", "m", "diameter of the outer tube", lower=0.02, upper=0.2, source="Table 5")
    D_PR: float = var("geometry", "D_PR", "m", "diameter of the piston rod", lower=0.004, upper=0.08, source="Table 5")
    D_li: float = var("geometry", "D_li", "m", "inner diameter of the inner tube", lower=0.01, upper=0.15,
                      source="Table 5")
    D_la: float = var("geometry", "D_la", "m", "outer diameter of the inner tube", lower=0.01, upper=0.16,
                      source="Table 5")
    h_l: float = var("geometry", "h_l", "m", "length of the inner tube", lower=0.05, upper=1.0, source="Table 5")
    dead_length: float = var("geometry", "h_dead", "m", "tube length taken by piston, stops and foot valve",
                             lower=0.0, upper=0.3, source="unpublished")
    V_oil: float = var("geometry", "V_oil", "m3", "oil volume of the intact damper", lower=1e-5, upper=5e-3,
                       source="Table 2")
    stroke_max: float = var("geometry", "z_max", "m", "maximum stroke to each side of the middle position", lower=0.001,
                            upper=0.4, source="unpublished")

    v_re: tuple[float, ...] = var("fv", "v", "m/s", "F-v curve, rebound: velocities", lower=0, size=FV_POINTS,
                            source="Figure 3, unpublished")
    F_re: tuple[float, ...] = var("fv", "d", "N", "F-v curve, rebound: forces", lower=0, size=FV_POINTS,
                            source="Figure 3, unpublished")
    v_co: tuple[float, ...] = var("fv", "v", "m/s", "F-v curve, compression: velocities (magnitude)", lower=0,
                            size=FV_POINTS, source="Figure 3, unpublished")
    F_co: tuple[float, ...] = var("fv", "d", "N", "F-v curve, compression: forces (magnitude)", lower=0, size=FV_POINTS,
                            source="Figure 3, unpublished")

    F_FrS: float = var("friction", "F_FrS", "N", "saturated quasi-static friction force", lower=0, upper=2000,
                       source="equation 2, unpublished", tunable=True, nominal=100.0)
    sigma_0: float = var("friction", "sigma_0", "N/m", "slope of the friction hysteresis at reversal", lower=1.0,
                         upper=1e8, source="equation 2, unpublished", tunable=True, nominal=1e5)
    delta_D: float = var("friction", "delta_D", "1", "exponent of the friction gradient", lower=0.1, upper=5,
                         source="equation 2, unpublished", tunable=True)
    k_high: float = var("friction", "k_FrS", "1", "Stribeck scaling of the friction at high velocity", lower=0, upper=5,
                        source="Figure 12, unpublished", tunable=True)
    v_S: float = var("friction", "v_S", "m/s", "velocity over which the Stribeck scaling settles", lower=1e-4, upper=2,
                     source="Figure 12, unpublished", tunable=True)
    oil_loss_gain: float = var("friction", "", "1", "rise of the friction at full oil loss", lower=0, upper=5,
                               source="Section 3.2, unpublished", tunable=True)

    F_0: float = var("gas_spring", "F_0", "N", "gas force at stroke 0 with preload", lower=0,
                     upper=5000, source="Figure 7, unpublished", tunable=True)
    c_gas: float = var("gas_spring", "c_gas", "N/m", "gas spring stiffness with preload", lower=0, upper=1e5,
                       source="Figure 7, unpublished", tunable=True)
    c_gas_lost: float = var("gas_spring", "c_gas", "N/m", "gas spring stiffness, preload lost", lower=0,
                            upper=1e5, source="Figure 7, unpublished", tunable=True)

    polytropic: int = var("gas_spring", "", "1", "0: linear spring; 1: enclosed gas, p V^n_gas",
                          lower=0, upper=1, integer=True, source="beyond the paper", default=0)
    n_gas: float = var("gas_spring", "n", "1", "exponent of the polytropic gas: 1 slow, 1.4 adiabatic",
                       lower=1, upper=1.4, source="assumed", tunable=True, default=1.35)

    T_curve: float = var("temperature", "T_0", "K", "temperature at which F-v curve, friction and gas pressure hold",
                         lower=200, upper=450, source="assumed: a room of 23 degC", default=296.15)
    T_cold: float = var("temperature", "T_c", "K", "colder point of the law, and its lower end", lower=150, upper=450,
                        source="Hryciow 2022", default=243.15)
    k_cold: float = var("temperature", "k_c", "1", "fluid force at T_cold over that at T_curve", lower=1, upper=10,
                        source="Hryciow 2022", default=2.5)
    T_hot: float = var("temperature", "T_h", "K", "hotter point of the law, and its upper end", lower=200, upper=500,
                       source="assumed, 0.2 to 0.4 %/K", default=353.15)
    k_hot: float = var("temperature", "k_h", "1", "fluid force at T_hot over that at T_curve", lower=0.1, upper=1,
                       source="assumed, 0.2 to 0.4 %/K", default=0.85)
    friction_power: float = var("temperature", "", "1", "power of the fluid's factor with which friction goes", lower=0,
                                upper=1, source="assumed: 0 dry, 1 viscous", default=0.5)

    X_Re: float = var("degradation", "X_Re", "1", "oil share of the piston valve's mixed flow, rebound",
                      lower=0, upper=1, source="Table 9, equation 22", tunable=True)
    L_PV: float = var("degradation", "L_PV", "1", "leakage of the piston valve", lower=0,
                      upper=1, source="Table 9, equation 22", tunable=True)
    G_PV: float = var("degradation", "G_PV", "1", "compression force by surplus piston valve flow",
                      lower=0, upper=1, source="Table 9, equation 29", tunable=True)
    X_Co1: float = var("degradation", "X_Co1", "1", "bottom valve flow, compression, V2 with gas",
                       lower=0, upper=1, source="Table 9, equation 27", tunable=True)
    X_Co2: float = var("degradation", "X_Co2", "1", "bottom valve flow, compression, V2 full, V1 not",
                       lower=0, upper=1, source="Table 9, equation 28", tunable=True)

    S_BV: float = var("foam", "S_BV", "1", "foaming share of the bottom valve's gas, rebound", lower=0, upper=1,
                      source="Table 9, equation 30", tunable=True)
    S_BVoil: float = var("foam", "S_BVoil", "1", "oil per gas in the bottom valve's foam", lower=0, upper=1,
                         source="Table 9, equation 34", tunable=True)
    S_PV: float = var("foam", "S_PV", "1", "foaming share of the piston valve's gas, compression", lower=0,
                      upper=1, source="Table 9, equation 30", tunable=True)
    S_PVoil: float = var("foam", "S_PVoil", "1", "oil per gas in the piston valve's foam", lower=0, upper=1,
                         source="Table 9, equation 34", tunable=True)
    B: float = var("foam", "B", "1", "foam acts like oil (1) or like gas (0)", lower=0, upper=1,
                   source="Table 9, equation 36", tunable=True)
    E: float = var("foam", "E", "1", "exponent of the foam's oil share in its force", lower=0, upper=100,
                   source="Table 9, equation 36", tunable=True)
    v_foam: float = var("foam", "v_foam", "m/s", "velocity above which gas through oil foams", lower=0, upper=10,
                        source="Section 3.2", tunable=True, default=0.05)

    v_cav: float = var("cavitation", "v_cav", "m/s", "velocity above which the piston valve cavitates", lower=0, upper=10,
                       source="Table 9, equation 40", tunable=True)
    Y_Co_cav: float = var("cavitation", "Y_Co", "1", "piston valve's oil that becomes gas, compression",
                          lower=0, upper=1, source="Table 9, equation 40", tunable=True)
    Y_Re_cav: float = var("cavitation", "Y_Re", "1", "piston valve's oil that becomes gas, rebound",
                          lower=0, upper=1, source="Table 9, equation 40", tunable=True)

    leak_carries_oil: int = var("reading", "", "1", "1: the leak L_PV adds oil to the mixed flow", lower=0,
                                upper=1, integer=True, source="open choice 1", default=0)
    foam_leaves_with_gas: int = var("reading", "", "1", "1: beside gas, foam leaves before oil",
                                    lower=0, upper=1, integer=True, source="open choice 4", default=1)
    foam_decays: int = var("reading", "", "1", "1: foam leaving V1 beside oil separates", lower=0,
                           upper=1, integer=True, source="open choice 5", default=1)
    cavitation_foams: int = var("reading", "", "1", "1: gas freed by cavitation foams as S_PV says", lower=0, upper=1,
                                integer=True, source="equation 40 beside 30", default=0)
    venting: int = var("reading", "", "1", "cavitation into a full V1: 0, k_degr slides; 1, step by step",
                       lower=0, upper=1, integer=True, source="equations 19 and 29", default=0)
    cavitation_loss: float = var("reading", "", "1", "oil loss from which cavitation acts in full",
                                 lower=0, upper=1, source="open choice 3", default=0.2)
    foot_valve: float = var("reading", "", "1", "share of the compression force at the foot valve; 1: V1 always fills",
                            lower=0, upper=1, source="beyond the paper, equation 19", default=1.0)

    def __post_init__(self) -> None:
        """Arrays given as lists become tuples."""
        for item in fields(self):
            if item.metadata["size"] > 1:
                object.__setattr__(self, item.name, tuple(getattr(self, item.name)))


@dataclass(slots=True)
class Inputs:
    """What the surroundings set before each step."""

    stroke: float = var("", "z", "m", "stroke, positive in rebound (rod out), 0 in the middle", lower=-0.5, upper=0.5,
                        default=0.0)
    velocity: float = var("", "z_dot", "m/s", "velocity, positive in rebound", lower=-20, upper=20, default=0.0)
    # From far below the coldest place to far above what a seal stands: degrees Celsius taken for kelvins are refused.
    temperature: float = var("", "T", "K", "temperature of oil, seals and gas, or around a damper that keeps its heat",
                             lower=150, upper=500, default=296.15)


T = TypeVar("T")


@dataclass(frozen=True)
class Outputs(Generic[T]):
    """What the damper gives to its surroundings, the one table of it: numbers at a time, or arrays (n,) over a record.

    `fmi` is the name in the FMU where it differs, `value` the expression of `d` (Derived) and `s` (State) that an output
    is, from which `core/publishing.py` makes the functions that fill in a record or a row.
    """

    force: T = var("", "F_SA", "N", "force, positive when the damper resists rebound", source="equation 1",
                   value="total_force(s)")
    # At most 10 of cold oil (k_cold), 7.4 of what an effect makes it colder still, and 2 of a tight valve.
    k_degr: T = var("", "k_degr", "1", "fluid force over the intact one at T_curve, mean of the step", lower=0, upper=150,
                    source="equations 23-39", value="degradation(d, s)")
    F_fluid: T = var("", "F_Fl k_degr", "N", "fluid force, degraded", source="equation 1", fmi="force_fluid",
                     value="s.F_fluid")
    F_friction: T = var("", "F_Fr", "N", "friction force", source="equation 2", nominal=100.0, fmi="force_friction",
                        value="s.F_friction")
    F_gas: T = var("", "F_S", "N", "gas force", source="equation 1", nominal=100.0, fmi="force_gas", value="s.F_gas")
    work: T = var("", "W", "J", "work dissipated since the start, by fluid and friction", source="Section 3.1",
                  value="s.work")
    V1_oil: T = var("", "V_1oil", "m3", "oil in the rebound chamber", lower=0, source="equation 5", fmi="V1.oil",
                    value="s.V1_oil")
    V1_gas: T = var("", "V_1gas", "m3", "gas in the rebound chamber", lower=0, source="equation 5", fmi="V1.gas",
                    value="s.V1_gas + s.V1_void")
    V1_foam: T = var("", "V_1foam", "m3", "foam in the rebound chamber", lower=0, source="equation 5", fmi="V1.foam",
                     value="s.V1_foam")
    V2_oil: T = var("", "V_2oil", "m3", "oil in the compression chamber", lower=0, source="equation 5", fmi="V2.oil",
                    value="s.V2_oil")
    V2_gas: T = var("", "V_2gas", "m3", "gas in the compression chamber", lower=0, source="equation 5", fmi="V2.gas",
                    value="s.V2_gas")
    V2_foam: T = var("", "V_2foam", "m3", "foam in the compression chamber", lower=0, source="equation 5", fmi="V2.foam",
                     value="s.V2_foam")
    V3_oil: T = var("", "V_3oil", "m3", "oil in the reserve chamber", lower=0, source="equation 5", fmi="V3.oil",
                    value="s.V3_oil")
    V3_gas: T = var("", "V_3gas", "m3", "gas in the reserve chamber", lower=0, source="the rest of its volume",
                    fmi="V3.gas", value="reserve_gas(d, s)")
    V3_foam: T = var("", "V_3foam", "m3", "foam in the reserve chamber", lower=0, source="equation 5", fmi="V3.foam",
                     value="s.V3_foam")
    V_cav: T = var("", "", "m3", "oil lost to gas by cavitation so far", lower=0, source="equation 41", value="s.V_cav")
    heat_flow: T = var("", "P", "W", "work dissipated in the last step over its length", source="the work's rate",
                       value="heat_flow(s)")
    T_oil: T = var("", "T", "K", "temperature of oil, seals and gas", source="the input, and heat of its own",
                   fmi="temperature_oil", value="s.T")


@dataclass(slots=True)
class Derived:
    """What follows from the parameters alone; `kernel.prepare` fills it."""

    A_1: float = var("derived", "A_1", "m2", "piston area towards the rebound chamber", source="equation 3", default=0.0)
    A_2: float = var("derived", "A_2", "m2", "piston area towards the compression chamber", source="equation 3", default=0.0)
    A_rod: float = var("derived", "A_rod", "m2", "cross-section of the piston rod", default=0.0)
    half_length: float = var("derived", "", "m", "free length of each working chamber at stroke 0", default=0.0)
    V_reserve: float = var("derived", "", "m3", "volume between the tubes", default=0.0)
    F_FrS: float = var("derived", "F_FrS", "N", "saturated friction force in this condition", default=0.0)
    F_0: float = var("derived", "F_0", "N", "gas force at stroke 0 in this condition", default=0.0)
    c_gas: float = var("derived", "c_gas", "N/m", "gas spring stiffness in this condition", default=0.0)
    W_kPV: float = var("derived", "W_kPV", "1", "oil share of the mixed rebound flow", source="equation 22", default=0.0)
    W_kBV_1: float = var("derived", "W_kBV", "1", "bottom valve flow, V2 with gas", source="equation 27", default=0.0)
    W_kBV_2: float = var("derived", "W_kBV", "1", "bottom valve flow, V2 full", source="equation 28", default=0.0)
    k_Co2: float = var("derived", "k_degr", "1", "k_degr in compression, V2 full, V1 not", source="equation 29", default=0.0)
    v_fill: float = var("derived", "", "m/s", "speed of compression up to which oil fills V1", default=0.0)
    Y_Co: float = var("derived", "Y_Co", "1", "cavitation share in compression in this condition", default=0.0)
    Y_Re: float = var("derived", "Y_Re", "1", "cavitation share in rebound in this condition", default=0.0)
    cavitation: float = var("derived", "", "1", "share of the cavitation that the oil loss brings", default=0.0)
    extended: int = var("derived", "", "1", "1: an effect beyond the paper's model acts", integer=True, default=0)


@dataclass(slots=True)
class State:
    """What the damper remembers. Foam is kept as its volume and the oil in it: mixing (equation 35) is then a sum."""

    z: float = var("state", "z", "m", "stroke, positive in rebound", default=0.0)
    V1_oil: float = var("V1", "V_1oil", "m3", "oil in the rebound chamber", default=0.0)
    V1_gas: float = var("V1", "V_1gas", "m3", "gas in the rebound chamber", default=0.0)
    V1_foam: float = var("V1", "V_1foam", "m3", "foam in the rebound chamber", default=0.0)
    V1_foam_oil: float = var("V1", "", "m3", "oil held by the foam of the rebound chamber", default=0.0)
    V1_void: float = var("V1", "", "m3", "void into which no oil has followed the piston", default=0.0)
    V2_oil: float = var("V2", "V_2oil", "m3", "oil in the compression chamber", default=0.0)
    V2_gas: float = var("V2", "V_2gas", "m3", "gas in the compression chamber", default=0.0)
    V2_foam: float = var("V2", "V_2foam", "m3", "foam in the compression chamber", default=0.0)
    V2_foam_oil: float = var("V2", "", "m3", "oil held by the foam of the compression chamber", default=0.0)
    V3_oil: float = var("V3", "V_3oil", "m3", "oil in the reserve chamber", default=0.0)
    V3_foam: float = var("V3", "V_3foam", "m3", "foam in the reserve chamber", default=0.0)
    V3_foam_oil: float = var("V3", "", "m3", "oil held by the foam of the reserve chamber", default=0.0)
    V_cav: float = var("state", "", "m3", "oil lost to gas by cavitation so far", default=0.0)
    F_D: float = var("state", "F_D", "N", "Dahl friction state", default=0.0)
    k_degr: float = var("state", "k_degr", "1", "degradation factor, mean over the last step", default=1.0)
    F_fluid: float = var("state", "F_Fl", "N", "fluid force, degraded", default=0.0)
    F_friction: float = var("state", "F_Fr", "N", "friction force", default=0.0)
    F_gas: float = var("state", "F_S", "N", "gas force", default=0.0)
    work: float = var("state", "W", "J", "dissipated work", default=0.0)
    work_begun: float = var("state", "W", "J", "dissipated work before the last step that took time", default=0.0)
    span: float = var("state", "", "s", "length of that step, 0 before the first", default=0.0)
    temperature: float = var("state", "T", "K", "temperature given from outside", default=0.0)
    T: float = var("state", "T", "K", "temperature in force", default=0.0)
    k_T: float = var("state", "k", "1", "fluid force over that at T_curve", default=1.0)
    k_T_Fr: float = var("state", "", "1", "friction over that at T_curve", default=1.0)
    k_T_gas: float = var("state", "", "1", "absolute gas pressure over that at T_curve", default=1.0)


@dataclass(slots=True)
class Flow:
    """Change of every phase per metre of stroke [m2] while the phases present stay the same; scratch of one step."""

    V1_oil: float = var("flow", "", "m2", "oil of V1", default=0.0)
    V1_gas: float = var("flow", "", "m2", "gas of V1", default=0.0)
    V1_foam: float = var("flow", "", "m2", "foam of V1", default=0.0)
    V1_foam_oil: float = var("flow", "", "m2", "oil in the foam of V1", default=0.0)
    V1_void: float = var("flow", "", "m2", "void of V1", default=0.0)
    V2_oil: float = var("flow", "", "m2", "oil of V2", default=0.0)
    V2_gas: float = var("flow", "", "m2", "gas of V2", default=0.0)
    V2_foam: float = var("flow", "", "m2", "foam of V2", default=0.0)
    V2_foam_oil: float = var("flow", "", "m2", "oil in the foam of V2", default=0.0)
    V3_oil: float = var("flow", "", "m2", "oil of V3", default=0.0)
    V3_foam: float = var("flow", "", "m2", "foam of V3", default=0.0)
    V3_foam_oil: float = var("flow", "", "m2", "oil in the foam of V3", default=0.0)
    cavitated: float = var("flow", "", "m2", "oil that becomes gas", default=0.0)
    k_degr: float = var("flow", "k_degr", "1", "degradation factor", default=1.0)
    k_mean: float = var("flow", "", "1", "mean degradation factor over the stroke of the last step", default=1.0)


def blank(record: type) -> Any:
    """A record with every field at its default; raises TypeError where a field has none."""
    values = {item.name: item.metadata["default"] for item in fields(record)}
    missing = [name for name, value in values.items() if value is None]
    if missing:
        raise TypeError(f"{record.__name__} has no default for {', '.join(missing)}")
    return record(**values)
