"""Datasets with a hidden cause, from formulas of other sources than the model's effects: truth by other hands.

    write     the dataset of a seed of the challenge and its truth: strengths by the noise
    workshop  the same with strengths of practice, in every file format
    CAUSES    what can be hidden, each in its formulations

`fluid`, `mechanics`, `oil` and `sensors` hold the physics of the causes, `catalogue` their ranges, `practice` the strengths
of practice, `plan` what a test engineer decides. Seeds 0 to 9999 are for development.
"""

from worlds.challenge.catalogue import CAUSES
from worlds.challenge.generate import cause_of, workshop, write

__all__ = ["CAUSES", "cause_of", "workshop", "write"]
