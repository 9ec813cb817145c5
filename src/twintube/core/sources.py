"""The files of the damper's equations: the only list for the translation to C and what is compiled of it."""

from pathlib import Path

from twintube.core import effects, hooks
from twintube.core.publishing import publishing_source

FOLDER = Path(__file__).parent
BEFORE = (
    "variables.py",
    "kernel/temperature.py",
    "kernel/forces.py",
    "kernel/prepare.py",
    "kernel/rebound.py",
    "kernel/compression.py",
    "kernel/step.py",
    "frame.py",
    "outputs.py",
)
AFTER = ("model.py",)
RULES = ("agreement.py", "consistency.py")


def files() -> list[Path]:
    """The files of the damper's equations."""
    return [*(FOLDER / name for name in (*BEFORE, *AFTER, *RULES)), *FOLDER.glob("effects/*.py")]


def texts_of(*names: str) -> dict[str, str]:
    """Files of this folder by their paths in the package."""
    return {f"core/{name}": (FOLDER / name).read_text(encoding="utf-8") for name in names}


def kernel_texts() -> dict[str, str]:
    """The paper's equations by path."""
    return texts_of(*(name for name in BEFORE if name.startswith("kernel/")))


def rule_sources() -> dict[str, str]:
    """Whether a velocity belongs to its stroke, and what must hold between parameters, by path."""
    return texts_of(*RULES)


def damper_sources() -> dict[str, str]:
    """The table of variables, kernel, effects, model and rules, with the functions generated from the tables, by path."""
    return {
        **texts_of(*BEFORE),
        "outputs of core/variables.py": publishing_source(),
        **{f"core/effects/{name}.py": text for name, text in {**hooks.helpers(), **hooks.sources()}.items()},
        "hooks of core/effects": f"{hooks.dispatch_source()}\n\n{hooks.reset_source(effects.State)}",
        **texts_of(*AFTER),
        **rule_sources(),
    }
