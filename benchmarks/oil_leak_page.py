"""The prediction of an oil leak as figures, tables in Markdown and a picture."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from benchmarks.oil_leak import (
    FALLS,
    FAST,
    REACH,
    SLOW,
    dead_lengths,
    fast_falls,
    first,
    force_left,
    levels,
    slow_falls,
    with_valves_of,
)
from twintube.common.files import write_bytes, write_text
from twintube.dampers import Damper, freed_gas, load
from twintube.dampers.toml import names
from twintube.engine.simulate import simulate
from twintube.report.common.framed import OIL, SCALAR, WIDTH, WORDS, framed, oil
from twintube.report.common.style import ORANGE, VIOLET, canvas, label, png, title
from twintube.rig import harmonic_block

DRAWN = 0.025  # [m] amplitude of the picture
MISSING = (-0.5, 0.2, 0.4, 0.6, 1.1)  # of its loops, over A_2 times the amplitude
DIRECTIONS = ("rebound", "compression")
GONE = 1.1  # largest (V_c - oil) / (A_2 a) of the slow table, and a step of its grid


def bench_oil_leak(file: Path | None = None, plot: Path | None = None, tables: Path | None = None) -> dict[str, Any]:
    """Where the force falls, for the paper's eight dampers or for that of a parameter file.

    Figures: `slow`, oil missing below V_c over A_2 times the amplitude [1]; `fast`, oil levels [1]; `volumes` [mL].
    """
    dampers = [load(name) for name in names()] if file is None else [load(file)]
    figures = {
        "slow": slow_figures(dampers),
        "fast": {damper.name: fast_row(damper) for damper in dampers},
        "volumes": {damper.name: volume_row(damper) for damper in dampers},
    }
    if tables is not None:
        write_text(tables, markdown(figures))
    if plot is not None:
        draw(dampers[-1], dampers if file is None else [with_valves_of(dampers[0], name) for name in names()], plot)
    return figures


def slow_figures(dampers: list[Damper]) -> dict[str, dict[str, float]]:
    """Least and most missing oil by stroke, direction and fall, over all dampers, dead lengths and valves."""
    found: dict[str, list[float]] = {}
    for damper in dampers:
        for amplitude, cases in slow_falls(damper).items():
            for (direction, fall), value in ((key, value) for case in cases for key, value in case.items()):
                found.setdefault(f"{2e3 * amplitude:g} mm, {direction}, {fall:.0%}", []).append(value)
    return {key: {"least": min(values), "most": max(values)} for key, values in found.items()}


def fast_row(damper: Damper) -> dict[str, float]:
    """Highest and lowest oil level [1] at which one of the directions has lost a tenth or half of its force."""
    cases = fast_falls(damper)
    row: dict[str, float] = {}
    for fall in FALLS:
        found = [case[direction, fall] for case in cases for direction in DIRECTIONS]
        row |= {f"highest {fall:.0%}": max(found), f"lowest {fall:.0%}": min(found)}
    return row


def volume_row(damper: Damper) -> dict[str, float]:
    """Intact oil, V_c with the shortest and the longest dead length, and the oil of a half stroke of DRAWN [mL]."""
    short, long = (levels(item) for item in dead_lengths(damper))
    return {
        "intact oil": short.intact * 1e6,
        "V_c, shortest": short.full * 1e6,
        "V_c, longest": long.full * 1e6,
        "half stroke": short.swept * DRAWN * 1e6,
    }


def markdown(figures: dict[str, Any]) -> str:
    """The tables of the page."""
    return "\n".join([*by_stroke(figures["slow"]), "", *builds(figures["volumes"], figures["fast"])]) + "\n"


def by_stroke(slow: dict[str, dict[str, float]]) -> list[str]:
    """The table of the missing oil: a row for direction and fall, a column for every stroke."""
    rows: dict[str, list[str]] = {}
    strokes = dict.fromkeys(key.split(", ", 1)[0] for key in slow)
    for key, row in slow.items():
        rows.setdefault(key.split(", ", 1)[1], []).append(f"{row['least']:.1f} to {row['most']:.1f}")
    head = ["(V_c - oil) / (A_2 a) where the force has fallen by", *(f"stroke {name}" for name in strokes)]
    return [f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *([key, *row] for key, row in rows.items()))]


def builds(volumes: dict[str, dict[str, float]], fast: dict[str, dict[str, float]]) -> list[str]:
    """The table by damper: oil levels between which the force falls, at both velocities."""
    head = [
        f"| damper | intact oil | V_c | whole down to | gone below | half gone at {FAST:g} m/s |",
        "|---|---|---|---|---|---|",
    ]
    return head + [build(name, row, fast[name]) for name, row in volumes.items()]


def build(name: str, volumes: dict[str, float], fast: dict[str, float]) -> str:
    """A row of `builds`; V_c of the shortest dead length is the largest."""
    intact, most, least = volumes["intact oil"], volumes["V_c, shortest"], volumes["V_c, longest"]
    gone = (least - GONE * volumes["half stroke"]) / intact
    return (
        f"| {name} | {intact:.0f} mL | {least:.0f} to {most:.0f} mL | {most / intact:.0%} | {gone:.0%} "
        f"| {fast['highest 50%']:.0%} to {fast['lowest 50%']:.0%} |"
    )


def draw(damper: Damper, others: list[Damper], path: Path) -> None:
    """F-s loops, the force at the largest velocity over the oil level, and over the missing oil for all `others`."""
    figure, axes = canvas(3, 1, (WIDTH, 7.2))
    loops(axes[0][0], damper)
    halves = over_level(axes[1][0], damper)
    over_missing(axes[2][0], others)
    told = (
        f"{damper.name} without gas pressure, stroke {2e3 * DRAWN:g} mm, 19th oscillation. Rebound is positive. "
        "Missing oil: what the working chambers lack, over bore area times amplitude."
    )
    most, least = (f"{100 * level:.0f}" for level in (max(halves), min(halves)))
    lost = f"{damper.name} loses half of its force only at {most} to {least} % oil"
    sentence = f"At {SLOW:g} m/s {lost}, by dead length and direction"
    framed(figure, sentence, told, "Assumed: F-v curve, friction, stroke, velocity and dead length.")
    write_bytes(path, png(figure))


def loops(ax: Axes, damper: Damper) -> None:
    """Force over stroke of the last oscillation at some oil volumes."""
    volumes, block = levels(damper), harmonic_block(SLOW, DRAWN)
    last = slice(block.marks[-2], block.marks[-1] + 1)
    for i, share in enumerate(MISSING):
        level, colour = volumes.oil_level(share, DRAWN), OIL(i / (len(MISSING) - 1))
        worn = freed_gas.condition(damper, level, 0)
        force = simulate(worn, block.stroke, block.velocity, block.time).force
        ax.plot(1e3 * block.stroke[last], force[last], color=colour, label=oil(level))
    title(ax, "force over stroke")
    label([[ax]], "stroke [mm]", "force [N]")
    beside(ax)


def beside(ax: Axes) -> None:
    """The key right of the axes."""
    ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=WORDS, frameon=False)


def over_level(ax: Axes, damper: Damper) -> list[float]:
    """Force at the largest velocity over the oil level, for both ends of the dead length, and a scalar factor.

    Returns the oil levels [1] at which half of it is lost.
    """
    at = np.arange(100, 19, -1) / 100
    halves = []
    for item, dashes in zip(dead_lengths(damper), ("-", "--"), strict=True):
        left = np.array([force_left(item, level, SLOW, DRAWN, freed_gas.DEFAULT) for level in at.tolist()])
        halves += [fallen for (_, fall), fallen in first(at, left, never=0.0).items() if fall == max(FALLS)]
        for column, colour, direction in zip(left.T, (VIOLET, ORANGE), DIRECTIONS, strict=True):
            length = f"dead length {1e3 * item.parameters.dead_length:g} mm"
            ax.plot(100 * at, column, dashes, color=colour, label=f"{direction}, {length}")
    ax.plot(100 * at, at, ":", color=SCALAR, label="scalar factor")
    ax.invert_xaxis()
    title(ax, "force at the largest velocity over the oil level")
    label([[ax]], "oil level [%]", "force over intact [1]")
    beside(ax)
    return halves


def over_missing(ax: Axes, dampers: list[Damper]) -> None:
    """The same over the oil that is missing in the working chambers, for several builds."""
    for number, damper in enumerate(dampers):
        volumes = levels(damper)
        volume = [volumes.oil_level(share, DRAWN) for share in REACH.tolist()]
        left = np.array([force_left(damper, level, SLOW, DRAWN, freed_gas.DEFAULT) for level in volume])
        for column, colour, direction in zip(left.T, (VIOLET, ORANGE), DIRECTIONS, strict=True):
            ax.plot(REACH, column, color=colour, alpha=0.6, label=direction if number == 0 else None)
    title(ax, f"the same over the missing oil, {len(dampers)} dampers")
    label([[ax]], "missing oil: (V_c - oil) / (A_2 amplitude) [1]", "force over intact [1]")
    beside(ax)
