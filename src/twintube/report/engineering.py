"""Titles of effects and faults, descriptions of their parameters, steps of a diagnosis, for pages and terminals."""

from dataclasses import fields

from twintube.core.effects import EFFECTS, Parameters
from twintube.diagnosis.fits.candidates import FAULT_TITLES, RECALIBRATE
from twintube.diagnosis.records.seen import CARRIED, FILL, INERTIA
from twintube.diagnosis.verdict.verdict import lower


def is_share(effect: str, parameter: str) -> bool:
    """Whether a dimensionless parameter is shown in percent: yes for effects' shares; no for faults (factors)."""
    return effect in EFFECTS and "power" not in parameter and parameter != CARRIED


def title_of(effect: str) -> str:
    """Title of a candidate; several at once are joined by +."""
    titles = {name: item.title for name, item in EFFECTS.items()} | FAULT_TITLES | {RECALIBRATE: "Other known parameters"}
    return " + ".join(titles.get(name, name.replace("_", " ").capitalize()) for name in effect.split("+"))


MEASURED = {
    "force_offset": "measured less true force",
    "force_gain": "measured over true force",
    "stroke_gain": "measured over true stroke",
    "time_base": "recorded over true time",
    "channel_delay": "by which the force is later than the stroke",
    "zero_drift": "rise of the zero with time, at first",
    "zero_settling": "rate at which this rise settles; 0: it goes on",
    CARRIED: "oil lost in records before that is missing; 0: none, 1: of the same fill, 2: of all",
    "clock_error": "by which the clock of the force is fast",
    INERTIA: "moved between load cell and damper",
}


def meaning(name: str) -> str:
    """Description of a parameter of the model or of the measurement; empty for other names."""
    if name.startswith(FILL):
        return f"true less recorded fill, of the state with {name.removeprefix(FILL)} % oil"
    described = (str(item.metadata["description"]) for item in fields(Parameters) if item.name == name)
    return next(described, MEASURED.get(name, ""))


def in_words(step: str) -> str:
    """A step that a diagnosis reports, such as `a single cause: start of force_gain`, with the title of what is tried."""
    inside = "within the records: "
    if step.startswith(inside):
        return f"in the records that are left, {in_words(step.removeprefix(inside))}"
    head, _, name = step.rpartition(": ")
    name = name.removeprefix("start of ")
    title = lower(title_of(name))
    if head.startswith("a single cause"):
        return f"trying: {title}"
    if head.startswith("a further cause"):
        return f"trying another cause as well: {title}"
    if head.startswith("instead of "):
        return f"trying instead of {lower(title_of(head.removeprefix('instead of ')))}: {title}"
    if step.startswith("without "):
        return f"trying without {lower(title_of(step.removeprefix('without ')))}"
    return step
