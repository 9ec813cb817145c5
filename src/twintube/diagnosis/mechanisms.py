"""What may have happened: each mechanism with its strengths and what is known of their size before the data."""

import tomllib
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from importlib.resources import files
from typing import Any, Literal

import numpy as np
from scipy.stats import norm

from twintube.common.arrays import Array
from twintube.common.words import shown
from twintube.core.effects import EFFECTS
from twintube.diagnosis.channels import FAULTS, SOUGHT, TARED
from twintube.diagnosis.records.seen import TARE
from twintube.errors import InputError

Kind = Literal["half", "normal", "log", "place"]


@dataclass(frozen=True)
class Strength:
    """A parameter of a mechanism and its prior; in the coordinate u of a search it is a standard normal."""

    name: str
    kind: Kind
    scale: float  # [unit] of half and normal; standard deviation of the logarithm of log; ignored for place
    centre: float = 0.0
    low: float = -np.inf
    high: float = np.inf

    def value(self, u: float) -> float:
        """The parameter at the coordinate `u`."""
        if self.kind == "log":
            x = self.centre * np.exp(self.scale * u)
        elif self.kind == "place":
            x = self.low + (self.high - self.low) * norm.cdf(u)
        else:
            x = self.centre + self.scale * u
        return float(np.clip(x, self.low, self.high))

    def coordinate(self, value: float) -> float:
        """The coordinate of a value within its span."""
        low, high = self.span
        if self.kind == "log":
            u = np.log(max(value, 1e-300) / self.centre) / self.scale
        elif self.kind == "place":
            u = norm.ppf((value - self.low) / (self.high - self.low))
        else:
            u = (value - self.centre) / self.scale
        return float(np.clip(u, low, high))

    @property
    def span(self) -> tuple[float, float]:
        """The coordinates at the ends of its range."""
        if self.kind == "half":
            return 0.0, min(8.0, (self.high - self.centre) / self.scale)
        if self.kind == "normal":
            return max(-8.0, (self.low - self.centre) / self.scale), min(8.0, (self.high - self.centre) / self.scale)
        if self.kind == "log":
            low, high = (
                np.log(x / self.centre) / self.scale if 0 < x < np.inf else s * 4.0
                for x, s in ((self.low, -1), (self.high, 1))
            )
            return max(-4.0, low), min(4.0, high)
        return -3.0, 3.0


@dataclass(frozen=True)
class Mechanism:
    """A mechanism: `effect` is the name in an answer, `strengths` are searched."""

    effect: str
    way: str
    kind: str  # effect | fault
    strengths: tuple[Strength, ...]
    log_odds: float = 0.0
    parts: tuple["Mechanism", ...] = ()  # where two act at once

    @property
    def ends(self) -> tuple[Array, Array]:
        """The least and the largest coordinates (k,)."""
        low, high = zip(*(s.span for s in self.strengths), strict=True)
        return np.array(low), np.array(high)

    def about(self, base: Mapping[str, float]) -> "Mechanism":
        """The mechanism as a change of values that are there before."""
        return replace(self, strengths=tuple(replace(s, centre=base.get(s.name, s.centre)) for s in self.strengths))

    def values(self, u: Array) -> dict[str, float]:
        """The parameters at the coordinates (k,)."""
        return {s.name: s.value(float(x)) for s, x in zip(self.strengths, u, strict=True)}


META = {i.name: i.metadata for e in EFFECTS.values() for i in e.parameters}
KNOWN: dict[str, Any] = tomllib.loads(files("twintube.diagnosis").joinpath("strengths.toml").read_text(encoding="utf-8"))
# What every hypothesis leaves open beside fill and delay.
OPEN = tuple(
    Strength(name, known["prior"], known["scale"], META[name]["default"], META[name]["lower"], META[name]["upper"])
    for name, known in KNOWN.pop("open").items()
)
# Effect, way, parameter: prior and scale, see there.
STRENGTHS: dict[str, dict[str, dict[str, dict[str, Any]]]] = KNOWN


CATALOGUE = (*STRENGTHS, *SOUGHT, TARED)


def check(catalogue: Collection[str]) -> None:
    """Raise InputError unless a catalogue names effects and faults."""
    if isinstance(catalogue, str) or not catalogue:
        raise InputError(f"catalogue = {shown(catalogue)}: must be a list of some of {', '.join(CATALOGUE)}")
    for name in catalogue:
        if name not in CATALOGUE:
            raise InputError(f"catalogue: {shown(name)}: must be one of {', '.join(CATALOGUE)}")


def unit_of(name: str) -> str:
    """The unit of a strength."""
    return str(META[name]["unit"]) if name in META else "1" if name == TARE else FAULTS[name].unit


def effects(reach: float) -> list[Mechanism]:
    """The mechanisms of all effects in records that reach a stroke [m]: places beyond it would do nothing."""
    out = []
    for effect, ways in STRENGTHS.items():
        for way, several in ways.items():
            strengths = tuple(
                Strength(name, known["prior"], known.get("scale", 0.0), meta["default"], *ends(known["prior"], meta, reach))
                for name, known in several.items()
                for meta in (META[name],)
            )
            out.append(Mechanism(effect, way, "effect", strengths, -float(np.log(len(ways)))))
    return out


def ends(prior: Kind, meta: Mapping[str, Any], reach: float) -> tuple[float, float]:
    """The range of a parameter."""
    low, high = meta["lower"], meta["upper"]
    return (max(low, -reach), min(high, reach)) if prior == "place" and low < reach < high else (low, high)


def faults(peak: float, longest: float, rubbing: float) -> list[Mechanism]:
    """The faults of the channels; `peak` [N] and `longest` [s] of the records, `rubbing` [1] friction over gas force."""
    several = [
        Mechanism(name, name, "fault", (Strength(name, "normal", by * f.prior, f.neutral, by * f.low, by * f.high),))
        for name, f in SOUGHT.items()
        for by in (f.times(peak, longest),)
    ]
    # The force at rest lies anywhere between the gas force less and more friction.
    tared = Mechanism(TARED, TARED, "fault", (Strength(TARE, "normal", rubbing / np.sqrt(3.0), 1.0),))
    return [*several, tared]


def both(a: Mechanism, b: Mechanism) -> Mechanism:
    """Two mechanisms that act at once."""
    kind = "effect" if "effect" in (a.kind, b.kind) else "fault"
    way = f"{a.way}+{b.way}"
    return Mechanism(f"{a.effect}+{b.effect}", way, kind, a.strengths + b.strengths, a.log_odds + b.log_odds, (a, b))
