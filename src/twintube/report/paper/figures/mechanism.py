"""Figures 12, 14 and 16 to 18: how the model works."""

import itertools
from collections.abc import Callable, Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes

from twintube.claims.claim import run
from twintube.core.kernel import stribeck
from twintube.core.kernel.forces import foam_factor
from twintube.dampers import Damper
from twintube.dampers.variants import NO_CAVITATION, NO_FOAM
from twintube.engine.simulation import Simulation
from twintube.report.common import style
from twintube.report.paper.context import Context
from twintube.report.paper.statement import DEAD, FV, REACH, Plot, Statement, unchecked
from twintube.rig.signals import ONE_METRE, SLOWEST

FULL = 0.99  # k_degr [1] of the full force
ROUNDING = 1e-12  # of forces relative to oil's
VALUES = (0.1, 0.3, 0.5, 0.7)  # of the parameters of Figures 16 and 17
VARIED = (FV, DEAD, REACH, "the set of parameters around which the figure varies")


def figure_12(context: Context) -> Plot:
    """Velocity-dependent scaling of the friction."""
    figure, ((ax,),) = style.canvas(1, 1, (7.0, 3.6))
    v = np.linspace(-0.3, 0.3, 601)
    curves = {name: np.array([stribeck(d.parameters, float(x)) for x in v]) for name, d in context.dampers.items()}
    scaling = curves["SA7"]
    ax.plot(v, scaling, color=style.INK, lw=1.6)
    ax.set(xlabel="velocity [m/s]", ylabel="scaling $k_{FrS}$ [1]", ylim=(0, 1.08))
    return Plot(
        12,
        "Velocity-dependent scaling factor for the friction force",
        figure,
        (
            unchecked(
                "the friction is scaled with a damper-specific Stribeck curve taken from Deubel",
                "Section 3.2, Figure 12",
                "Figure 12 has no numbers in the text; the curve is assumed",
                {
                    "scaling_at_rest": float(scaling.max()),
                    "scaling_at_0.3_m_per_s": float(scaling[-1]),
                    "largest_difference_between_dampers": float(np.ptp(list(curves.values()), axis=0).max()),
                },
            ),
        ),
        ("shape and values of the scaling, the same for all eight dampers",),
    )


def figure_14(context: Context) -> Plot:
    """Phase volumes of the compression chamber."""
    damper = context.dampers["SA1"]
    level = damper.measured_levels[-1]
    signal, model = run(damper, level, ONE_METRE)
    span = slice(signal.marks[0], signal.marks[4] + 1)
    time = signal.time[span] - signal.time[signal.marks[0]]
    volumes = {phase: model.columns[f"V2_{phase}"][span] * 1e6 for phase in style.PHASES}
    figure, ((ax,),) = style.canvas(1, 1, (9.0, 4.0))
    ax.stackplot(time, *volumes.values(), colors=[style.PHASES[p] for p in volumes], labels=list(volumes), lw=0)
    total = np.sum(list(volumes.values()), axis=0)
    ax.plot(time, total, color=style.INK, lw=1.4, label="compression chamber $V_2$")
    ax.set_xlim(0, time[-1])
    ax.set_ylim(bottom=0)
    ax.set(xlabel=f"time [s], first four oscillations, maximum velocity {ONE_METRE:g} m/s", ylabel="volume [mL]")
    style.legend_above(figure, ax)
    at_top = {phase: float(v[np.argmax(total)]) for phase, v in volumes.items()}
    return Plot(
        14,
        f"Volumes of the compression chamber of Shock Absorber 1 during harmonic excitation, {level:.0%} oil",
        figure,
        (
            Statement(
                "the oil is not sufficient to fill the compression chamber to its maximum volume: there it also holds "
                "gas and oil foam",
                "Section 3.2, Figure 14",
                at_top["gas"] > 0 and at_top["foam"] > 0,
                {"mL_at_maximum_volume": at_top, "maximum_volume_mL": float(total.max())},
                "evidence",
                reason="gas or foam is missing at the largest volume",
            ),
        ),
        (DEAD, REACH, "oil level and velocity of the figure"),
        remarks=("The paper gives the damper and the amplitude (45 mm), but neither oil level nor velocity.",),
    )


