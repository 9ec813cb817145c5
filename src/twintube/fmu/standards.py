"""The versions of FMI that an FMU is built for: their files, names and types."""

from collections.abc import Mapping
from dataclasses import dataclass

from twintube.fmu.platforms import PLATFORMS, PLATFORMS_3, Fmi, Platforms, Ssp


@dataclass(frozen=True)
class Standard:
    """What a version of FMI calls things."""

    number: Fmi
    compiled: str  # the source file that includes all others
    header: str  # of the standard's functions
    prefix: str  # of all functions where FMUs are linked into one program
    types: tuple[str, str]  # of numbers and of whole numbers
    arrays: bool  # whether an array is one variable
    platforms: Platforms

    @property
    def version(self) -> str:
        """As model descriptions write it."""
        return f"{self.number}.0"


STANDARDS: Mapping[Fmi, Standard] = {
    2: Standard(
        2, "fmi2.c", "fmi2Functions.h", "FMI2_FUNCTION_PREFIX", ("Real", "Integer"), False, PLATFORMS
    ),
    3: Standard(
        3, "fmi3.c", "fmi3Functions.h", "FMI3_FUNCTION_PREFIX", ("Float64", "Int32"), True, PLATFORMS_3
    ),
}  # fmt: skip
# SSP 2.0 has the types of FMI 3.0; importers of SSP 1.0 know FMI 2.0.
INSIDE: Mapping[Ssp, Fmi] = {1: 2, 2: 3}
