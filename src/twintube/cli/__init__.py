"""The command `twintube`."""

from twintube.cli import car, dataset, demo, fmu, inspect, measured, model, ssp, vehicle  # noqa: F401  # registers the commands
from twintube.cli.base import app

__all__ = ["app"]
