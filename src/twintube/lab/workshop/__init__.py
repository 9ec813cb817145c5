"""Datasets as a damper laboratory or a workshop writes them, each with a hidden cause, two, or none: truth by other hands.

Its author knew the paper's kernel and the file formats, and had opened neither `core.effects` nor `diagnosis` nor the other
generators. Strengths are those of practice: they do not go by the noise.

    write    the dataset of a seed and its truth

`plan` is the day in the laboratory, `motions` what the rig does, `bench` the damper and the recorder, `cause` what a cause
may touch; `fluid_causes`, `other_causes` and `faults` hold the formulas, `strengths` and `fault_strengths` their sizes,
`catalogue` which seed hides what, `files` what loggers write. Seeds 1 to 60 were looked at.
"""

from twintube.lab.workshop.write import write

__all__ = ["write"]
