"""Titles of effects and faults, descriptions of their parameters, steps of a diagnosis, for pages and terminals."""

from dataclasses import fields

from twintube.common.words import lower
from twintube.core.effects import EFFECTS, Parameters
from twintube.diagnosis.channels import FAULT_TITLES
from twintube.diagnosis.records.seen import INERTIA


def is_share(effect: str, parameter: str) -> bool:
    """Whether a dimensionless parameter is shown in percent: yes for effects' shares; no for faults (factors)."""
    return effect in EFFECTS and "power" not in parameter


def title_of(effect: str) -> str:
    """Title of a candidate; several at once are joined by +."""
    titles = {name: item.title for name, item in EFFECTS.items()} | FAULT_TITLES
    return " + ".join(titles.get(name, name.replace("_", " ").capitalize()) for name in effect.split("+"))


MEASURED = {
    "force_offset": "measured less true force",
    "force_gain": "measured over true force",
    "stroke_gain": "measured over true stroke",
    "time_base": "recorded over true time",
    "channel_delay": "by which the force is later than the stroke",
    "zero_drift": "rise of the zero with time, at first",
    "clock_error": "by which the clock of the force is fast",
    INERTIA: "moved between load cell and damper",
}


def meaning(name: str) -> str:
    """Description of a parameter of the model or of the measurement; empty for other names."""
    described = (str(item.metadata["description"]) for item in fields(Parameters) if item.name == name)
    return next(described, MEASURED.get(name, ""))


def in_words(step: str) -> str:
    """A step that a diagnosis reports, such as `a single cause: force_gain`, with the title of what is tried."""
    head, _, name = step.rpartition(": ")
    if head in ("a single cause", "two causes"):
        return f"trying: {lower(title_of(name))}"
    return step
