"""What a diagnosis says about a dataset, or why there is no answer."""

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np

from worlds.scoring.truth import UNKNOWN

CREDIBLE: Final = 0.9  # probability that the set must hold
ASSERTING: Final = ("cause", "measurement_fault")
ONE_NAME: Final = {
    "none": "none",
    "tolerance": "none",
    "recalibrate": "recalibrate",
    "state": "state",
    "unexplained": UNKNOWN,
}
ROUNDING: Final = 1e-3  # thirty probabilities of four digits


@dataclass(frozen=True)
class Fill:
    """The state of filling of some records."""

    level: float  # [1]
    low: float  # ends of its 90 % interval
    high: float
    gas_lost: float  # probability
    grid: tuple[tuple[float, ...], tuple[float, ...]] | None = None  # levels and the density there, where one is told


@dataclass(frozen=True)
class Answer:
    """An answer in names; of a pair each part is a name in `named`, and the probability belongs to `a+b`."""

    verdict: str  # of diagnosis.json; or `refused` by the reader of datasets, `failed`, `timeout`
    named: frozenset[str] = frozenset()  # what the verdict names, of an ambiguous one all that may be
    probabilities: Mapping[str, float] = field(default_factory=dict)
    credible: tuple[str, ...] = ()  # the smallest set that holds 90 %
    fills: tuple[Fill, ...] = ()
    seconds: float | None = None
    reason: str = ""  # why there is no answer

    @property
    def given(self) -> bool:
        """Whether there is an answer."""
        return self.verdict not in ("refused", "failed", "timeout")

    @property
    def only_fill(self) -> bool:
        """Whether nothing but the fill was asked: of causes nothing is said then."""
        return self.verdict == "state" and not self.probabilities

    @property
    def alone(self) -> bool:
        """Whether the verdict stands by one answer."""
        return self.given and self.verdict != "ambiguous"


def smallest_set(probabilities: Mapping[str, float]) -> tuple[str, ...]:
    """The likeliest names that hold CREDIBLE of the probability together."""
    order = sorted(probabilities, key=lambda name: -probabilities[name])
    held = np.cumsum([probabilities[name] for name in order])
    return tuple(order[: int(np.searchsorted(held, CREDIBLE - 1e-9)) + 1])


def parts(names: Iterable[str]) -> frozenset[str]:
    """The names in some, pairs taken apart."""
    return frozenset(part for name in names for part in name.split("+"))


def fill_of(entry: Mapping[str, Any]) -> Fill:
    """A state of filling."""
    level = entry["oil_level"]
    low, high = map(float, level["interval"])
    grid = level.get("grid")
    told = None if grid is None else (tuple(map(float, grid["level"])), tuple(map(float, grid["density"])))
    if told is not None and (len(told[0]) != len(told[1]) or len(told[0]) < 2):
        raise ValueError("oil_level.grid: level and density must be as long as each other, two at least")
    fill = Fill(float(level["value"]), low, high, float(entry["gas_lost"]), told)
    if not all(map(math.isfinite, (fill.level, low, high, fill.gas_lost))) or low > high or not 0.0 <= fill.gas_lost <= 1.0:
        raise ValueError(f"state: oil_level {fill.level} in [{low}, {high}], gas_lost {fill.gas_lost}")
    return fill


def answer_of(content: Mapping[str, Any]) -> Answer:
    """The answer in the entries of diagnosis.json; raises KeyError, TypeError or ValueError where it is none."""
    verdict = str(content["verdict"])
    probabilities = {str(item["name"]): float(item["probability"]) for item in content.get("hypotheses", [])}
    if not all(0.0 <= p <= 1.0 for p in probabilities.values()):  # NaN is not, either
        raise ValueError("a probability is not between 0 and 1")
    credible = tuple(content.get("credible_set") or smallest_set(probabilities))
    causes = [item["effect"] for item in content.get("causes", [])]
    if verdict in ASSERTING:
        named = causes or list(credible)
    elif verdict in ONE_NAME:
        named = [ONE_NAME[verdict]]
    elif verdict == "ambiguous":
        named = list(credible)
    else:
        raise ValueError(f"verdict {verdict!r}")
    seconds = content.get("seconds")
    return Answer(
        verdict, parts(named), probabilities, credible, tuple(map(fill_of, content.get("state", []))),
        None if seconds is None else float(seconds),
    )  # fmt: skip


def read_answer(folder: Path) -> Answer:
    """The answer in a folder. What cannot be read, or was never written, is a failure and counts as one."""
    path = folder / "diagnosis.json"
    if not path.is_file():
        return Answer("failed", reason="no diagnosis.json")
    try:
        return answer_of(json.loads(path.read_text(encoding="utf-8")))
    except (OSError, KeyError, TypeError, ValueError, AttributeError) as error:
        return Answer("failed", reason=f"{path.name}: {type(error).__name__}: {error}")


def contradictions(answer: Answer) -> list[str]:
    """Where verdict and probabilities of an answer disagree."""
    p = answer.probabilities
    if not p:
        return []
    remarks = []
    if abs(sum(p.values()) - 1.0) > ROUNDING:
        remarks.append(f"probabilities sum to {sum(p.values()):.4g}")
    held = sum(p.get(name, 0.0) for name in answer.credible)
    if held < CREDIBLE - ROUNDING:
        remarks.append(f"the set holds {held:.3g}")
    top = max(p, key=lambda name: p[name])
    verdict = max((share for name, share in p.items() if parts([name]) <= answer.named), default=0.0)
    if answer.alone and p[top] > verdict + ROUNDING:
        remarks.append(f"{answer.verdict} is less likely than {top}")
    return remarks
