"""The command `twintube`."""

from twintube.cli import (  # noqa: F401  # registers the commands
    car,
    dataset,
    demo,
    drive,
    explore,
    fmu,
    inspect,
    measured,
    model,
    monitor,
    paper,
    ssp,
    vehicle,
)
from twintube.cli.base import app

__all__ = ["app"]
