"""Datasets with a hidden cause, from formulas of other sources than the model's effects: truth by other hands.

    write    the dataset of a seed and its truth
    CAUSES   what can be hidden, each in its formulations

`march` drives the paper's kernel; `fluid`, `mechanics`, `oil` and `sensors` hold the physics of the causes, `excitation` and
`plan` what a bench does, `sampling` and `files` how it comes into a folder. Seeds 0 to 9999 are for development.
"""

from twintube.lab.challenge.catalogue import CAUSES
from twintube.lab.challenge.generate import cause_of, write

__all__ = ["CAUSES", "cause_of", "write"]
