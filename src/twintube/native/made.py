"""What is compiled once and travels in the package: for each platform, all that there is for it."""

from pathlib import Path

from twintube.native import build
from twintube.native.units import EXPLORER, MODULE, UNITS, LibraryError, Unit, library


def units(platform: str) -> list[Unit]:
    """The libraries and modules for a platform; none for a machine that FMI has no name for."""
    return [unit for unit in (*UNITS.values(), EXPLORER) if platform in unit.platforms]


def made_for(platform: str) -> list[Path]:
    """Make all that there is for a platform; raises CompilerError, and SubsetError where an equation is at fault."""
    return [*([] if platform == MODULE else [build.made(platform)]), *(unit.made(platform) for unit in units(platform))]


def complete(platform: str) -> bool:
    """Whether all that there is for a platform is made, and of the present sources."""
    try:
        engine = platform == MODULE or build.current(build.library_path(platform))
        return engine and all(library(unit, platform) for unit in units(platform))
    except LibraryError:
        return False
