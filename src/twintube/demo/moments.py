"""Close-ups of a ride in which the damping is lost: before, during and after the loss."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from twintube.common.arrays import Array
from twintube.demo import messages
from twintube.demo.ride import EVERY, Ride
from twintube.demo.style import conditions, save
from twintube.report.common.framed import INTACT, OTHER, WIDTH, oil, worn
from twintube.report.common.style import PHASES, canvas, title
from twintube.rig.signals import FASTEST
from twintube.vehicle.ride import SETTLED, WINDOW

SPAN = 2.0  # [s] that a moment shows
FIRST = 2.0  # [s] after the road has faded in
MEAN = 5  # spans over which the damper's power is averaged
NAMES = ("before", "during", "after")  # the loss
THIN = 0.8  # [points], of lines that cross often
CHAMBERS = ("rebound", "compression", "reserve")


@dataclass(frozen=True)
class Moment:
    """A time span of a ride [s] and the damper's power in it relative to the intact damper [1]."""

    name: str
    start: float
    power_share: float

    @property
    def label(self) -> str:
        """For a title."""
        return f"{self.name} the loss, {self.start:.0f} to {self.start + SPAN:.0f} s"

    def inside(self, time: Array) -> Any:
        """Which of the times (n,) [s] lie in it."""
        return (time >= self.start) & (time < self.start + SPAN)


