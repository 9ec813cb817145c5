"""The kinds of FMU, the versions of FMI, and the platforms that a native FMU has libraries for."""

from collections.abc import Mapping, Sequence
from typing import Literal

Kind = Literal["native", "python"]
Fmi = Literal[2, 3]
Ssp = Literal[1, 2]
Platforms = Mapping[str, tuple[str, tuple[str, ...]]]
# Folder in the FMU: file ending, and the platforms of `native/compiler.py`. More than one is joined to a universal file.
# FMI 2.0 has no name for Linux on ARM; vendors may add names, and this one is that of FMI 3.0.
PLATFORMS: Platforms = {
    "linux64": ("so", ("x86_64-linux",)),
    "aarch64-linux": ("so", ("aarch64-linux",)),
    "win64": ("dll", ("x86_64-windows",)),
    "darwin64": ("dylib", ("x86_64-darwin", "aarch64-darwin")),
}

# FMI 3.0 names the processor, so that nothing is joined.
PLATFORMS_3: Platforms = {
    "x86_64-linux": PLATFORMS["linux64"],
    "aarch64-linux": PLATFORMS["aarch64-linux"],
    "x86_64-windows": PLATFORMS["win64"],
    "x86_64-darwin": ("dylib", ("x86_64-darwin",)),
    "aarch64-darwin": ("dylib", ("aarch64-darwin",)),
}


class PlatformError(ValueError):
    """The platform is not known; the message names all that are."""


def known(platforms: Sequence[str] | None, fmi: Fmi = 2) -> tuple[str, ...]:
    """The platforms under the names of a version, without repetitions, all of them for None; raises PlatformError.

    A name of the other version stands for the platforms that have a target of its library.
    """
    named, other = (PLATFORMS, PLATFORMS_3) if fmi == 2 else (PLATFORMS_3, PLATFORMS)
    found: list[str] = []
    for platform in named if platforms is None else platforms:
        if platform not in named and platform not in other:
            every = ", ".join(dict.fromkeys([*named, *other]))
            raise PlatformError(f"platform = {platform}: must be one of {every}")
        targets = set() if platform in named else set(other[platform][1])
        found += [platform] if platform in named else [name for name, (_, own) in named.items() if targets & set(own)]
    return tuple(dict.fromkeys(found))
