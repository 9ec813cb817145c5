"""A record as simulated against the record as measured: figures and a picture."""

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from twintube.common.arrays import Array
from twintube.data.check.defects import cycle_starts
from twintube.report.common.style import GREY, INK, RED, canvas, legend_above, plain, title

MOST_POINTS = 200_000  # of a line in the picture


@dataclass(frozen=True)
class Deviation:
    """Simulation against measurement, over the usable samples; the works over full cycles."""

    rmse: float  # [N]
    peak: float  # largest measured force, without sign [N]
    mean: float  # simulated less measured [N]: the load cell's zero, or the gas force
    cycles: int
    measured_work: float  # [J] per cycle, 0 without a full one
    simulated_work: float  # [J] per cycle

    @property
    def sentence(self) -> str:
        """Two sentences for the terminal."""
        text = (
            f"measured against simulated: {self.rmse:.1f} N RMSE, {self.rmse / self.peak:.1%} of the peak of "
            f"{self.peak:.0f} N; the simulation's mean is {self.mean:+.1f} N off"
        )
        if not self.cycles:
            return text + "\nno full cycle: no work per cycle"
        share = f", {self.simulated_work / self.measured_work - 1:+.1%}" if self.measured_work > 0 else ""
        return text + (
            f"\nwork per cycle: measured {self.measured_work:.2f} J, simulated {self.simulated_work:.2f} J{share} "
            f"(mean of {self.cycles})"
        )


def deviation(stroke: Array, measured: Array, simulated: Array, usable: NDArray[np.bool_]) -> Deviation:
    """Of a simulated force (n,) [N] from the measured one; the stroke [m] gives the cycles."""
    rest = (simulated - measured)[usable]
    starts = cycle_starts(stroke)
    steps = np.diff(stroke) * (usable[1:] & usable[:-1])  # samples that say nothing do no work in either

    def work(force: Array) -> float:
        done = np.append(0.0, np.cumsum((force[1:] + force[:-1]) / 2 * steps))
        return float(done[starts[-1]] - done[starts[0]]) / (len(starts) - 1) if len(starts) > 1 else 0.0

    return Deviation(
        rmse=float(np.sqrt(np.mean(rest**2))),
        peak=float(np.abs(measured[usable]).max()),
        mean=float(rest.mean()),
        cycles=max(len(starts) - 1, 0),
        measured_work=work(measured),
        simulated_work=work(simulated),
    )


def figure(
    name: str,
    time: Array | None,
    stroke: Array,
    velocity: Array,
    *,
    simulated: Array,
    measured: Array | None,
    usable: NDArray[np.bool_],
) -> Figure:
    """Force over stroke, over velocity and, where there are times, over time with the stroke; SI arrays (n,)."""
    drawn, axes = canvas(2, 1 if time is None else 2, (5.5 if time is None else 11.0, 7.2))
    over_stroke, over_velocity = axes[:, -1]
    thin = slice(None, None, max(1, len(stroke) // MOST_POINTS))
    panels = [
        (over_stroke, 1e3 * stroke, "Force over stroke", "stroke [mm]"),
        (over_velocity, velocity, "Force over velocity", "velocity [m/s]"),
    ]
    if time is not None:
        over_time, forces = axes[:, 0]
        over_time.plot(time[thin], 1e3 * stroke[thin], color=GREY, lw=1)
        title(over_time, plain(name))
        over_time.set(xlabel="time [s]", ylabel="stroke [mm]")
        over_time.sharex(forces)
        panels.append((forces, time, "Force over time", "time [s]"))
    curves = [(simulated, RED, "simulated")]
    if measured is not None:
        curves.insert(0, (np.where(usable, measured, np.nan), INK, "measured"))
    for ax, x, text, label_x in panels:
        for force, colour, label in curves:
            ax.plot(x[thin], force[thin], color=colour, lw=0.8, alpha=0.8, label=label)
        title(ax, text)
        ax.set(xlabel=label_x, ylabel="force [N]")
    if measured is not None:
        legend_above(drawn, over_stroke)
    return drawn
