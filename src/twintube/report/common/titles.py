"""Titles of effects and faults, descriptions of their parameters, steps of a diagnosis, for pages and terminals."""

from dataclasses import fields

from twintube.common.words import lower
from twintube.core.effects import EFFECTS, Parameters
from twintube.diagnosis.channels import FAULTS


def title_of(effect: str) -> str:
    """Title of a candidate; several at once are joined by +."""
    titles = {name: item.title for known in (EFFECTS, FAULTS) for name, item in known.items()}
    return " + ".join(titles.get(name, name.replace("_", " ").capitalize()) for name in effect.split("+"))


def meaning(name: str) -> str:
    """Description of a parameter of the model or of the measurement; empty for other names."""
    described = (str(item.metadata["description"]) for item in fields(Parameters) if item.name == name)
    return next(described, FAULTS[name].means if name in FAULTS else "")


def in_words(step: str) -> str:
    """A step that a diagnosis reports, such as `a single cause: force_gain`, with the title of what is tried."""
    head, _, name = step.rpartition(": ")
    if head in ("a single cause", "two causes"):
        return f"trying: {lower(title_of(name))}"
    return step
