"""What an effect is easily taken for: the effects that act on the same part of the force, and every fault of a channel."""

import re

from twintube.core.effects import EFFECTS
from twintube.core.hook_table import HOOKS
from twintube.core.hooks import sources
from twintube.diagnosis.mechanisms import CATALOGUE

# The hooks by which an effect changes a part.
ACTS_ON = {
    "volumes of oil, foam and gas": {"derive", "level", "scale_cavitation", "phases", "flows", "lost"},
    "fluid force": {
        "parts", "motion", "transition", "scale_fluid", "scale_valve", "bypass", "series", "felt", "rebalance", "force", "finish",
        "warming",
    },
    "friction": {"scale_friction", "rub"},
    "gas force": {"elastic"},
}  # fmt: skip


def parts(effect: str) -> set[str]:
    """The parts of the force on which an effect acts."""
    hooks = set(re.findall(rf"^def {effect}_(\w+)\(", sources()[effect], re.MULTILINE)) & set(HOOKS)
    return {part for part, several in ACTS_ON.items() if hooks & several}


def look_alikes(effect: str) -> list[str]:
    """The catalogue of an effect: it, its look-alikes, and the faults."""
    return [name for name in CATALOGUE if name not in EFFECTS or parts(name) & parts(effect)]
