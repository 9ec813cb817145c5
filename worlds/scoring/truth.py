"""What is hidden in a dataset. Every world writes the same truth.json; `Truth` is the part of it that scores read."""

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from twintube.errors import UserError

KINDS: Final = ("none", "state", "effect", "fault", "outside")
OUTSIDE: Final = "outside:"  # before the name of a cause that no catalogue has
UNKNOWN: Final = "unknown"  # the name with which an answer says that no cause of its catalogue fits


class TruthError(UserError):
    """A truth.json that cannot be read; the message names file and entry."""


@dataclass(frozen=True)
class Truth:
    """What is hidden; figures that a world does not tell are None."""

    world: str
    seed: int
    damper: str
    kind: str  # one of KINDS
    causes: tuple[str, ...]  # `none`, one name, or two that act at once
    also_fits: tuple[str, ...] = ()  # other names for the same in a reader's catalogue
    effect_over_noise: float | None = None  # RMS of the change of force over that of the noise
    oil_level: float | None = None  # [1] of the later records, at their end
    gas_preload: bool | None = None
    stated_as_full: bool | None = None  # whether the file calls that state full with preload; else it tells nothing
    level_seen: bool | None = None  # whether the force shows another oil level through the noise

    @property
    def wanted(self) -> frozenset[str]:
        """The causes by the names of an answer."""
        return frozenset(UNKNOWN if name.startswith(OUTSIDE) else name for name in self.causes)

    @property
    def names(self) -> frozenset[str]:
        """All names that are right."""
        return self.wanted | frozenset(self.also_fits)


def number(entry: Mapping[str, Any], key: str, place: str) -> float | None:
    """A finite figure that is not below 0, or None where there is none."""
    value = entry.get(key)
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value) or value < 0.0:
        raise TruthError(f"{place}: {key} = {value!r}: must be a number of at least 0")
    return float(value)


def flag(entry: Mapping[str, Any], key: str, place: str) -> bool | None:
    """True, false or None where nothing is told."""
    value = entry.get(key)
    if value is not None and not isinstance(value, bool):
        raise TruthError(f"{place}: {key} = {value!r}: must be true or false")
    return value


def texts(entry: Mapping[str, Any], key: str, place: str) -> tuple[str, ...]:
    """A list of names."""
    value = entry.get(key, [])
    if not isinstance(value, list) or not all(isinstance(item, str) and item for item in value):
        raise TruthError(f"{place}: {key} = {value!r}: must be a list of names")
    return tuple(value)


def truth_of(entry: Mapping[str, Any], place: str) -> Truth:
    """The truth in the entries of truth.json; raises TruthError."""
    kind, causes = entry.get("kind"), texts(entry, "causes", place)
    if kind not in KINDS:
        raise TruthError(f"{place}: kind = {kind!r}: must be one of {', '.join(KINDS)}")
    if not causes:
        raise TruthError(f"{place}: causes: must name what is hidden, or none")
    if (kind == "none") != (causes == ("none",)):
        raise TruthError(f"{place}: kind = {kind!r} beside causes = {list(causes)}: only nothing is none")
    return Truth(
        world=str(entry.get("world", "")), seed=int(entry.get("seed", -1)), damper=str(entry.get("damper", "")), kind=kind,
        causes=causes, also_fits=texts(entry, "also_fits", place), oil_level=number(entry, "oil_level", place),
        gas_preload=flag(entry, "gas_preload", place), stated_as_full=flag(entry, "stated_as_full", place),
        level_seen=flag(entry, "level_seen", place), effect_over_noise=number(entry, "effect_over_noise", place),
    )  # fmt: skip


def read_truths(path: Path) -> dict[str, Truth]:
    """The truths in a file by the name of their dataset: one under "", or a table of several."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise TruthError(f"{path}: {error}") from error
    if not isinstance(content, dict) or not content:
        raise TruthError(f"{path}: must hold a truth, or a table of truths by dataset")
    if "kind" in content:
        return {"": truth_of(content, str(path))}
    several = {name: entry for name, entry in content.items() if isinstance(entry, dict)}
    if len(several) != len(content):
        raise TruthError(f"{path}: kind: missing")
    return {name: truth_of(entry, f"{path}, {name}") for name, entry in several.items()}
