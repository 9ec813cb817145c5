"""Pictures of the rides."""

from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy import signal

from twintube.parameters import Damper
from vehicle_demo.ride import EVERY, Ride

FOOTNOTE = "F-v curve, friction, gas spring, chamber dead length and vehicle are assumed (unpublished)"
PHASES = {"oil": "#c98b1f", "foam": "#f0d9a8", "gas": "#cfe0ee"}
SHOWN = (0.9, 0.6, 0.4)  # oil levels that the line plots show beside the intact damper
COLOURS = ("#1b1b1b", "#2a7f9e", "#d98c21", "#b3282d")

plt.rcParams |= {
    "axes.grid": True,
    "grid.alpha": 0.3,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "font.size": 10,
    "figure.dpi": 110,
    "savefig.dpi": 130,
    "legend.frameon": False,
}


def name_of(ride: Ride) -> str:
    """`intact` or the oil level."""
    return "intact" if ride.case.gas_preload else f"{ride.case.oil_level:.0%} oil"


def chosen(rides: list[Ride], speed: float) -> list[tuple[Ride, str]]:
    """The rides that line plots show, with their colours."""
    full = [r for r in rides if r.case.speed_kmh == speed and not r.case.scalar and not r.case.off]
    found = [r for r in full if r.case.gas_preload] + [r for r in full if r.case.oil_level in SHOWN]
    return list(zip(found, COLOURS, strict=False))


def save(figure: Figure, folder: Path, name: str, title: str) -> Path:
    """Title and footnote onto the figure, then to a file."""
    figure.suptitle(title, x=0.01, ha="left", fontsize=12)
    figure.text(0.01, 0.005, FOOTNOTE, fontsize=7, color="#777")
    figure.tight_layout(rect=(0, 0.02, 1, 0.97))
    path = folder / name
    figure.savefig(path)
    plt.close(figure)
    return path


def wheel_load(folder: Path, label: str, rides: list[Ride], static: float) -> Path:
    """Wheel load over time at the higher speed, in the last seconds of the ride."""
    shown = chosen(rides, max(r.case.speed_kmh for r in rides))
    figure, axes = plt.subplots(len(shown), 1, figsize=(9, 7), sharex=True, sharey=True)
    for (ride, colour), ax in zip(shown, axes, strict=True):
        late = ride.time >= ride.time[-1] - 4
        ax.plot(ride.time[late], ride.wheel_load[late] / 1e3, color=colour, lw=0.9)
        ax.fill_between(
            ride.time[late],
            0,
            1,
            where=ride.wheel_load[late] <= 0,
            color="#b3282d",
            alpha=0.25,
            lw=0,
            transform=ax.get_xaxis_transform(),
        )
        ax.axhline(static / 1e3, color="#999", lw=0.8, ls="--")
        ax.set_title(name_of(ride), loc="left", fontsize=10)
        ax.set_ylabel("wheel load [kN]")
    axes[-1].set_xlabel("time [s]   (dashed: static load, shaded: wheel off the road)")
    return save(figure, folder, "wheel_load.png", f"Wheel load, {label}")


def spectrum(folder: Path, label: str, rides: list[Ride]) -> Path:
    """Power spectral density of the wheel load."""
    figure, ax = plt.subplots(figsize=(9, 5))
    for ride, colour in chosen(rides, max(r.case.speed_kmh for r in rides)):
        rate = 1 / ride.time[1]
        f, density = signal.welch(ride.wheel_load[ride.time > 5], rate, nperseg=int(8 * rate))
        band = (f > 0.3) & (f < 40)
        ax.loglog(f[band], density[band], color=colour, label=name_of(ride))
    ax.set_xlabel("frequency [Hz]")
    ax.set_ylabel("wheel load density [N²/Hz]")
    ax.legend()
    return save(figure, folder, "spectrum.png", f"Spectrum of the wheel load, {label}")


def dlc(folder: Path, name: str, result: dict[str, Any]) -> Path:
    """Dynamic load coefficient over the oil level, full model and scalar factor."""
    figure, ax = plt.subplots(figsize=(9, 5))
    for block, colour in zip(result["speeds"], ("#2a7f9e", "#b3282d"), strict=True):
        levels = [100 * e["oil_level"] for e in block["oil_levels"]]
        speed = f"{block['speed_kmh']:.0f} km/h"
        ax.plot(levels, [e["dlc"] for e in block["oil_levels"]], "o-", color=colour, label=f"{speed}, full model")
        ax.plot(
            levels,
            [e["scalar_factor"]["dlc"] for e in block["oil_levels"]],
            "s:",
            color=colour,
            mfc="white",
            label=f"{speed}, scalar factor (variant 1)",
        )
        if result["effects"]:
            plain = [e["without_effects"]["dlc"] for e in block["oil_levels"]]
            ax.plot(
                levels, plain, "^--", color=colour, mfc="white", label=f"{speed}, without {' and '.join(result['effects'])}"
            )
        ax.axhline(block["intact"]["dlc"], color=colour, lw=0.8, ls="--", label=f"{speed}, intact")
    ax.set_xlabel("oil level [%], gas preload lost")
    ax.set_ylabel("dynamic load coefficient [1]")
    ax.set_ylim(bottom=0)
    ax.invert_xaxis()
    ax.legend(ncols=2, fontsize=9)
    return save(figure, folder, "dlc_over_oil_level.png", f"Wheel-load fluctuation over oil loss, {name}, class D road")


