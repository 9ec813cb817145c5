"""Pictures of all rides: wheel-load fluctuation over oil loss and over time, and its dependence on assumptions."""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from scipy import signal

from twintube.dampers.freed_gas import AS_PUBLISHED
from twintube.demo.bands import DEAD_LENGTH
from twintube.demo.ride import Ride
from twintube.demo.style import BAND, FULL, INTACT, LEVELS, PAPER, SCALAR, save
from twintube.vehicle.ride import SETTLED, WINDOW

TIMES = (0, 5, -1)  # windows for which the DLC over the oil level is shown
SHADES = ("#9ecae1", "#4292c6", "#084594")


def name_of(entry: dict[str, Any]) -> str:
    """`intact` or the oil level."""
    return "intact" if entry["gas_preload"] else f"{100 * entry['oil_level']:.0f} % oil"


def window_name(number: int) -> str:
    """The time span of a window."""
    return f"{number * WINDOW:.0f}-{(number + 1) * WINDOW:.0f} s"


def dlc(folder: Path, name: str, result: dict[str, Any]) -> Path:
    """DLC over the oil level in several windows, with bands over seeds, freed gas and dead length; the factor."""
    figure, axes = plt.subplots(1, len(result["speeds"]), figsize=(12, 5.4), sharey=True)
    length = next(key for key in result["speeds"][0]["intact"]["bands"]["assumed"] if key.startswith(DEAD_LENGTH))
    for ax, block in zip(axes, result["speeds"], strict=True):
        entries = block["oil_levels"]
        levels = [100 * e["oil_level"] for e in entries]
        low, high = zip(*(e["bands"]["freed_gas_ways"] for e in entries), strict=True)
        ax.fill_between(levels, low, high, color=BAND, alpha=0.35, lw=0, label="all ways of the freed gas, whole ride")
        low, high = np.sort([e["bands"]["assumed"][length] for e in entries], axis=1).T
        ax.fill_between(levels, low, high, fc="none", ec=PAPER, hatch="///", alpha=0.5, lw=0, label=f"{length}, whole ride")
        count = len(block["intact"]["dlc_window"])
        for number, colour in zip(sorted({i % count for i in TIMES}), SHADES, strict=False):
            values = [e["dlc_window"][number] for e in entries]
            ax.plot(levels, values, "o-", ms=4, color=colour, label=f"freed gas dissolves, {window_name(number)}")
        bare = [e["bands"]["freed_gas"][AS_PUBLISHED] for e in entries]
        ax.plot(levels, bare, "^--", ms=5, color=PAPER, mfc="white", label="freed gas stays (as published), whole ride")
        scalar = [e["scalar_factor"]["dlc"] for e in entries]
        ax.plot(levels, scalar, "s:", ms=5, color=SCALAR, mfc="white", label="scalar factor, whole ride")
        if result["effects"]:
            plain = [e["without_effects"]["dlc"] for e in entries]
            ax.plot(
                levels, plain, "d--", ms=5, color="#55a868", mfc="white", label=f"without {' and '.join(result['effects'])}"
            )
        low, high = block["intact"]["bands"]["seeds"]
        ax.axhspan(low, high, color=INTACT, alpha=0.15, lw=0)
        ax.axhline(block["intact"]["dlc"], color=INTACT, lw=0.9, ls="--", label="intact (shade: five roads)")
        ax.set_title(f"{block['speed_kmh']:.0f} km/h", loc="left", fontsize=11)
        ax.set_xlabel("oil level [%], gas preload lost")
        ax.invert_xaxis()
    axes[0].set_ylim(bottom=0)
    axes[0].set_ylabel("dynamic load coefficient [1]")
    axes[1].legend(fontsize=8, loc="lower right")
    return save(figure, folder, "dlc_over_oil_level.png",
                f"Wheel-load fluctuation over oil loss, {name}, class D road, {result['seconds']:.0f} s")  # fmt: skip


def development(folder: Path, name: str, result: dict[str, Any]) -> Path:
    """DLC and power of the damper over time, with the bare paper model dotted."""
    figure, axes = plt.subplots(2, len(result["speeds"]), figsize=(11, 7), sharex=True, sharey="row")
    for column, block in enumerate(result["speeds"]):
        entries = [block["intact"]] + [e for e in block["oil_levels"] if e["oil_level"] in LEVELS]
        for entry in entries:
            colour = INTACT if entry["gas_preload"] else LEVELS[entry["oil_level"]]
            middle = (np.arange(len(entry["dlc_window"])) + 0.5) * WINDOW
            for row, figure_name, scale in ((0, "dlc_window", 1.0), (1, "damping_work_window_J", 1 / WINDOW)):
                values = np.array(entry[figure_name]) * scale
                axes[row][column].plot(middle, values, "o-", ms=4, color=colour, label=name_of(entry))
                if "bare_paper_model" in entry:
                    bare = np.array(entry["bare_paper_model"][figure_name]) * scale
                    axes[row][column].plot(middle, bare, ":", color=colour, lw=1.4)
        axes[0][column].set_title(f"{block['speed_kmh']:.0f} km/h", loc="left", fontsize=11)
        axes[1][column].set_xlabel(f"time [s], windows of {WINDOW:.0f} s   (dotted: as published)")
    axes[0][0].set_ylabel("dynamic load coefficient [1]")
    axes[1][0].set_ylabel("power of the damper [W]")
    for ax in axes.flat:
        ax.set_ylim(bottom=0)
    axes[0][0].legend(fontsize=9, ncols=2, loc="lower right")
    return save(figure, folder, "development.png", f"Development during the ride, {name}, class D road")


