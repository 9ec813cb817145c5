"""Datasets with a hidden cause, from formulas of other sources than the model's effects: truth by other hands.

    write    the dataset of a seed and its truth
    CAUSES   what can be hidden, each in its formulations

`fluid`, `mechanics`, `oil` and `sensors` hold the physics of the causes, `catalogue` their ranges, `plan` what a test
engineer decides, `tolerance` what a careful bench cannot exclude. Seeds 0 to 9999 are for development.
"""

from worlds.challenge.catalogue import CAUSES
from worlds.challenge.generate import cause_of, write

__all__ = ["CAUSES", "cause_of", "write"]
