"""A wrong rate, and records of the wrong state, setting or damper; the other faults are those of the bench."""

from twintube.dampers import Damper, load
from worlds.model.march import march
from worlds.model.run import Constants, Run

LOWEST, HIGHEST = 0.25, 0.97  # oil levels [1] of a wrong state


def stretched(run: Run, x: float, c: Constants) -> None:
    """Another rate than the one in the header, in all channels alike."""
    run.stretch = 1.0 + c["sign"] * x


def odd_state(run: Run, x: float, c: Constants) -> None:
    """The file was taken in another state: `x` [1] more or less oil, without preload."""
    if run.record.number == c["file"]:
        level = run.record.level - x if run.record.level - x >= LOWEST else min(run.record.level + x, HIGHEST)
        forces_of(run, run.damper.with_(oil_level=level, gas_preload=0))


def odd_setting(run: Run, x: float, c: Constants) -> None:
    """The file was taken at another setting of the valves: forces of both branches times 1 + x or 1 - x."""
    if run.record.number == c["file"]:
        p, factor = run.damper.parameters, 1.0 + c["sign"] * x
        forces_of(run, run.damper.with_(**{name: tuple(factor * F for F in getattr(p, name)) for name in ("F_re", "F_co")}))


def odd_damper(run: Run, x: float, c: Constants) -> None:
    """The file is of another damper."""
    if run.record.number == c["file"]:
        state = {"oil_level": run.record.level, "gas_preload": int(run.record.preload)}
        forces_of(run, load(c["damper"], as_published=True).with_(**state))


def forces_of(run: Run, damper: Damper) -> None:
    """The forces of another damper over the run's motion."""
    parts = march(damper, run.motion.time, run.motion.stroke, run.motion.velocity)
    run.force = parts["fluid"] + parts["friction"] + parts["gas"]
