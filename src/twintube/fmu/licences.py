"""The licences of all that is inside the FMU, which travel in the package."""

from collections.abc import Sequence

from twintube.fmu.platforms import Kind
from twintube.fmu.standards import STANDARDS, Standard
from twintube.native.units import HEADERS, SOURCES

FOLDER = "documentation/licenses"
ABOUT = {
    "fmi_headers.txt": "the headers of FMI, which the library is compiled with",
    "zig.txt": "Zig's runtime, which its C compiler links where a processor needs it",
    "mingw-w64.txt": "start of the Windows library and some of its mathematical functions, of mingw-w64",
    "pythonfmu.txt": "the library in `binaries` and the package in `resources`, of pythonfmu",
}
NATIVE = "The libraries need nothing but the C library of the system they run on. "


def text_of(name: str) -> str:
    """The licence in a file of the package."""
    return (SOURCES / "licences" / name).read_text(encoding="utf-8")


def of_headers(standard: Standard) -> str:
    """The licence in the comment of FMI's header."""
    comment = (HEADERS / standard.header).read_text(encoding="utf-8").split("/*", 1)[-1].split("*/", 1)[0]
    lines = comment[max(comment.find("Copyright (C)"), 0) :].splitlines()
    return "\n".join(line.strip() for line in lines) + "\n"


def files(kind: Kind, platforms: Sequence[str], standard: Standard = STANDARDS[2]) -> dict[str, bytes]:
    """The licence of this package, which names the others, and theirs."""
    if kind == "python":
        names = ["pythonfmu.txt"]
    else:
        windows = any(standard.platforms[platform][0] == "dll" for platform in platforms)
        names = ["fmi_headers.txt", *["zig.txt"] * bool(platforms), *["mingw-w64.txt"] * windows]
    about = "".join(f"- {name}: {ABOUT[name]}\n" for name in names)
    note = f"\n{NATIVE if kind == 'native' else ''}Parts of others, with their licences in this folder:\n\n{about}"
    texts = {"license.txt": text_of("twintube.txt") + note}
    texts |= {name: of_headers(standard) if name == "fmi_headers.txt" else text_of(name) for name in names}
    return {f"{FOLDER}/{name}": text.encode() for name, text in texts.items()}
