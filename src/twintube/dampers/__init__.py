"""Parameter sets of dampers: the paper's eight, in this folder, and a user's own, as TOML files."""

from twintube.dampers.damper import Damper, ParameterError, elements
from twintube.dampers.toml import load, names
from twintube.dampers.writing import to_toml

__all__ = ["Damper", "ParameterError", "elements", "load", "names", "to_toml"]
