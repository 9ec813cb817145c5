"""The kinds of FMU, and the platforms that a native one has libraries for."""

from collections.abc import Sequence
from typing import Literal

Kind = Literal["native", "python"]
# Folder in the FMU: file ending, targets. More than one target is joined to a universal file. FMI 2.0 has no name for
# Linux on ARM; vendors may add names, and this one is that of FMI 3.0.
PLATFORMS = {
    "linux64": ("so", ("x86_64-linux-gnu.2.17",)),
    "aarch64-linux": ("so", ("aarch64-linux-gnu.2.17",)),
    "win64": ("dll", ("x86_64-windows-gnu",)),
    "darwin64": ("dylib", ("x86_64-macos.11.0", "aarch64-macos.11.0")),
}


class PlatformError(ValueError):
    """The platform is not known; the message names all that are."""


def known(platforms: Sequence[str]) -> tuple[str, ...]:
    """The platforms without repetitions; raises PlatformError."""
    for platform in platforms:
        if platform not in PLATFORMS:
            raise PlatformError(f"platform = {platform}: must be one of {', '.join(PLATFORMS)}")
    return tuple(dict.fromkeys(platforms))
