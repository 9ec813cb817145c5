"""What an FMU is built of: names, variables and equations; a damper or a car."""

from collections.abc import Mapping
from dataclasses import dataclass

from twintube.fmu.table import Variable


@dataclass(frozen=True)
class Model:
    """A model with its start values."""

    name: str  # also the identifier
    title: str
    variables: tuple[Variable, ...]
    experiment: Mapping[str, str]
    kind: str  # of the libraries, damper or car
    takes_derivatives: bool  # of inputs
