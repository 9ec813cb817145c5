"""Close-ups of a ride in which the damping is lost: before, while and after the loss."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from twintube.demo.ride import EVERY, Ride
from twintube.demo.style import INTACT, PHASES, SCALAR, save

SPAN = 2.0  # [s] that a moment shows
FIRST = 2.0  # [s] after the road has faded in
MEAN = 5  # spans over which the damper's power is averaged
COLOURS = ("#2a7f9e", "#d98c21", "#b3282d")
NAMES = ("before", "while", "after")


@dataclass(frozen=True)
class Moment:
    """A time span of a ride [s] and the damper's power in it relative to the intact damper [1]."""

    name: str
    start: float
    power_share: float

    @property
    def label(self) -> str:
        """For a title."""
        return f"{self.name}: {self.start:.0f}-{self.start + SPAN:.0f} s"


def shares(ride: Ride, intact: Ride) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Power relative to the intact damper [1] in spans of SPAN seconds from FIRST on, averaged over MEAN spans."""
    marks = np.arange(FIRST, ride.time[-1], SPAN)
    works = [np.diff(np.interp(marks, run.time, run.work)) for run in (ride, intact)]
    weights = np.ones(MEAN)
    mean = [np.convolve(work, weights, "same") for work in works]
    share: np.ndarray[Any, np.dtype[np.float64]] = mean[0] / mean[1]
    return share


def moments(ride: Ride, intact: Ride) -> list[Moment]:
    """Before, while (power half-way between its first and last value) and after the loss."""
    share = shares(ride, intact)
    first, last = float(share[:MEAN].max()), float(share[-MEAN:].mean())
    below = np.flatnonzero(share < 0.5 * (first + last))
    middle = int(below[0]) if len(below) else len(share) // 2
    positions = (0, min(max(middle, 1), len(share) - 2), len(share) - 1)
    return [Moment(name, FIRST + i * SPAN, float(share[i])) for name, i in zip(NAMES, positions, strict=True)]


def loops(folder: Path, label: str, ride: Ride, intact: Ride, when: list[Moment]) -> Path:
    """F-s and F-v diagrams at the three moments, with the intact damper on the same stretch of road."""
    figure, axes = plt.subplots(2, len(when), figsize=(11, 6.3), sharey=True, sharex="row")
    for column, (moment, colour) in enumerate(zip(when, COLOURS, strict=True)):
        inside = (ride.time >= moment.start) & (ride.time < moment.start + SPAN)
        for run, ink, text in ((intact, SCALAR, "intact"), (ride, colour, f"{100 * ride.case.oil_level:.0f} % oil")):
            axes[0][column].plot(run.stroke[inside] * 1e3, run.force[inside] / 1e3, color=ink, lw=0.8, label=text)
            axes[1][column].plot(run.velocity[inside], run.force[inside] / 1e3, ".", color=ink, ms=1.5)
        power = f"{100 * moment.power_share:.0f} % of the intact power"
        axes[0][column].set_title(f"{moment.label}, {power}", loc="left", fontsize=9)
        axes[0][column].set_xlabel("damper stroke [mm]")
        axes[1][column].set_xlabel("damper velocity [m/s]")
        axes[0][column].legend(fontsize=8, loc="upper left")
    for row in axes:
        row[0].set_ylabel("damper force [kN]")
    return save(figure, folder, "loops.png", f"Damper force before, while and after the damping is lost, {label}")


def stack(ax: Axes, time: Any, volumes: Any, chamber: int) -> None:
    """Phases of a chamber, stacked [mL]."""
    first = 3 * (chamber - 1)
    phases = {"oil": volumes[:, first], "foam": volumes[:, first + 2], "gas": volumes[:, first + 1]}
    ax.stackplot(time, *(v * 1e6 for v in phases.values()), colors=[PHASES[p] for p in phases], labels=list(phases), lw=0)
    ax.grid(False)


def volumes(folder: Path, label: str, ride: Ride, when: list[Moment]) -> Path:
    """Phase volumes of the three chambers at the moments and over the whole ride."""
    time = ride.time[::EVERY]
    figure, axes = plt.subplots(3, len(when) + 1, figsize=(12, 7), sharey="row")
    seconds = np.arange(0, time[-1])
    means = np.array([ride.volumes[(time >= t) & (time < t + 1)].mean(axis=0) for t in seconds])
    for chamber, (title, row) in enumerate(zip(("V1 rebound", "V2 compression", "V3 reserve"), axes, strict=True), start=1):
        for ax, moment in zip(row, when, strict=False):
            inside = (time >= moment.start) & (time < moment.start + SPAN)
            stack(ax, time[inside], ride.volumes[inside], chamber)
        stack(row[-1], seconds + 0.5, means, chamber)
        row[0].set_ylabel(f"{title} [mL]")
    for ax, moment in zip(axes[0], when, strict=False):
        ax.set_title(moment.label, loc="left", fontsize=10)
    axes[0][-1].set_title("whole ride, means over 1 s", loc="left", fontsize=10)
    axes[0][-1].legend(*axes[0][0].get_legend_handles_labels(), ncols=3, loc="upper right", fontsize=8, frameon=True)
    for ax in axes[-1]:
        ax.set_xlabel("time [s]")
    return save(figure, folder, "volumes.png", f"Oil, foam and gas, {label}")


def wheel_load(folder: Path, label: str, ride: Ride, intact: Ride, when: list[Moment], static: float) -> Path:
    """Wheel load at the three moments, with the intact damper on the same stretch of road."""
    figure, axes = plt.subplots(len(when), 1, figsize=(9, 7), sharey=True)
    name = f"{100 * ride.case.oil_level:.0f} % oil"
    for ax, moment, colour in zip(axes, when, COLOURS, strict=True):
        inside = (ride.time >= moment.start) & (ride.time < moment.start + SPAN)
        ax.plot(intact.time[inside], intact.wheel_load[inside] / 1e3, color=INTACT, lw=0.8, alpha=0.6, label="intact")
        ax.plot(ride.time[inside], ride.wheel_load[inside] / 1e3, color=colour, lw=1.1, label=name)
        off = ride.wheel_load[inside] <= 0
        ax.fill_between(
            ride.time[inside], 0, 1, where=off, color="#b3282d", alpha=0.25, lw=0, transform=ax.get_xaxis_transform()
        )
        ax.axhline(static / 1e3, color="#999", lw=0.8, ls="--")
        ax.set_title(moment.label, loc="left", fontsize=10)
        ax.set_ylabel("wheel load [kN]")
        ax.legend(loc="upper right", ncols=2, fontsize=8)
    axes[-1].set_xlabel("time [s]   (dashed: static load, shaded: wheel off the road)")
    return save(figure, folder, "wheel_load.png", f"Wheel load before, while and after the damping is lost, {label}")
