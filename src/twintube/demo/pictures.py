"""Pictures of all rides: wheel-load fluctuation over oil loss and over time, and its dependence on assumptions."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MultipleLocator
from scipy import signal

from twintube.dampers.freed_gas import AS_PUBLISHED, DEFAULT, MEAN_RETURN
from twintube.demo import messages
from twintube.demo.ride import Ride
from twintube.demo.style import ALSO, LEVELS, conditions, drawn, name_of, save, settled
from twintube.report.common.framed import INTACT, OIL, SCALAR, SMALL, WIDTH, colour_of, name_lines, oil, worn
from twintube.report.common.style import canvas, plain, title
from twintube.vehicle.ride import FAILED, SETTLED, WINDOW

WAYS = {  # of the freed gas, as headings
    DEFAULT: f"Freed gas dissolves again,\nhalf of it in {MEAN_RETURN:.3g} s (default)",
    AS_PUBLISHED: "Freed gas stays gas\n(the paper's equations)",
    "pushes_oil": "Freed gas only pushes oil\ninto the reserve",
}
BAND = "Band: five roads, and each assumption at both ends, alone and the main ones together."
BETWEEN = 5.0  # [Hz], between the resonances of the body (1 to 2 Hz) and of the wheels (10 to 15 Hz) of cars
LOWEST, HIGHEST = 0.3, 40.0  # [Hz] of the spectrum: the body, the wheels, and what the road still holds
DARK = 0.5  # share of the colour on which white is read


def dlc(folder: Path, result: dict[str, Any]) -> Path:
    """DLC of the whole ride over the oil level in the band of all assumptions, beside intact and a scalar factor."""
    figure, axes = canvas(1, len(result["speeds"]), (WIDTH, 3.7), sharey=True)
    for ax, block in zip(axes[0], result["speeds"], strict=True):
        entries, intact = block["oil_levels"], block["intact"]["dlc"]
        levels = [100 * e["oil_level"] for e in entries]
        low, high = np.transpose([e["bands"]["all_over_intact"] for e in entries]) * intact
        ax.fill_between(levels, low, high, color=worn(0.6), alpha=0.2, lw=0, label="band of the assumptions")
        ax.plot(
            levels,
            [e["dlc"] for e in entries],
            "o-",
            color=worn(0.6),
            lw=3,
            ms=6,
            label=f"{plain(result['damper'])}, whole ride",
        )
        if result["effects"]:
            without = f"without {' and '.join(result['effects'])}"
            ax.plot(levels, [e["without_effects"]["dlc"] for e in entries], **ALSO, label=without)
        scalar = [e["scalar_factor"]["dlc"] for e in entries]
        ax.plot(levels, scalar, ":", color=SCALAR, lw=2, label="scalar factor: force × oil level")
        ax.axhline(intact, color=INTACT, lw=1.2, ls="--", label="intact")
        title(ax, f"{block['speed_kmh']:.0f} km/h")
        ax.set_xlabel("oil level [%]")
        ax.set_xticks(levels)
        ax.invert_xaxis()
        rise = ax.secondary_yaxis("right", functions=relative_to(intact))
        rise.set_yticks(np.arange(0.0, 100 * max(high) / intact - 100, 50))
        ax.set_title("rise over intact [%]", loc="right", size=9.5)  # above: beside it, it reads as the next panel's
        rise.tick_params(labelsize=9)
    axes[0][0].set_ylim(bottom=0)  # after all lines: it ends the scaling of the shared axis
    axes[0][0].set_ylabel("dynamic load coefficient (DLC) [1]")
    return save(figure, folder, "dlc_over_oil_level.png", messages.over_oil_level(result),
                conditions(result, f"{BAND} {settled(result)}"), key=axes[0][0])  # fmt: skip


def relative_to(intact: float) -> tuple[Any, Any]:
    """From a DLC to its rise over the intact one [%], and back."""
    return lambda value: 100 * (value / intact - 1), lambda rise: intact * (1 + rise / 100)


def development(folder: Path, result: dict[str, Any]) -> Path:
    """DLC and power of the damper over time."""
    figure, axes = canvas(2, len(result["speeds"]), (WIDTH, 5.2), sharex=True, sharey="row")
    ends: dict[int, list[tuple[float, str, str]]] = {0: [], 1: []}
    for column, block in enumerate(result["speeds"]):
        for entry in [*drawn(block), block["intact"]]:
            colour = colour_of(entry["gas_preload"], entry["oil_level"])
            middle = (np.arange(len(entry["dlc_window"])) + 0.5) * WINDOW
            for row, figure_name, scale in ((0, "dlc_window", 1.0), (1, "damping_work_window_J", 1 / WINDOW)):
                values = np.array(entry[figure_name]) * scale
                dashes = "--" if entry["gas_preload"] else "o-"
                axes[row][column].plot(middle, values, dashes, ms=3.5, lw=1.8, color=colour)
                if column == len(result["speeds"]) - 1:
                    ends[row].append((float(values[-1]), name_of(entry), colour))
        title(axes[0][column], f"{block['speed_kmh']:.0f} km/h")
        axes[1][column].set_xlabel(f"time [s], mean of {WINDOW:.0f} s")
    axes[0][0].set_ylabel("dynamic load coefficient [1]")
    axes[1][0].set_ylabel("power of the damper [W]")
    for row, names in ends.items():
        axes[row][0].set_ylim(bottom=0)
        name_lines(axes[row][-1], names)
    told = "DLC and the power that the damper turns into heat, over the time of the ride."
    return save(figure, folder, "development.png", messages.development(result), conditions(result, told))


def failure(folder: Path, result: dict[str, Any]) -> Path:
    """Time to failure over oil level and speed, for the most different ways of the freed gas."""
    table = result["time_to_failure"]
    figure, axes = canvas(1, len(table["freed_gas_ways"]), (WIDTH, 3.2), sharey=True)
    for ax, (way, rows) in zip(axes[0], table["freed_gas_ways"].items(), strict=True):
        cells(ax, rows, table["seconds"])
        ax.set_xticks(range(len(table["oil_levels"])), [f"{100 * level:.0f}" for level in table["oil_levels"]])
        ax.set_yticks(range(len(table["speeds_kmh"])), [f"{speed:.0f}" for speed in table["speeds_kmh"]])
        title(ax, WAYS[way])
        ax.set_xlabel("oil level [%]")
    axes[0][0].set_ylabel("speed [km/h]")
    told = (
        f"Second at which the first window of {WINDOW:.0f} s begins in which the damper does less than {100 * FAILED:.0f} % "
        f"of the work of the intact one, even if it does more again later; 0: the first window, –: none within "
        f"{table['seconds']:.0f} s. Darker: sooner."
    )
    return save(figure, folder, "time_to_failure.png", messages.failure(result), conditions(result, told))


def cells(ax: Axes, rows: list[list[float | None]], longest: float) -> None:
    """A coloured table of times [s]: the sooner the darker, white for never."""
    soon = np.array([[0.0 if time is None else 1 - 0.9 * (time / longest) ** 0.5 for time in row] for row in rows])
    ax.imshow(np.where(soon[..., None] > 0, OIL(soon), 1.0), aspect="auto")
    for (i, j), dark in np.ndenumerate(soon):
        time = rows[i][j]
        text = "–" if time is None else f"{time:.0f}"
        ax.text(j, i, text, ha="center", va="center", size=SMALL, color="white" if dark > DARK else "black")
    ax.set_xticks(np.arange(len(rows[0]) - 1) + 0.5, minor=True)
    ax.set_yticks(np.arange(len(rows) - 1) + 0.5, minor=True)
    ax.grid(visible=False, which="major")
    ax.grid(which="minor", color="white", alpha=1.0, lw=1)
    ax.tick_params(which="minor", length=0)


def rises(entry: dict[str, Any], intact: dict[str, Any]) -> dict[str, tuple[float, float]]:
    """Smallest and largest DLC relative to intact in the same car on the same road, by the varied assumption."""
    own = entry["dlc"] / intact["dlc"]
    low, high = entry["bands"]["seeds_over_intact"]
    bars = {"the road, five of them": (low, high)}
    for text, key in (("half-life of freed gas, 6.1 to 10.2 s", "half_life"), ("what the freed gas does", "freed_gas_ways")):
        low, high = entry["bands"][key]
        bars[text] = (low / intact["dlc"], high / intact["dlc"])
    for key, ends in entry["bands"]["assumed"].items():
        ratios = [v / w for v, w in zip(ends, intact["bands"]["assumed"][key], strict=True)]
        bars[key] = (min(*ratios, own), max(*ratios, own))
    return bars


def bands(folder: Path, result: dict[str, Any]) -> Path:
    """Dependence of the rise of the DLC on the assumptions: one bar each, the widest on top."""
    block = result["speeds"][-1]
    intact, entries = block["intact"], drawn(block)
    bars = {e["oil_level"]: rises(e, intact) for e in entries}
    widest = sorted(bars[LEVELS[0]], key=lambda name: max(row[name][1] - row[name][0] for row in bars.values()))
    figure, axes = canvas(1, len(entries), (WIDTH, 3.9), sharey=True, sharex=True)
    for ax, entry in zip(axes[0], entries, strict=True):
        low, high = 100 * (np.transpose([bars[entry["oil_level"]][name] for name in widest]) - 1)
        ax.barh(range(len(widest)), high - low, left=low, color=worn(entry["oil_level"]), height=0.65)
        ax.axvline(100 * (entry["dlc"] / intact["dlc"] - 1), color=INTACT, lw=1.5)
        ax.axvline(0.0, color=INTACT, lw=1.2, ls="--")
        ax.set_yticks(range(len(widest)), widest)
        ax.grid(visible=False, axis="y")
        title(ax, name_of(entry))
        ax.set_xlabel("rise of DLC [%]")
        ax.xaxis.set_major_locator(MultipleLocator(50))
    axes[0][0].set_xlim(left=-10.0)  # after all bars: it ends the scaling of the shared axis
    told = f"Bars: each assumption at both ends, alone. Line: the default. Dashed: no rise. {settled(result)}"
    return save(figure, folder, "bands.png", messages.bands(bars, block["speed_kmh"]), conditions(result, told))


def spectrum(folder: Path, result: dict[str, Any], rides: list[Ride]) -> Path:
    """Power spectral density of the wheel load."""
    figure, ((ax,),) = canvas(1, 1, (WIDTH, 4.0))
    shown = [ride for ride in rides if ride.case.gas_preload or ride.case.oil_level in LEVELS]
    densities = {}
    for ride in shown:
        rate = 1 / ride.time[1]
        f, density = signal.welch(ride.wheel_load[ride.time > SETTLED], rate, nperseg=int(8 * rate))
        inside = (f > LOWEST) & (f < HIGHEST)
        f, case = f[inside], ride.case
        densities[case] = density[inside]
        colour, dashes = colour_of(case.gas_preload, case.oil_level), "--" if case.gas_preload else "-"
        ax.loglog(f, density[inside], dashes, color=colour, lw=1.6, label=name_of(vars(case)), zorder=2 + case.gas_preload)
    ax.set_xlabel("frequency [Hz]")
    ax.set_ylabel("density of the wheel load [N²/Hz]")
    ax.set_xticks([0.5, 1, 2, 5, 10, 20, 40], ["0.5", "1", "2", "5", "10", "20", "40"])
    worst, intact = shown[-1].case, shown[0].case
    grown = []
    for name, band in (("body", f < BETWEEN), ("wheel", f >= BETWEEN)):
        top = np.flatnonzero(band)[np.argmax(densities[worst][band])]
        grown.append((name, float(f[top]), float(densities[worst][top] / densities[intact][top])))
    where = f"{result['damper']} with {oil(worst.oil_level)} at {worst.speed_kmh:.0f} km/h"
    told = f"Power spectral density of the wheel load, {SETTLED:.0f} to {result['seconds']:.0f} s."
    return save(figure, folder, "spectrum.png", messages.spectrum(grown, where), conditions(result, told), key=ax)
