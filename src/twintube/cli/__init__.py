"""The command `twintube`."""

from twintube.cli import dataset, demo, fmu, measured, model, vehicle  # noqa: F401  # registers the commands
from twintube.cli.base import app

__all__ = ["app"]
