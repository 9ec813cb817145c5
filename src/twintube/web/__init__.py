"""What pages with diagrams share: the plotting library with its licence, and the diagrams made with it."""

import re
from importlib.resources import files

FOLDER = files("twintube.web")


def text(*path: str) -> str:
    """A file of this folder."""
    return FOLDER.joinpath(*path).read_text(encoding="utf-8")


def library() -> str:
    """The plotting library under its licence."""
    licence, code = text("vendor", "LICENSE"), text("vendor", "uPlot.iife.min.js")
    return f"/*\n{licence}*/\n{code}"


def library_version() -> str:
    """Its version."""
    version = re.search(r"uPlot \(v([\d.]+)\)", text("vendor", "uPlot.iife.min.js"))
    return version[1] if version else ""


def library_style() -> str:
    """Its style sheet."""
    return text("vendor", "uPlot.min.css")


def plots() -> str:
    """The class `Chart` and what it needs."""
    return text("plots.js")
