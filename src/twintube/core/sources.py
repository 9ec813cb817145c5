"""The files of the equations, in calling order: the one list for the compiler, the translation to C and the fingerprints."""

from pathlib import Path

from twintube.core import effects

FOLDER = Path(__file__).parent
KERNEL = (
    "kernel/prepare.py",
    "kernel/forces.py",
    "kernel/rebound.py",
    "kernel/compression.py",
    "kernel/step.py",
    "frame.py",
)
MODEL = "model.py"


def text_of(name: str) -> str:
    """The text of a file of this folder."""
    return (FOLDER / name).read_text(encoding="utf-8")


def kernel_texts() -> list[str]:
    """The paper's equations and the force at the valves."""
    return [text_of(name) for name in KERNEL]


def effect_texts() -> list[str]:
    """The effects' files, and the functions that this package generates from them."""
    return [*effects.sources().values(), effects.dispatch_source(), effects.reset_source()]


def model_text() -> str:
    """The kernel with the effects around it."""
    return text_of(MODEL)
