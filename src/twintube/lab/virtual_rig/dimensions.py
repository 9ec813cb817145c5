"""Data of the virtual damper from the literature, SI units: published dimensions, component lengths, F-v design forces.

Nothing here comes from `twintube` or was calibrated with it. Values without a source are marked "assumed".
"""

from collections.abc import Mapping
from typing import NamedTuple


class Dimensions(NamedTuple):
    """Published for the eight dampers: Schramm, Zwosta, Prokop, Vehicles 2025, 7(1), 26, Table 5; V_oil from its Table 2."""

    D_a: float  # [m] inner diameter of the outer tube: the oil of Table 2 would not fit if it were the outer diameter
    D_PR: float  # [m] piston rod
    D_li: float  # [m] inner diameter of the inner tube
    D_la: float  # [m] outer diameter of the inner tube
    h_l: float  # [m] length of the inner tube
    V_oil: float  # [m3] oil of the intact damper


class Lengths(NamedTuple):
    """Lengths [m] of the components in the inner tube; a rebound stop fills its length of the chamber."""

    foot_valve: float  # in the lower end of the tube
    piston: float  # with valve discs, springs and nut
    rebound_stop: float  # on the rod, between piston and rod guide
    rod_guide: float  # its plug in the upper end of the tube

    @property
    def total(self) -> float:
        """Length that the strokes cannot use [m]."""
        return sum(self)


class Forces(NamedTuple):
    """F-v points that valves are sized for, (velocity [m/s], rebound force [N], compression force [N])."""

    slow: tuple[float, float, float]
    fast: tuple[float, float, float]


DIMENSIONS: Mapping[str, Dimensions] = {
    "SA1": Dimensions(45.5e-3, 22e-3, 32.0e-3, 34.80e-3, 326.0e-3, 321e-6),  # Golf VI, front
    "SA2": Dimensions(41.2e-3, 13e-3, 29.9e-3, 32.00e-3, 277.9e-3, 264e-6),  # Golf VI, rear
    "SA3": Dimensions(50.2e-3, 25e-3, 35.9e-3, 38.65e-3, 326.0e-3, 371e-6),  # Passat B6, front
    "SA4": Dimensions(41.2e-3, 13e-3, 30.0e-3, 32.00e-3, 277.9e-3, 239e-6),  # Passat B6, rear
    "SA5": Dimensions(46.6e-3, 25e-3, 36.0e-3, 38.60e-3, 328.0e-3, 332e-6),  # Caddy III, front
    "SA6": Dimensions(38.0e-3, 14e-3, 27.0e-3, 29.00e-3, 225.7e-3, 153e-6),  # Caddy III, rear
    "SA7": Dimensions(50.0e-3, 25e-3, 35.8e-3, 38.60e-3, 326.0e-3, 354e-6),  # Passat B8, front
    "SA8": Dimensions(41.4e-3, 13e-3, 29.8e-3, 32.10e-3, 331.0e-3, 273e-6),  # Passat B8, rear
}

# [m] thinnest rod of a strut; a damper that does not guide a wheel usually has 11 mm (myengineerings.com/mcpherson-strut).
STRUT_ROD = 18e-3

# Component lengths: assumed. A piston disc is 10 mm high (Piston.mo of the engineering thesis published as
# Czesiek1701/Modelica-Double-tube-shock-absorber); with valve discs, springs and the nut the piston is assumed to take 25 to
# 28 mm, foot valve and guide somewhat less than half a bore each, a rebound stop half a bore. In a strut the guide and the
# stop are longer, because the rod carries side forces between guide and piston (remembered from Reimpell, Stoll, Betzler,
# The Automotive Chassis, not looked up). The published oil volumes suggest short components: with 20 mm of overhang, a third
# of the reserve is left for the gas only if the sum is below 65 mm (SA4), 70 mm (SA6), 80 mm (SA3) or 95 mm (SA7, SA8). SA1,
# SA2 and SA5 would need less than 55 mm, so that their outer tubes must be longer.
REAR_LENGTHS = Lengths(foot_valve=12e-3, piston=25e-3, rebound_stop=15e-3, rod_guide=12e-3)
STRUT_LENGTHS = Lengths(foot_valve=12e-3, piston=28e-3, rebound_stop=25e-3, rod_guide=15e-3)

# Default car of IPG CarMaker (SuspF and SuspR, Damp_Push and Damp_Pull times their amplification), as an open-source test
# tool keeps it. Its front damper has the wheel's stroke, its rear damper 0.6 of it. Here the rear damper is at the wheel
# carrier (assumed), so that its forces are those at the wheel: velocities divided by 0.6, forces times 0.6, linear between.
STRUT_FORCES = Forces(slow=(0.13, 700.0, 300.0), fast=(1.04, 2300.0, 1600.0))
REAR_FORCES = Forces(slow=(0.13, 546.0, 344.0), fast=(1.04, 2628.0, 819.0))


def is_strut(D_PR: float) -> bool:
    """Whether a rod of this diameter [m] guides a wheel."""
    return D_PR >= STRUT_ROD


def default_lengths(D_PR: float) -> Lengths:
    """Component lengths of a strut or of a rear damper."""
    return STRUT_LENGTHS if is_strut(D_PR) else REAR_LENGTHS


def default_forces(D_PR: float) -> Forces:
    """F-v points of a strut or of a rear damper."""
    return STRUT_FORCES if is_strut(D_PR) else REAR_FORCES
