"""Which equations are translated: the only list of their files, and of the functions that are called from outside."""

from collections.abc import Iterable
from pathlib import Path

from twintube.core import sources
from twintube.native.translate import Equations

PACKAGE = Path(__file__).parents[1]
QUARTER_CAR = ("vehicle/quarter_car.py",)
CAR = (
    *QUARTER_CAR,
    "vehicle/full/car.py",
    "vehicle/full/tyre.py",
    "vehicle/full/brakes.py",
    "vehicle/full/layout.py",
    "vehicle/full/body.py",
    "vehicle/full/driver.py",
)
EXCHANGE = ("vehicle/full/signals.py", "vehicle/full/exchange.py")  # of the car's FMU
LOOPS = (
    "engine/loops.py",
    "vehicle/loops.py",
    "vehicle/full/steering.py",
    "vehicle/full/loop.py",
    "vehicle/full/unit_loop.py",
    "vehicle/full/rolling.py",
    "diagnosis/memory_loops.py",
)
RIG = ("lab/virtual_rig/constants.py", "lab/virtual_rig/physics.py")
# Functions of other libraries at their addresses, which `vehicle/full/unit_loop.py` calls.
OUTER = {
    "call_values": """\
static int64_t kernel_call_values(int64_t function, int64_t component, int64_t references, int64_t size, int64_t values)
{
    typedef int (*called)(void *, const unsigned *, size_t, double *);
    return ((called)(intptr_t)function)((void *)(intptr_t)component, (const unsigned *)(intptr_t)references, (size_t)size,
                                        (double *)(intptr_t)values);
}
""",
    "call_step": """\
static int64_t kernel_call_step(int64_t function, int64_t component, double time, double dt)
{
    typedef int (*called)(void *, double, double, int);
    return ((called)(intptr_t)function)((void *)(intptr_t)component, time, dt, 1);
}
""",
}


def texts_of(*names: str) -> dict[str, str]:
    """Sources of the package by their paths in it."""
    return {name: (PACKAGE / name).read_text(encoding="utf-8") for name in names}


def loops() -> Equations:
    """Kernel and effects with the loops over them, which the package runs."""
    entries = (
        "advance", "run_record", "run_work", "run_held", "run_means", "first_parted", "run_drive", "run_car", "step_units",
        "run_car_with_units", "roll_wheels", "filter_noise", "smooth_noise", "lag",
    )  # fmt: skip
    return Equations(sources.damper_sources() | texts_of(*CAR, *LOOPS), entries, outer=OUTER)


def rig() -> Equations:
    """The virtual rig, which is not the model."""
    return Equations(texts_of(*RIG), ("right_hand_side", "outputs"), prefix="rig_")


def damper() -> Equations:
    """The damper of an FMU."""
    entries = (
        "set_up", "start", "advance", "publish", "curve_rule", "fit_rule", "stroke_limit", "time_slack", "possible",
        "parted", "followed", "within_law",
    )  # fmt: skip
    return Equations(sources.damper_sources(), entries)


def car() -> Equations:
    """The car of an FMU, without dampers."""
    entries = (
        "set_up_car", "start_car", "communication_step", "publish_body", "publish_wheel", "time_slack", "parted", "followed",
    )  # fmt: skip
    return Equations(sources.rule_sources() | texts_of(*CAR, *EXCHANGE), entries)


def quarter_car() -> Equations:
    """The quarter car of the explorer."""
    entries = ("static_load", "leapfrog_step", "damper_stroke", "damper_velocity")
    return Equations(texts_of(*QUARTER_CAR), entries, prefix="quarter_")


def paths(names: Iterable[str]) -> list[Path]:
    """The files that C follows from: sources of these names, the damper's equations, what generates and translates."""
    making = [*PACKAGE.glob("core/hook*.py"), PACKAGE / "core" / "publishing.py", *PACKAGE.glob("native/*.py")]
    return sorted({*sources.files(), *making, *(PACKAGE / name for name in names)})
