"""Titles of effects and faults and descriptions of their parameters, for pages."""

from dataclasses import fields

from twintube.core.effects import EFFECTS, Parameters
from twintube.diagnosis.candidates import FAULT_TITLES


def is_share(effect: str, parameter: str) -> bool:
    """Whether a dimensionless parameter is shown in percent: yes for effects, except exponents; no for faults (factors)."""
    return effect in EFFECTS and "power" not in parameter


def title_of(effect: str) -> str:
    """Title of a candidate; several at once are joined by +."""
    titles = {name: item.title for name, item in EFFECTS.items()} | FAULT_TITLES
    return " + ".join(titles.get(name, name.replace("_", " ").capitalize()) for name in effect.split("+"))


def meaning(name: str) -> str:
    """Description of a model parameter; empty for other names."""
    return next((str(item.metadata["description"]) for item in fields(Parameters) if item.name == name), "")
