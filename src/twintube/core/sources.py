"""The files of the equations in calling order: the only list for the compiler, the translation to C and the fingerprints."""

from pathlib import Path

from twintube.core import effects, hooks
from twintube.core.publishing import publishing_source

FOLDER = Path(__file__).parent
KERNEL = (
    "kernel/forces.py",
    "kernel/prepare.py",
    "kernel/rebound.py",
    "kernel/compression.py",
    "kernel/step.py",
    "frame.py",
    "outputs.py",
)
AGREEMENT = "agreement.py"
RULES = "consistency.py"
MODEL = "model.py"


def text_of(name: str) -> str:
    """The text of a file of this folder."""
    return (FOLDER / name).read_text(encoding="utf-8")


def kernel_texts() -> list[str]:
    """The paper's equations, the force at the valves and the outputs."""
    return [*(text_of(name) for name in KERNEL), publishing_source()]


def effect_texts() -> list[str]:
    """The effects' files, and the functions that this package generates from them."""
    return [*hooks.helpers().values(), *hooks.sources().values(), hooks.dispatch_source(), hooks.reset_source(effects.State)]


def model_text() -> str:
    """The kernel with the effects around it."""
    return text_of(MODEL)


def agreement_text() -> str:
    """Whether a velocity belongs to its stroke."""
    return text_of(AGREEMENT)


def rule_text() -> str:
    """What must hold between parameters; the engine leaves it to the interpreter."""
    return text_of(RULES)
