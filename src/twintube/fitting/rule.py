"""Thresholds as records: value, unit, reason and on what they were tuned."""

from dataclasses import field
from typing import TypeVar

T = TypeVar("T")

# On what a value was tuned.
STATISTICS = "statistics"  # a stated rate of errors
METHOD = "follows from the method"
NUMERICS = "numerics"
TRIALS = "blind_trials, seeds 100 to 109"
DEVELOPMENT = "foreign datasets and challenge, development seeds"
JUDGEMENT = "judgement"
NOT_RECORDED = "not recorded"


class Section:
    """Makes the fields of a frozen dataclass of thresholds; `unit` is "1" for shares and factors, "" for counts."""

    def __init__(self, title: str) -> None:
        self.title = title

    def __call__(self, value: T, unit: str, why: str, tuned_on: str) -> T:
        """The field of a threshold."""
        metadata = {"section": self.title, "unit": unit, "why": why, "tuned_on": tuned_on}
        threshold: T = field(default=value, metadata=metadata)
        return threshold
