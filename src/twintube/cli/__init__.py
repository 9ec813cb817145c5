"""The command `twintube`."""

from twintube.cli import (  # noqa: F401  # registers the commands
    car,
    dataset,
    demo,
    explore,
    fmu,
    inspect,
    measured,
    model,
    paper,
    ssp,
    vehicle,
)
from twintube.cli.base import app

__all__ = ["app"]
