"""The quarter car in C: `vehicle/quarter_car.py`, translated on the route of the damper's equations (`fmu/translate.py`).

Developers run `python -m twintube.explorer.translate` after a change of that file; it needs pyccel. The C is committed.
"""

from importlib.resources import files
from pathlib import Path

from twintube.common.files import write_text
from twintube.fmu.equations import Equations, joined_source, marked
from twintube.fmu.translate import converted
from twintube.vehicle import quarter_car

TARGET = Path(str(files("twintube.fmu_sources"))) / "explorer" / "quarter_car.h"
MODULE = "quarter"  # names in C begin with it
QUARTER_CAR = Equations(
    {"Car": quarter_car.Car, "Motion": quarter_car.Motion},
    {},
    ("static_load", "leapfrog_step", "damper_stroke", "damper_velocity"),
    lambda: [files("twintube.vehicle").joinpath("quarter_car.py").read_text(encoding="utf-8")],
)


def translated() -> str:
    """The text of `quarter_car.h`; raises RuntimeError with what pyccel says."""
    return marked(converted(joined_source(QUARTER_CAR), MODULE), QUARTER_CAR)


def main() -> None:
    """Write `quarter_car.h`."""
    write_text(TARGET, translated())


if __name__ == "__main__":
    main()
