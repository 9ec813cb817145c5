"""The command `twintube`."""

from twintube.cli import (  # noqa: F401  # registers the commands
    car,
    dataset,
    demo,
    drive,
    explore,
    fmu,
    former,
    inspect,
    measured,
    model,
    monitor,
    paper,
    rig,
    ssp,
    vehicle,
)
from twintube.cli.base import app

__all__ = ["app"]
