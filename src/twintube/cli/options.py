"""Options that several commands share, and the values that an option may have.

The values are written down here, and compared with the library's by a test: the help must not wait for numpy and scipy.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

import twintube

PLATFORMS = ("linux64", "aarch64-linux", "win64", "darwin64")
PLATFORMS_3 = ("x86_64-linux", "aarch64-linux", "x86_64-windows", "x86_64-darwin", "aarch64-darwin")  # of FMI 3.0
ROADS = ("A", "B", "C", "D", "E")
CARS = ("escort", "passat_b8")
FREED_GAS = ("stays", "dissolves", "dissolves_fast", "dissolves_slow", "limited", "half_pushes_oil", "pushes_oil")
MANEUVERS = ("ride", "braking", "cornering", "step_steer", "sine_with_dwell", "lane_change", "circle", "braking_in_turn")
WORN = ("all", "front", "rear", "front_left", "front_right", "rear_left", "rear_right")
INSPECTIONS = ("eusama", "phase_shift", "damping_ratio", "push_down", "bump", "tiring")
SEARCHES = ("de", "pso")
STARTS = ("rebound", "top", "compression", "bottom")
START = "bottom"
STEP_MS = 1.0


def dampers() -> list[str]:
    """The named dampers: their files, found without importing what reads them."""
    return sorted(path.stem for path in (Path(twintube.__file__).parent / "dampers").glob("*.toml"))


def one_of(values: Iterable[str], *names: str, metavar: str = "", **options: Any) -> Any:
    """An option with one of some values, which the help shows and the shell completes."""
    listed = list(values)
    return typer.Option(*names, metavar=metavar or "|".join(listed), autocompletion=lambda: listed, **options)


def damper_option(text: str, *names: str) -> Any:
    """An option for a damper."""
    return typer.Option(*names, metavar="DAMPER", autocompletion=dampers, help=text)


DAMPER_ARGUMENT: Any = typer.Argument(metavar="DAMPER", autocompletion=dampers, help="SA1 to SA8, or a parameter file.")
DAMPER = Annotated[str, DAMPER_ARGUMENT]
DATASET = Annotated[
    Path, typer.Argument(metavar="DATASET", help="A folder with dataset.toml and its records, or that file.")
]
CAR = Annotated[str, one_of(CARS, "--car", metavar="CAR", help=f"{' or '.join(CARS)}, or a car's file.")]
FRONT = Annotated[str, damper_option("Damper of the front axle: a name or a parameter file.")]
REAR = Annotated[str, damper_option("Damper of the rear axle.")]
WORN_AT = Annotated[
    str,
    one_of(WORN, metavar="all|front|rear|WHEEL", help=f"Worn dampers; a wheel is {', '.join(WORN[3:-1])} or {WORN[-1]}."),
]
SEED = Annotated[int, typer.Option(metavar="N", min=0, help="Seed of the road.")]
PROCESSES = Annotated[int | None, typer.Option(metavar="N", help="Processes on this machine; all cores if left out.")]
JSON_FILE = Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all figures to this file.")]
AS_PUBLISHED = Annotated[
    bool, typer.Option("--as-published", help="The paper's equations alone: gas that cavitation frees stays gas.")
]
PLATFORM = Annotated[
    list[str] | None,
    one_of(
        dict.fromkeys(PLATFORMS + PLATFORMS_3),
        metavar="NAME",
        help=f"Only this platform; repeatable: {', '.join(PLATFORMS)}, or as FMI 3.0 calls them: {', '.join(PLATFORMS_3)}.",
    ),
]
SSP = Annotated[
    Literal[1, 2], typer.Option("--ssp", metavar="1|2", help="Version of SSP: 1 with FMUs of FMI 2.0, 2 with FMI 3.0.")
]