def sweep(
    ax: Axes, damper: Damper, level: float, name: str, phase: Callable[[Simulation], Any], *, rebound: bool
) -> tuple[list[float], list[float]]:
    """Draw the fluid force of the last full stroke from a reversal for each of the VALUES of a parameter.

    Returns the mean k_degr while `phase` holds and the stroke [mm] after which the full force is reached, per value.
    """

    def stroke(state: Damper, oil_level: float, **line: Any) -> tuple[Simulation, slice]:
        signal, model = run(state, oil_level, SLOWEST)
        quarter = int(signal.marks[-1] - signal.marks[-2]) // 4
        begin = int(signal.marks[-2]) + (-quarter if rebound else quarter)
        span = slice(begin + 1, begin + int(signal.marks[-1] - signal.marks[-2]) // 2)
        ax.plot(model.stroke[span] * 1e3, model.F_fluid[span], **line)
        return model, span

    means, rises = [], []
    for value, colour in zip(VALUES, matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, len(VALUES))), strict=True):
        model, span = stroke(damper.with_(**{name: value}), level, color=colour, lw=1.5, label=f"{value:g}")
        z, k, inside = model.stroke[span], model.k_degr[span], phase(model)[span]
        means.append(float(k[inside].mean()) if inside.any() else float("nan"))
        full = np.flatnonzero(k > FULL)
        rises.append(float(abs(z[full[0]] - z[0]) * 1e3) if len(full) else float("nan"))
    stroke(damper, 1.0, color=style.GREY, lw=1.0, ls="--", label="intact")
    ax.legend(fontsize=8.5, loc="best", frameon=False)
    return means, rises


def mixed_1(run: Simulation) -> Any:
    """V1 holds oil and gas."""
    return (run.V1_gas > 0) & (run.V1_oil > 0)


def mixed_2(run: Simulation) -> Any:
    """V2 holds oil and gas."""
    return (run.V2_gas > 0) & (run.V2_oil > 0)


def venting(run: Simulation) -> Any:
    """V2 is full of oil, V1 still holds gas."""
    return (run.V2_gas <= 0) & (run.V1_gas > 0)


def rising(values: Sequence[float]) -> bool:
    """Whether the values rise from first to last and never fall by more than a thousandth."""
    return values[-1] > values[0] + 1e-6 and all(b >= a - 1e-3 for a, b in itertools.pairwise(values))


def basic(damper: Damper, **changes: float) -> Damper:
    """The damper with the basic model only, without foam and cavitation."""
    return damper.with_(**NO_FOAM, **NO_CAVITATION, **changes)


def figure_16(context: Context) -> Plot:
    """Effect of X_Re and L_PV on the rebound stroke."""
    damper = basic(context.dampers["SA1"], L_PV=0.2, X_Re=0.3)
    level = damper.measured_levels[-1]
    figure, axes = style.canvas(1, 2, (10.0, 4.2), sharey=True)
    style.title(axes[0][0], "oil share with gas $X_{Re}$ ($L_{PV}$ = 0.2)")
    style.title(axes[0][1], "leakage factor $L_{PV}$ ($X_{Re}$ = 0.3)")
    plateau, x_rises = sweep(axes[0][0], damper, level, "X_Re", mixed_1, rebound=True)
    leak, moves = sweep(axes[0][1], damper, level, "L_PV", mixed_1, rebound=True)
    style.label(axes, "stroke [mm]", "fluid force [N]")
    return Plot(
        16,
        "Effect of model parameters during the rebound stroke",
        figure,
        (
            Statement(
                "X_Re sets the share of the force while oil flows through the piston valve together with gas",
                "Section 3.2, Figure 16, equations 22 to 25",
                rising(plateau),
                {"X_Re": VALUES, "k_degr_beside_gas": plateau, "full_force_after_mm": x_rises},
                "consistency",
                "the relative force before the rise rises with the parameter",
            ),
            Statement(
                "L_PV is oil that changes chambers without producing force: it shifts the rise of the force",
                "Section 3.2, Figure 16",
                rising(moves) or rising([-m for m in moves]),
                {"L_PV": VALUES, "full_force_after_mm": moves, "k_degr_beside_gas": leak},
                "consistency",
                "the stroke before the rise changes in one direction with the parameter",
                "the rise does not shift in one direction",
            ),
        ),
        VARIED,
        remarks=(f"Drawn for SA1 with {level:.0%} oil at {SLOWEST:g} m/s; the paper gives no damper and no values here.",),
    )


