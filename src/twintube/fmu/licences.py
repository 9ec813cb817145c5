"""The licences of all that is inside the FMU."""

from collections.abc import Sequence
from importlib.metadata import distribution
from importlib.util import find_spec
from pathlib import Path

from twintube.fmu.binaries import headers
from twintube.fmu.platforms import Kind
from twintube.fmu.standards import STANDARDS, Standard

FOLDER = "documentation/licenses"
ABOUT = {
    "fmi_headers.txt": "the headers of FMI, which the library is compiled with",
    "zig.txt": "Zig's runtime, which its C compiler links where a processor needs it",
    "mingw-w64.txt": "start of the Windows library and some of its mathematical functions, of mingw-w64",
    "pythonfmu.txt": "the library in `binaries` and the package in `resources`, of pythonfmu",
}
NATIVE = "The libraries need nothing but the C library of the system they run on. "


class LicenceError(RuntimeError):
    """A licence text is missing from an installed package."""


def of_package(name: str) -> str:
    """The licence of an installed package; raises LicenceError."""
    text = distribution(name).read_text("licenses/LICENSE") or distribution(name).read_text("LICENSE")
    if text is None:
        raise LicenceError(f"the installed package {name} has no licence file; install it again")
    return text


def of_compiler(path: str) -> str:
    """A licence that comes with the compiler; raises LicenceError."""
    spec = find_spec("ziglang")
    file = Path(spec.origin).parent / path if spec is not None and spec.origin is not None else Path(path)
    if not file.is_file():
        raise LicenceError(f"the installed package ziglang has no {path}; install it again")
    return file.read_text(encoding="utf-8")


def of_headers(standard: Standard) -> str:
    """The licence in the comment of FMI's header."""
    comment = (headers() / standard.header).read_text(encoding="utf-8").split("/*", 1)[-1].split("*/", 1)[0]
    lines = comment[max(comment.find("Copyright (C)"), 0) :].splitlines()
    return "\n".join(line.strip() for line in lines) + "\n"


def files(kind: Kind, platforms: Sequence[str], standard: Standard = STANDARDS[2]) -> dict[str, bytes]:
    """The licence of this package, which names the others, and theirs; raises LicenceError."""
    if kind == "python":
        others = {"pythonfmu.txt": of_package("pythonfmu")}
    else:
        others = {"fmi_headers.txt": of_headers(standard)}
        if platforms:
            others["zig.txt"] = of_compiler("LICENSE")
        if any(standard.platforms[platform][0] == "dll" for platform in platforms):
            others["mingw-w64.txt"] = of_compiler("lib/libc/mingw/COPYING")
    about = "".join(f"- {name}: {ABOUT[name]}\n" for name in others)
    note = f"\n{NATIVE if kind == 'native' else ''}Parts of others, with their licences in this folder:\n\n{about}"
    texts = {"license.txt": of_package("twintube") + note} | others
    return {f"{FOLDER}/{name}": text.encode() for name, text in texts.items()}
