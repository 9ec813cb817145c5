"""Curves of records to look into: which record, over what, which curves, values under the pointer.

The diagrams are those of the explorer (`twintube.web`); all data stand in the page.
"""

import base64
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np

from twintube import web
from twintube.common.arrays import Array
from twintube.report.common import style
from twintube.report.common.html_page import beside, rendered

MOST_POINTS = 1200  # of a record


@dataclass(frozen=True)
class Curve:
    """A force to show: `name`, an identifier, is its key in `Look.forces`; `colour` is one of `style`; `shown` at first."""

    name: str
    label: str
    colour: str
    dash: Sequence[int] = ()
    shown: bool = True


@dataclass(frozen=True)
class Look:
    """A record; arrays (n,) in SI units. `marks` (k,) are the samples at which its oscillations begin, and the end."""

    label: str
    remark: str
    time: Array
    stroke: Array
    velocity: Array
    forces: dict[str, Array]
    marks: Sequence[int] = ()


def packed(values: Array) -> str:
    """An array as the page's script reads it, at most MOST_POINTS from its beginning."""
    return base64.b64encode(np.asarray(values[:MOST_POINTS], dtype="<f4").tobytes()).decode("ascii")


def live(curves: Sequence[Curve], looks: Sequence[Look]) -> str:
    """The part of a page in which a reader looks into the records; empty without any."""
    if not looks:
        return ""
    data = {
        "curves": [asdict(curve) for curve in curves],
        "records": [
            {
                "label": look.label, "remark": look.remark,
                "marks": [int(mark) for mark in look.marks if mark < MOST_POINTS],
                "t": packed(look.time - look.time[0]), "s": packed(1e3 * look.stroke), "v": packed(look.velocity),
                "forces": {name: packed(force) for name, force in look.forces.items()},
            }
            for look in looks
        ],
    }  # fmt: skip
    # No text of a user can end the element.
    text = json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")
    return rendered(
        __name__,
        "live.html",
        library=web.library(),
        style=web.library_style(),
        plots=web.plots(),
        script=beside(__name__, "live.js"),
        data=text,
        curves=curves,
        dark=style.DARK,
    )
