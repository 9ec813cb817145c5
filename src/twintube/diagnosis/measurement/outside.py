"""What the records show of a cause that is in no catalogue."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Signature:
    """What the records show of a cause outside the catalogue: name, a sentence, and the force RMS [N] that it explains.

    What repeats in every oscillation may be of the model, too; what does not counts as noise.
    """

    name: str
    text: str
    size: float
    repeats: bool = False
