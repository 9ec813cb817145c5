"""The fourteen degradation parameters, by the tables of the paper, and the ranges in which they are sought."""

from collections.abc import Sequence
from dataclasses import fields

import numpy as np

from twintube.common.arrays import Array
from twintube.core import effects

TABLE_6 = ("X_Re", "L_PV", "G_PV", "X_Co1", "X_Co2")
TABLES_7_8 = ("S_BV", "S_BVoil", "S_PV", "S_PVoil", "B", "E", "v_cav", "Y_Co_cav", "Y_Re_cav")
DEGRADATION = (*TABLE_6, *TABLES_7_8)
FASTER = 1.2  # of the fastest record: a cavitation threshold above every measured velocity acts like none


def ranges(names: Sequence[str], fastest: float) -> Array:
    """Lower and upper bounds (k, 2) of parameters for records up to the velocity `fastest` [m/s]."""
    table = {item.name: item.metadata for item in fields(effects.Parameters)}
    above = {"v_cav": FASTER * fastest}
    return np.array([(table[n]["lower"], min(table[n]["upper"], above.get(n, np.inf))) for n in names], dtype=float)
