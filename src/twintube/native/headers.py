"""The equations of models as headers in C, for the sources of FMUs and of the explorer.

A header is kept beside the libraries under a digest of what it follows from, and made anew where it is not of that.
"""

from contextlib import suppress
from functools import cache

from twintube.common.files import write_text
from twintube.native import sources
from twintube.native.build import LIBRARIES, digest
from twintube.native.translate import guarded, translated

# By their places in the sources of FMUs: what is translated, and the files that this follows from beside the damper's.
HEADERS = {
    "kernel.h": (sources.damper, ()),
    "car/kernel.h": (sources.car, (*sources.CAR, *sources.EXCHANGE)),
    "quarter_car.h": (sources.quarter_car, sources.QUARTER_CAR),
}


@cache
def header(name: str) -> str:
    """A header of HEADERS."""
    equations, files = HEADERS[name]
    path = LIBRARIES / "headers" / name
    if path.is_file():
        first, _, text = path.read_text(encoding="utf-8").partition("\n")
        if first == vouched(text, files):
            return text
    note = "/* Translated from the equations in Python by twintube/native; do not edit. */\n"
    text = note + guarded(translated(equations()).text, name)
    with suppress(OSError):  # where nothing can be kept it is made again
        write_text(path, f"{vouched(text, files)}\n{text}")
    return text


def vouched(text: str, files: tuple[str, ...]) -> str:
    """The line above a kept header, which tells whether it is unchanged and of the present equations."""
    return f"/* {digest(text, *files)} */"
