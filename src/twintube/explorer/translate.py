"""The quarter car in C: `vehicle/quarter_car.py`, translated on the route of the damper's equations (`fmu/translate.py`).

Developers run `python -m twintube.explorer.translate` after a change of that file; it needs pyccel. The C is committed.
"""

import hashlib
from importlib.resources import files
from pathlib import Path

from twintube.files import write_text
from twintube.fmu.equations import StaleTranslationError, functions, ordered, record_source
from twintube.fmu.translate import converted
from twintube.vehicle import quarter_car

TARGET = Path(str(files("twintube.fmu_sources"))) / "explorer" / "quarter_car.h"
MODULE = "quarter"  # names in C begin with it
ENTRIES = ("static_load", "leapfrog_step", "damper_stroke", "damper_velocity")
RECORDS = {"Car": quarter_car.Car, "Motion": quarter_car.Motion}


def source() -> str:
    """The quarter car as a typed module, as pyccel reads it."""
    typed = functions(files("twintube.vehicle").joinpath("quarter_car.py").read_text(encoding="utf-8"))
    parts = ["import math", *(record_source(name, record) for name, record in RECORDS.items())]
    return "\n\n\n".join([*parts, *(typed[name] for name in ordered(typed, ENTRIES))]) + "\n"


def marked(body: str) -> str:
    """The C under a line with the digests of the Python that it was translated from and of itself."""
    python, c = (hashlib.sha256(text.encode()).hexdigest()[:16] for text in (source(), body))
    return f"/* Written by twintube/explorer/translate.py from quarter_car.py {python}, body {c}; do not edit. */\n{body}"


def checked(text: str) -> str:
    """The text of `quarter_car.h`; raises StaleTranslationError unless it is the translation of the present Python."""
    if text != marked(text.split("\n", 1)[-1]):
        raise StaleTranslationError(
            "quarter_car.h is not the translation of quarter_car.py: run `python -m twintube.explorer.translate` "
            "(needs pyccel)"
        )
    return text


def main() -> None:
    """Write `quarter_car.h`."""
    write_text(TARGET, marked(converted(source(), MODULE)))


if __name__ == "__main__":
    main()