def shares(ride: Ride, intact: Ride) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Power relative to the intact damper [1] in spans of SPAN seconds from FIRST on, averaged over MEAN spans."""
    marks = np.arange(FIRST, ride.time[-1], SPAN)
    works = [np.diff(np.interp(marks, run.time, run.work)) for run in (ride, intact)]
    weights = np.ones(MEAN)
    mean = [np.convolve(work, weights, "same") for work in works]
    share: np.ndarray[Any, np.dtype[np.float64]] = mean[0] / mean[1]
    return share


def moments(ride: Ride, intact: Ride) -> list[Moment]:
    """Before, during (power half-way between its first and last value) and after the loss."""
    share = shares(ride, intact)
    first, last = float(share[:MEAN].max()), float(share[-MEAN:].mean())
    below = np.flatnonzero(share < 0.5 * (first + last))
    middle = int(below[0]) if len(below) else len(share) // 2
    positions = (0, min(max(middle, 1), len(share) - 2), len(share) - 1)
    return [Moment(name, FIRST + i * SPAN, float(share[i])) for name, i in zip(NAMES, positions, strict=True)]


def loops(folder: Path, result: dict[str, Any], ride: Ride, intact: Ride, when: list[Moment]) -> Path:
    """F-s and F-v diagrams at the three moments, with the intact damper on the same stretch of road."""
    figure, axes = canvas(2, len(when), (WIDTH, 5.0), sharey=True, sharex="row")
    for column, moment in enumerate(when):
        inside = moment.inside(ride.time)
        for run, colour, text in both(ride, intact):
            axes[0][column].plot(run.stroke[inside] * 1e3, run.force[inside] / 1e3, color=colour, lw=THIN, label=text)
            axes[1][column].plot(run.velocity[inside], run.force[inside] / 1e3, ".", color=colour, ms=2)
        for end in (-FASTEST, FASTEST):
            axes[1][column].axvline(end, color=OTHER, lw=1, ls=":")
        title(axes[0][column], f"{moment.label}:\n{100 * moment.power_share:.0f} % of the power")
        axes[0][column].set_xlabel("damper stroke [mm]")
        axes[1][column].set_xlabel("damper velocity [m/s]")
    for row in axes:
        row[0].set_ylabel("damper force [kN]")
    told = (
        f"Power: mean of {MEAN * SPAN:.0f} s over that of the intact damper on the same road. Rebound is positive. "
        f"Dotted: {FASTEST:g} m/s, where the paper's measurements end; beyond it the F-v curve goes on along its last slope."
    )
    sentence = messages.loops([moment.power_share for moment in when], where(result, ride))
    return save(figure, folder, "loops.png", sentence, conditions(result, told), key=axes[0][0])


def both(ride: Ride, intact: Ride) -> tuple[tuple[Ride, str, str], ...]:
    """The rides of both dampers with colour and name, the intact one below."""
    return (intact, INTACT, "intact"), (ride, worn(ride.case.oil_level), oil(ride.case.oil_level))


def where(result: dict[str, Any], ride: Ride) -> str:
    """Of which damper and ride a sentence speaks."""
    return f"{result['damper']} with {oil(ride.case.oil_level)} at {ride.case.speed_kmh:.0f} km/h"


def volumes(folder: Path, result: dict[str, Any], ride: Ride) -> Path:
    """Phase volumes of the three chambers over the whole ride, means of 1 s."""
    time = ride.time[::EVERY]
    figure, axes = canvas(len(CHAMBERS), 1, (WIDTH, 5.2), sharex=True)
    seconds = np.arange(0, time[-1])
    means = np.array([ride.volumes[(time >= t) & (time < t + 1)].mean(axis=0) for t in seconds]) * 1e6
    for first, (chamber, (ax,)) in zip((0, 3, 6), zip(CHAMBERS, axes, strict=True), strict=True):
        phases = {"oil": means[:, first], "foam": means[:, first + 2], "gas": means[:, first + 1]}
        ax.stackplot(seconds + 0.5, *phases.values(), colors=[PHASES[p] for p in phases], labels=list(phases), lw=0)
        title(ax, f"{chamber} chamber")
        ax.set_ylabel("volume [mL]")
        ax.set_xlim(0, time[-1])
        ax.grid(visible=False)
    axes[-1][0].set_xlabel("time of the ride [s], means of 1 s")
    spans = (time < WINDOW, time >= time[-1] - WINDOW)
    filled = [ride.volumes[span][:, :6].sum(axis=0) for span in spans]
    at_first, at_last = (float(1 - volume[[0, 3]].sum() / volume.sum()) for volume in filled)
    told = "Volumes of oil, foam and gas in the three chambers."
    sentence = messages.volumes((at_first, at_last), where(result, ride))
    return save(figure, folder, "volumes.png", sentence, conditions(result, told), key=axes[0][0])


def wheel_load(folder: Path, result: dict[str, Any], ride: Ride, intact: Ride, when: list[Moment]) -> Path:
    """Wheel load at the three moments, with the intact damper on the same stretch of road."""
    figure, axes = canvas(len(when), 1, (WIDTH, 5.6), sharey=True)
    for (ax,), moment in zip(axes, when, strict=True):
        inside = moment.inside(ride.time)
        for run, colour, text in both(ride, intact):
            ax.plot(
                run.time[inside], run.wheel_load[inside] / 1e3, color=colour, lw=THIN if run is intact else 1.4, label=text
            )
        ax.fill_between(ride.time[inside], 0, 1, where=ride.wheel_load[inside] <= 0, color=worn(ride.case.oil_level),
                        alpha=0.25, lw=0, transform=ax.get_xaxis_transform(), label="off the road")  # fmt: skip
        ax.axhline(result["static_wheel_load_N"] / 1e3, color=OTHER, lw=1, label="static load")
        title(ax, moment.label)
        ax.set_ylabel("wheel load [kN]")
        ax.set_xlim(moment.start, moment.start + SPAN)
    axes[-1][0].set_xlabel("time of the ride [s]")
    lossy, new = (float((run.wheel_load[run.time >= SETTLED] <= 0.0).mean()) for run in (ride, intact))
    told = f"Three spans of {SPAN:.0f} s: the load of the wheel on the same road with both dampers."
    sentence = messages.off_road((lossy, new), where(result, ride))
    return save(figure, folder, "wheel_load.png", sentence, conditions(result, told), key=axes[0][0])
