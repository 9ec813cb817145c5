"""The oil level at which a damper no longer fills its working chambers: geometry, before any force is computed."""

from twintube.core.kernel import prepare
from twintube.core.variables import Derived, blank
from twintube.dampers.damper import Damper


def collapse_level(damper: Damper) -> float:
    """Oil level [1] below which the two working chambers are not full with the piston in the middle.

    The oil is then (A_1 + A_2) l / 2, where l = h_l - dead_length is the length left for both chambers. Above it a damper
    that moves little (on an inspection bench) works as an intact one, below it the piston draws gas. A stroke z to one side
    moves A_rod z of oil, which spreads the level. It is above 1 if the intact oil does not fill the chambers.
    """
    d: Derived = blank(Derived)
    prepare(damper.parameters, d)
    return float((d.A_1 + d.A_2) * d.half_length / damper.parameters.V_oil)
