"""Datasets as a damper laboratory or a workshop writes them, each with a hidden cause, two, or none: truth by other hands.

The formulas are of another author than those of the challenge, who had not seen the model's effects. Strengths are those of
practice: they do not go by the noise.

`plan` is the day in the laboratory, `fluid` and `others` hold the formulas, `sizes` their strengths, `catalogue` which seed
hides what, `generate` writes a dataset. Seeds 1 to 60 were looked at.
"""

from worlds.workshop.generate import write

__all__ = ["write"]
