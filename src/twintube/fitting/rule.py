"""Thresholds as records: value, unit, reason and on what they were tuned; from which the docs' tables are generated."""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from typing import Any, TypeVar

T = TypeVar("T")

# On what a value was tuned.
STATISTICS = "statistics"  # a stated rate of errors
METHOD = "follows from the method"
NUMERICS = "numerics"
TRIALS = "blind_trials, seeds 100 to 109"
DEVELOPMENT = "foreign datasets and challenge, development seeds"
LIKELIHOOD = "maximum likelihood, challenge, development seeds"
JUDGEMENT = "judgement"
NOT_RECORDED = "not recorded"


@dataclass(frozen=True)
class Rule:
    """A threshold as the documentation shows it."""

    section: str
    name: str
    value: Any
    unit: str
    why: str
    tuned_on: str


class Section:
    """Makes the fields of a frozen dataclass of thresholds; `unit` is "1" for shares and factors, "" for counts."""

    def __init__(self, title: str) -> None:
        self.title = title

    def __call__(self, value: T, unit: str, why: str, tuned_on: str) -> T:
        """The field of a threshold."""
        metadata = {"section": self.title, "unit": unit, "why": why, "tuned_on": tuned_on}
        threshold: T = field(default=value, metadata=metadata)
        return threshold


def listed(rules: Any) -> Iterator[Rule]:
    """The thresholds of such a dataclass, in its order."""
    for item in fields(rules):
        yield Rule(name=item.name, value=getattr(rules, item.name), **item.metadata)


def markdown(*several: Any) -> str:
    """Tables of all thresholds of such dataclasses, one per section."""
    lines: list[str] = []
    title = ""
    for rules in several:
        for rule in listed(rules):
            if rule.section != title:
                title = rule.section
                lines += ["", f"**{title}**", "", "| rule | value | why | tuned on |", "|---|---|---|---|"]
            lines.append(f"| `{rule.name}` | {shown(rule.value)}{unit(rule)} | {rule.why} | {rule.tuned_on} |")
    return "\n".join(lines[1:]) + "\n"


def shown(value: Any) -> str:
    """A value as text."""
    if isinstance(value, tuple):
        return ", ".join(shown(x) for x in value)
    return f"{value:.4g}" if isinstance(value, float) else f"{value}"


def unit(rule: Rule) -> str:
    """The unit behind a value."""
    return f" {rule.unit}" if rule.unit not in ("", "1") else ""
