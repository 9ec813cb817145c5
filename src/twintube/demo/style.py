"""What the pictures have in common: which oil levels are drawn, words for states, conditions and what is assumed."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from twintube.common.files import write_bytes
from twintube.report.common.framed import framed, oil
from twintube.report.common.style import VIOLET, png
from twintube.vehicle.ride import SETTLED

NOTE = "Assumed, not published: F-v curve, friction, gas spring, dead length of the chambers, car, and what freed gas does."
LEVELS = (0.9, 0.8, 0.6, 0.4)  # oil levels where lines of all eight would hide one another
ALSO = {"color": VIOLET, "ls": "--", "lw": 1.3}  # the damper without its effects, which are its own


def name_of(entry: dict[str, Any]) -> str:
    """`intact` or the oil level."""
    return "intact" if entry["gas_preload"] else oil(entry["oil_level"])


def drawn(block: dict[str, Any]) -> list[dict[str, Any]]:
    """The entries of LEVELS at one speed."""
    return [e for e in block["oil_levels"] if e["oil_level"] in LEVELS]


def conditions(result: dict[str, Any], about: str) -> str:
    """What a picture shows, and where it holds."""
    car = f"{result['axle']} corner of a {result['car']['title']}"
    return f"{about} {result['damper']} without gas preload, {car}, class D road."


def settled(result: dict[str, Any]) -> str:
    """What DLC is, and over which time."""
    return f"DLC: standard deviation of the wheel load over its static load, {SETTLED:.0f} to {result['seconds']:.0f} s."


def save(figure: Figure, folder: Path, name: str, sentence: str, told: str, *, key: Axes | None = None) -> Path:
    """Add sentence, conditions, the key of an axes and what is assumed to the figure and write it to a file."""
    framed(figure, sentence, told, NOTE, key)
    write_bytes(folder / name, png(figure))
    return folder / name
