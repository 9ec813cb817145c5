"""Variants of the model: parts switched off (variants 2 and 3 of Section 3.4), a scalar factor, another F-v curve."""

from twintube.dampers.curve import BRANCHES, continued
from twintube.dampers.damper import Damper

CAPACITY = 700.0  # [J/K] of a damper (assumed)
NO_FOAM = {"S_BV": 0.0, "S_PV": 0.0}
NO_CAVITATION = {"Y_Co_cav": 0.0, "Y_Re_cav": 0.0}


def scalar_factor(factor: float) -> dict[str, float]:
    """The parameters that scale the fluid force of a full damper: the usual shortcut for a worn one."""
    return {"oil_level": 1.0, "wear_re": factor - 1.0, "wear_co": factor - 1.0}


# Stand-in of a rear damper's F-v curve: rear axle of the Volvo XC90, from the source that the parameter sets take the front
# axle's from (DYNA4 vehicle data, RearAxle/Damper/SUV_Volvo_XC90.m), halved like it. Velocity [m/s], force [N].
REAR_REBOUND = ((0.04, 138.0), (0.104, 329.0), (0.208, 480.5), (0.312, 612.0), (0.416, 753.5), (0.832, 1326.0))
REAR_COMPRESSION = ((0.04, 207.5), (0.104, 447.5), (0.208, 510.0), (0.312, 559.5), (0.416, 612.0), (0.832, 875.5))


def rear_curve(damper: Damper) -> dict[str, tuple[float, ...]]:
    """The parameters that give a rear damper that curve; empty for a front damper or one whose curve is not a stand-in."""
    if "rear" not in damper.title.lower() or "fv" not in damper.assumed:
        return {}
    changes: dict[str, tuple[float, ...]] = {}
    for branch, points in (("rebound", REAR_REBOUND), ("compression", REAR_COMPRESSION)):
        v_name, F_name = BRANCHES[branch]
        v, F = zip(*continued(list(points)), strict=True)
        changes |= {v_name: v, F_name: F}
    return changes


def self_heating(fade: float) -> dict[str, float]:
    """The parameters by which the fluid force fades by `fade` [1/K] with the heat of the work, in CAPACITY [J/K]."""
    return {"fade_heat": fade / CAPACITY}