def development(folder: Path, name: str, result: dict[str, Any]) -> Path:
    """How the coefficient and the damper's work develop during the ride."""
    figure, axes = plt.subplots(2, len(result["speeds"]), figsize=(10, 6.5), sharex=True, sharey="row")
    for column, block in enumerate(result["speeds"]):
        entries = [block["intact"]] + [e for e in block["oil_levels"] if e["oil_level"] in SHOWN]
        for entry, colour in zip(entries, COLOURS, strict=True):
            middle = [(w["from_s"] + w["to_s"]) / 2 for w in entry["development"]]
            label = "intact" if entry["gas_preload"] else f"{entry['oil_level']:.0%} oil"
            axes[0][column].plot(middle, [w["dlc"] for w in entry["development"]], "o-", color=colour, label=label)
            power = [w["damping_work_J"] / (w["to_s"] - w["from_s"]) for w in entry["development"]]
            axes[1][column].plot(middle, power, "o-", color=colour)
        axes[0][column].set_title(f"{block['speed_kmh']:.0f} km/h", loc="left", fontsize=10)
        axes[1][column].set_xlabel("time [s], windows of 10 s")
    axes[0][0].set_ylabel("dynamic load coefficient [1]")
    axes[1][0].set_ylabel("damping power [W]")
    for ax in axes.flat:
        ax.set_ylim(bottom=0)
    axes[0][0].legend(fontsize=9)
    return save(figure, folder, "development.png", f"Development during the ride, {name}, class D road")


def loops(folder: Path, label: str, rides: list[Ride]) -> Path:
    """F-s and F-v diagrams, five seconds at the start and at the end of the ride."""
    shown = chosen(rides, max(r.case.speed_kmh for r in rides))
    figure, axes = plt.subplots(2, len(shown), figsize=(11, 6.3), sharey=True, sharex="row")
    for column, (ride, colour) in enumerate(shown):
        end = ride.time[-1]
        for start, ink, order, text in ((2.0, "#b9c4cc", 1, "2-7 s"), (end - 5, colour, 2, f"{end - 5:.0f}-{end:.0f} s")):
            part = (ride.time >= start) & (ride.time < start + 5)
            axes[0][column].plot(
                ride.stroke[part] * 1e3, ride.force[part] / 1e3, color=ink, lw=0.6, zorder=order, label=text
            )
            axes[1][column].plot(ride.velocity[part], ride.force[part] / 1e3, ".", color=ink, ms=1.5, zorder=order)
        axes[0][column].set_title(name_of(ride), loc="left", fontsize=10)
        axes[0][column].set_xlabel("stroke [mm]")
        axes[1][column].set_xlabel("velocity [m/s]")
        axes[0][column].legend(fontsize=8, loc="upper left")
    for row in axes:
        row[0].set_ylabel("damper force [kN]")
    return save(figure, folder, "loops.png", f"Damper force over stroke and velocity, {label}")


def stack(ax: Axes, time: Any, volumes: Any, chamber: int) -> None:
    """Phases of a chamber, stacked [mL]."""
    first = 3 * (chamber - 1)
    phases = {"oil": volumes[:, first], "foam": volumes[:, first + 2], "gas": volumes[:, first + 1]}
    ax.stackplot(time, *(v * 1e6 for v in phases.values()), colors=[PHASES[p] for p in phases], labels=list(phases), lw=0)
    ax.grid(False)


def volumes(folder: Path, label: str, rides: list[Ride]) -> Path:
    """Phase volumes of the three chambers: the first two seconds and the whole ride, 60 % oil."""
    speed = max(r.case.speed_kmh for r in rides)
    ride = next(r for r in rides if r.case == type(r.case)(speed, 0.6, 0))
    time = ride.time[::EVERY]
    figure, axes = plt.subplots(3, 2, figsize=(10, 7), sharey="row")
    for chamber, (title, row) in enumerate(zip(("V1 rebound", "V2 compression", "V3 reserve"), axes, strict=True), start=1):
        early = time < 3
        stack(row[0], time[early], ride.volumes[early], chamber)
        means = np.array([ride.volumes[(time >= t) & (time < t + 1)].mean(axis=0) for t in np.arange(0, time[-1])])
        stack(row[1], np.arange(len(means)) + 0.5, means, chamber)
        row[0].set_ylabel(f"{title} [mL]")
    axes[0][0].set_title("first 3 s", loc="left", fontsize=10)
    axes[0][1].set_title("whole ride, means over 1 s", loc="left", fontsize=10)
    axes[0][1].legend(*axes[0][0].get_legend_handles_labels(), ncols=3, loc="upper right", fontsize=9, frameon=True)
    for ax in axes[-1]:
        ax.set_xlabel("time [s]")
    return save(figure, folder, "volumes.png", f"Oil, foam and gas at 60 % oil, {label}")


def draw(folder: Path, damper: Damper, rides: list[Ride], result: dict[str, Any]) -> list[Path]:
    """All pictures, as PNG files in `folder`."""
    label = f"{damper.name}, {max(r.case.speed_kmh for r in rides):.0f} km/h on a class D road"
    return [
        dlc(folder, damper.name, result),
        wheel_load(folder, label, rides, result["static_wheel_load_N"]),
        spectrum(folder, label, rides),
        development(folder, damper.name, result),
        loops(folder, label, rides),
        volumes(folder, label, rides),
    ]
