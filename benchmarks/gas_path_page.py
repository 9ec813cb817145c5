"""The figures of `gas_path` as tables in Markdown and a picture."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes

from benchmarks.gas_path import KEPT, LEVELS, LOST, SECONDS, SERVICE, SHARES, gas_path
from twintube.common.files import write_bytes, write_text
from twintube.dampers import load
from twintube.demo.bands import SEEDS, SPEEDS
from twintube.demo.words import NO_RISE
from twintube.report.common.framed import INTACT, WIDTH, framed, name_lines, oil, worn
from twintube.report.common.style import GREEN, VIOLET, canvas, png, title

PATHS = {LOST: ("preload lost", worn(0.4)), SERVICE: (SERVICE, VIOLET), KEPT: ("preload kept", GREEN)}
DRAWN = (1.0, 0.8, 0.6, 0.4)  # oil levels over the gas


def bench_gas_path(file: Path | None = None, plot: Path | None = None, tables: Path | None = None) -> dict[str, Any]:
    """Figures of a parameter file's damper, of SA8 without one, with table and picture where asked for."""
    damper = load("SA8") if file is None else load(file)
    figures = gas_path(damper)
    if tables is not None:
        write_text(tables, markdown(figures))
    if plot is not None:
        draw(damper.name, figures, plot)
    return figures


def markdown(figures: dict[str, Any]) -> str:
    """The tables of the page: the rise by path and oil level at each speed, and where EUSAMA fails."""
    lines: list[str] = []
    names = [*(f"gas at {share:.0%}" for share in SHARES), SERVICE]
    for speed in SPEEDS:
        head = [f"{speed:g} km/h", *(oil(level) for level in LEVELS)]
        lines += [row(head), "|---" * len(head) + "|"]
        for name in names:
            cells = figures[f"{speed:g} km/h, {name}"].values()
            lines.append(row([words(name), *(f"{sign(c['least'])} to {sign(c['most'])}" for c in cells)]))
        lines.append("")
    for (damper, shares), fails in ((item, figures["EUSAMA fails from [% of oil]"])
                                    for item in figures["preload in service"].items()):  # fmt: skip
        lines += [row([f"preload of {damper} in service", *(f"{share:.2f}" for share in shares.values())]), ""]
        heads = ["friction", *map(words, fails)]
        lines += [row(heads), "|---" * len(heads) + "|"]
        lines += [row([force, *(f"{path[force]:.0f} %" for path in fails.values())]) for force in fails[SERVICE]]
    return "\n".join(lines) + "\n"


def row(cells: list[str]) -> str:
    """A line of a table."""
    return f"| {' | '.join(cells)} |"


def words(name: str) -> str:
    """A path with the page's sign of per cent."""
    return name.replace("%", " %")


def sign(value: float) -> str:
    """A rise [%], 0 without sign."""
    return f"{value:+.0f}" if round(value) else "0"


def begins(figures: dict[str, Any], name: str, end: str) -> str:
    """The highest oil level from which down the `end` of the rise, `least` or `most`, is one, at either speed or both."""
    several = all if end == "least" else any
    risen = [several(figures[f"{speed:g} km/h, {name}"][f"{level:.0%}"][end] > 100 * (NO_RISE - 1) for speed in SPEEDS)
             for level in LEVELS]  # fmt: skip
    first = next((i for i in range(len(LEVELS)) if all(risen[i:])), None)
    return "none" if first is None else f"{100 * LEVELS[first]:.0f}"


def draw(name: str, figures: dict[str, Any], path: Path) -> None:
    """The rise over the oil level along three paths, and over the gas at some oil levels."""
    figure, axes = canvas(2, len(SPEEDS), (WIDTH, 6.4), sharey=True)
    for column, speed in enumerate(SPEEDS):
        over_oil(axes[0][column], figures, speed)
        over_gas(axes[1][column], figures, speed)
    for line in axes:
        line[0].set_ylabel("rise of the DLC over intact [%]")
    said = ", ".join(f"{text} {begins(figures, key, 'most')} and {begins(figures, key, 'least')} %"
                     for key, (text, _) in PATHS.items())  # fmt: skip
    told = (
        f"{name} in the default car, class D road, {SECONDS:.0f} s. Line: mean of {len(SEEDS)} roads, the car's friction. "
        f"Band: all roads, friction of the suspension over its band. A rise is above {100 * (NO_RISE - 1):.0f} %. "
        "In service: the gas expands into the room of the lost oil, and none leaks by itself."
    )
    note = "Assumed, not published: F-v curve, friction, gas spring, dead length of the chambers, car, what freed gas does."
    sentence = f"Oil level from which the wheel load rises on some roads, and on all: {said}"
    framed(figure, sentence, told, note, axes[0][0])
    write_bytes(path, png(figure))


def band(ax: Axes, at: list[float], cells: list[dict[str, float]], colour: str, name: str) -> None:
    """Mean and band of cells."""
    ax.fill_between(at, [c["least"] for c in cells], [c["most"] for c in cells], color=colour, alpha=0.2, lw=0)
    ax.plot(at, [c["mean"] for c in cells], "o-", ms=4, lw=2, color=colour, label=name)


def over_oil(ax: Axes, figures: dict[str, Any], speed: float) -> None:
    """Along the loss of oil: gas kept, as in service, lost."""
    at = [100 * level for level in LEVELS]
    for key, (text, colour) in PATHS.items():
        band(ax, at, list(figures[f"{speed:g} km/h, {key}"].values()), colour, text)
    title(ax, f"{speed:g} km/h")
    ax.set_xlabel("oil level [%]")
    ax.set_xticks(at)
    ax.invert_xaxis()


def over_gas(ax: Axes, figures: dict[str, Any], speed: float) -> None:
    """Along the loss of gas at constant oil."""
    at, ends = [100 * share for share in SHARES], []
    for level in DRAWN:
        cells = [figures[f"{speed:g} km/h, gas at {share:.0%}"][f"{level:.0%}"] for share in SHARES]
        colour = INTACT if level == 1.0 else worn(level)
        band(ax, at, cells, colour, oil(level))
        ends.append((cells[-1]["mean"], oil(level), colour))
    ax.set_xlabel("gas preload [% of nominal]")
    if speed == SPEEDS[-1]:
        name_lines(ax, ends)
    ax.set_xticks(at)
    ax.invert_xaxis()
