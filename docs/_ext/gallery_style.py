"""One style for all pictures of the gallery."""

from typing import Any

import matplotlib as mpl


def reset(gallery_conf: dict[str, Any], name: str) -> None:
    """Called by sphinx-gallery before each example."""
    mpl.rcParams |= {
        "axes.grid": True,
        "grid.alpha": 0.3,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "figure.constrained_layout.use": True,
        "figure.dpi": 110,
        "savefig.dpi": 110,
        "font.size": 10,
        "legend.frameon": False,
        "lines.linewidth": 1.4,
    }
