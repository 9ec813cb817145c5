"""The kinds of FMU, the versions of FMI, and the platforms that a native FMU has libraries for."""

from collections.abc import Mapping, Sequence
from typing import Literal

Kind = Literal["native", "python"]
Fmi = Literal[2, 3]
Ssp = Literal[1, 2]
Platforms = Mapping[str, tuple[str, tuple[str, ...]]]
# Folder in the FMU: file ending, targets. More than one target is joined to a universal file. FMI 2.0 has no name for
# Linux on ARM; vendors may add names, and this one is that of FMI 3.0.
PLATFORMS: Platforms = {
    "linux64": ("so", ("x86_64-linux-gnu.2.17",)),
    "aarch64-linux": ("so", ("aarch64-linux-gnu.2.17",)),
    "win64": ("dll", ("x86_64-windows-gnu",)),
    "darwin64": ("dylib", ("x86_64-macos.11.0", "aarch64-macos.11.0")),
}

# FMI 3.0 names the processor, so that nothing is joined.
PLATFORMS_3: Platforms = {
    "x86_64-linux": PLATFORMS["linux64"],
    "aarch64-linux": PLATFORMS["aarch64-linux"],
    "x86_64-windows": PLATFORMS["win64"],
    "x86_64-darwin": ("dylib", ("x86_64-macos.11.0",)),
    "aarch64-darwin": ("dylib", ("aarch64-macos.11.0",)),
}


class PlatformError(ValueError):
    """The platform is not known; the message names all that are."""


def known(platforms: Sequence[str] | None, fmi: Fmi = 2) -> tuple[str, ...]:
    """The platforms without repetitions, all of them for None; raises PlatformError."""
    named = PLATFORMS if fmi == 2 else PLATFORMS_3
    platforms = tuple(named) if platforms is None else platforms
    for platform in platforms:
        if platform not in named:
            raise PlatformError(f"platform = {platform}: must be one of {', '.join(named)}")
    return tuple(dict.fromkeys(platforms))