def figure_17(context: Context) -> Plot:
    """Effect of X_Co1, X_Co2 and G_PV on the compression stroke."""
    given = {"X_Co1": 0.2, "X_Co2": 0.4, "G_PV": 0.2}
    names = {"X_Co1": "$X_{Co1}$", "X_Co2": "$X_{Co2}$", "G_PV": "$G_{PV}$"}
    damper, level = basic(context.dampers["SA1"], **given), 0.45
    figure, axes = style.canvas(1, 3, (11.0, 4.2), sharey=True)
    plateaus = {}
    for ax, name in zip(axes[0], given, strict=True):
        others = ", ".join(f"{names[other]} = {value:g}" for other, value in given.items() if other != name)
        style.title(ax, f"{names[name]} ({others})")
        plateaus[name], _ = sweep(ax, damper, level, name, mixed_2 if name == "X_Co1" else venting, rebound=False)
        ax.invert_xaxis()
    style.label(axes, "stroke [mm]", "fluid force [N]")
    return Plot(
        17,
        "Effect of model parameters during the compression stroke",
        figure,
        (
            Statement(
                "X_Co1 sets the force while the compression chamber holds oil and gas; X_Co2 and G_PV set it while the "
                "chamber is full of oil and the rebound chamber is still being vented",
                "Section 3.2, Figure 17, equations 26 to 29",
                all(rising(row) for row in plateaus.values()),
                {"values": VALUES, "k_degr_in_that_part_of_the_stroke": plateaus},
                "consistency",
                "the relative force in the named phase of the stroke rises with the parameter",
                "one phase of the stroke does not occur in this damper at this oil level",
            ),
        ),
        VARIED,
        remarks=(
            f"Drawn for SA1 with {level:.0%} oil at {SLOWEST:g} m/s; the compression stroke goes from left to right.",
            "Table 6 calls X_Co2 a flow through the piston valve, equation 28 for the bottom valve; the equation is taken.",
        ),
    )


def figure_18(context: Context) -> Plot:
    """The foaming model."""
    p = context.dampers["SA8"].with_(B=1.0)
    share = np.linspace(0.0, 1.0, 201)
    exponents = (0.5, 1.0, 2.0, 5.0, 10.0, 50.0)
    figure, ((ax,),) = style.canvas(1, 1, (7.0, 4.0))
    table = {}
    for E, colour in zip(exponents, matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, len(exponents))), strict=True):
        q = p.with_(E=E).parameters
        table[E] = np.array([foam_factor(q, float(x), 1.0) for x in share])
        ax.plot(share, table[E], color=colour, lw=1.6, label=f"E = {E:g}")
    ax.set(xlabel="oil share of the foam $p_{oil}$ [1]", ylabel="force relative to oil [1]")
    ax.legend(fontsize=9, frameon=False)
    linear = float(np.abs(table[1.0] - share).max())
    falls = all((table[b] <= table[a] + ROUNDING).all() for a, b in itertools.pairwise(exponents))
    return Plot(
        18,
        "Depiction of the foaming model (B = 1)",
        figure,
        (
            Statement(
                "an exponent E of one is linear in the oil share; a higher one lowers the foam's force progressively",
                "Section 3.2, equation 36, Figure 18",
                linear < ROUNDING and falls,
                {"largest_deviation_from_linear_at_E_1": linear, "falls_with_E": falls, "exponents": exponents},
                "consistency",
            ),
        ),
        remarks=(
            "The exponents are chosen over the range of Table 9 (0.41 to 92.38); the text does not name those of the "
            "figure.",
        ),
    )
