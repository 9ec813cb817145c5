"""Style of the pictures."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from twintube.files import replacing

FOOTNOTE = "Assumed (unpublished): F-v curve, friction, gas spring, chamber dead length, car, and what freed gas does"
INTACT, FULL, PAPER, SCALAR = "#1b1b1b", "#2a7f9e", "#b3282d", "#7a7a7a"
BAND = "#9cc7d8"
LEVELS = {0.9: "#2a7f9e", 0.8: "#55a868", 0.6: "#d98c21", 0.4: "#b3282d"}  # oil levels in line plots
PHASES = {"oil": "#c98b1f", "foam": "#f0d9a8", "gas": "#cfe0ee"}

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


def save(figure: Figure, folder: Path, name: str, title: str) -> Path:
    """Add title and footnote to the figure and write it to a file."""
    figure.suptitle(title, x=0.01, ha="left", fontsize=12, parse_math=False)  # names may hold "$"
    figure.text(0.01, 0.005, FOOTNOTE, fontsize=7, color="#777")
    figure.tight_layout(rect=(0, 0.02, 1, 0.97))
    path = folder / name
    with replacing(path) as temporary:
        figure.savefig(temporary)
    plt.close(figure)
    return path
