"""The kinds of FMU, and the platforms that a native one has libraries for."""

from typing import Literal

Kind = Literal["native", "python"]
# FMI platform: file ending, targets. More than one target is joined to a universal file.
PLATFORMS = {
    "linux64": ("so", ("x86_64-linux-gnu.2.17",)),
    "win64": ("dll", ("x86_64-windows-gnu",)),
    "darwin64": ("dylib", ("x86_64-macos", "aarch64-macos")),
}
