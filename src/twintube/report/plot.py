"""What `plot()` of a result draws: the picture that its page begins with."""

from functools import singledispatch
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from twintube.diagnosis import Answer
from twintube.engine.simulation import Simulation
from twintube.identification import Result
from twintube.report.common import style
from twintube.report.diagnosis import changes, state
from twintube.report.identification.pictures import works
from twintube.report.simulated_record import figure


def picture(result: Any) -> Figure:
    """The picture of a result as a figure of pyplot, which notebooks and `plt.show()` show."""
    with style.of_pyplot():
        return of(result)


@singledispatch
def of(result: object) -> Figure:
    """The picture of a result."""
    raise TypeError(f"{type(result).__name__} has no picture")


@of.register
def _(result: Simulation) -> Figure:
    used = np.ones(len(result.force), dtype=bool)
    return figure(
        "Stroke over time", result.time, result.stroke, result.velocity, simulated=result.force, measured=None, usable=used
    )


@of.register
def _(result: Answer) -> Figure:
    return state.picture(result.states) if result.changes is None else changes.picture(result)


@of.register
def _(result: Result) -> Figure:
    return works([row for row in result.validation if row.measurement == "harmonic"])