def failure(folder: Path, name: str, result: dict[str, Any]) -> Path:
    """Time to failure over oil level and speed, for the most different ways of the freed gas."""
    table = result["time_to_failure"]
    figure, axes = plt.subplots(1, len(table["freed_gas_ways"]), figsize=(12, 4.4), sharey=True)
    for ax, (freed_gas, rows) in zip(axes, table["freed_gas_ways"].items(), strict=True):
        values = np.array([[np.nan if t is None else t for t in row] for row in rows], dtype=float)
        image = ax.imshow(values, cmap="RdYlGn", vmin=0, vmax=table["seconds"], aspect="auto")
        for i, row in enumerate(rows):
            for j, time in enumerate(row):
                ax.text(j, i, "-" if time is None else f"{time:.0f}", ha="center", va="center", fontsize=8)
        ax.set_xticks(range(len(table["oil_levels"])), [f"{100 * level:.0f}" for level in table["oil_levels"]])
        ax.set_yticks(range(len(table["speeds_kmh"])), [f"{speed:.0f}" for speed in table["speeds_kmh"]])
        ax.set_title(freed_gas.replace("_", " "), loc="left", fontsize=10)
        ax.set_xlabel("oil level [%]")
        ax.grid(False)
    axes[0].set_ylabel("speed [km/h]")
    figure.colorbar(image, ax=axes[-1], label="[s]")
    title = (f"Seconds until the damper does less than half of the intact damper's work, {name}, class D road "
             f"(-: not within {table['seconds']:.0f} s)")  # fmt: skip
    return save(figure, folder, "time_to_failure.png", title)


def rises(entry: dict[str, Any], intact: dict[str, Any]) -> dict[str, list[float]]:
    """Smallest and largest DLC relative to intact in the same car on the same road, by the varied assumption."""
    own = entry["dlc"] / intact["dlc"]
    bars = {"road: five seeds": list(entry["bands"]["seeds_over_intact"])}
    for text, key in (("half-life 6.1-10.2 s", "half_life"), ("freed gas", "freed_gas_ways")):
        bars[text] = [v / intact["dlc"] for v in entry["bands"][key]]
    for key, ends in entry["bands"]["assumed"].items():
        ratios = [v / w for v, w in zip(ends, intact["bands"]["assumed"][key], strict=True)]
        bars[key] = [min(*ratios, own), max(*ratios, own)]
    return bars


def bands(folder: Path, name: str, result: dict[str, Any]) -> Path:
    """Dependence of the rise of the DLC on the assumptions: one bar each."""
    block = result["speeds"][-1]
    entries = [e for e in block["oil_levels"] if e["oil_level"] in LEVELS]
    intact = block["intact"]
    figure, axes = plt.subplots(1, len(entries), figsize=(12, 4.6), sharey=True, sharex=True)
    for ax, entry in zip(axes, entries, strict=True):
        bars = rises(entry, intact)
        for i, (low, high) in enumerate(bars.values()):
            ax.barh(i, high - low, left=low, color=FULL, height=0.6)
        ax.plot([entry["dlc"] / intact["dlc"]] * 2, [-0.5, len(bars) - 0.5], color=PAPER, lw=1.0)
        ax.axvline(1.0, color=INTACT, lw=0.9, ls="--")
        ax.set_yticks(range(len(bars)), list(bars))
        ax.set_title(name_of(entry), loc="left", fontsize=10)
        ax.set_xlabel("DLC relative to intact [1]")
    axes[0].set_xlim(left=0.95)  # after all bars: it ends the scaling of the shared axis
    axes[0].invert_yaxis()
    return save(figure, folder, "bands.png", f"Sensitivity of the rise of the DLC, {name}, {block['speed_kmh']:.0f} km/h, "
                f"{result['seconds']:.0f} s (dashed: no rise, line: default)")  # fmt: skip


def spectrum(folder: Path, label: str, rides: list[Ride]) -> Path:
    """Power spectral density of the wheel load."""
    figure, ax = plt.subplots(figsize=(9, 5))
    for ride in rides:
        if not ride.case.gas_preload and ride.case.oil_level not in LEVELS:
            continue
        rate = 1 / ride.time[1]
        f, density = signal.welch(ride.wheel_load[ride.time > SETTLED], rate, nperseg=int(8 * rate))
        band = (f > 0.3) & (f < 40)
        colour = INTACT if ride.case.gas_preload else LEVELS[ride.case.oil_level]
        text = "intact" if ride.case.gas_preload else f"{ride.case.oil_level:.0%} oil"
        ax.loglog(f[band], density[band], color=colour, label=text)
    ax.set_xlabel("frequency [Hz]")
    ax.set_ylabel("wheel load density [N²/Hz]")
    ax.legend()
    return save(figure, folder, "spectrum.png", f"Spectrum of the wheel load, {label}, whole ride")
