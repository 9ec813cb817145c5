"""The answer of a diagnosis; `as_json` is the contract of diagnosis.json."""

from dataclasses import dataclass, field
from typing import Any

from twintube.arrays import Array
from twintube.core.effects import EFFECTS
from twintube.dampers import Damper
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES

VERDICTS = ("cause", "none", "recalibrate", "ambiguous", "unexplained", "measurement_fault")


@dataclass(frozen=True)
class Signature:
    """What the records show of a cause outside the catalogue: name, a sentence, and the force RMS [N] that it explains.

    What repeats in every oscillation is an error of the base model, what does not counts as noise.
    """

    name: str
    text: str
    size: float
    repeats: bool = False


@dataclass(frozen=True)
class Estimate:
    """A parameter of a cause with its interval (90 %) and the range it was sought in; SI units."""

    value: float
    low: float
    high: float
    unit: str
    bounds: tuple[float, float] | None = None  # None: it was not sought but read off
    neutral: float | None = None  # value at which the cause is absent

    @property
    def at_bound(self) -> bool:
        """Whether the value lies at an end of its range that is not its neutral value."""
        if self.bounds is None:
            return False
        low, high = self.bounds
        near = RULES.at_bound * (high - low)
        absent = self.neutral in (low, high) and abs(self.value - self.neutral) < near
        return min(self.value - low, high - self.value) < near and not absent

    def acts(self, least: float) -> bool:
        """Whether a strength is off its neutral value by more than `least` and more than its interval."""
        absent = self.neutral or 0.0
        return abs(self.value - absent) > least and not self.low <= absent <= self.high

    @property
    def determined(self) -> bool:
        """Whether the records determine the value: its interval is narrow against its range."""
        return self.bounds is None or self.high - self.low <= RULES.wide * (self.bounds[1] - self.bounds[0])

    @property
    def doubt(self) -> str:
        """Why the value is not to be relied on; empty without a reason."""
        if self.at_bound and self.bounds is not None:
            unit = f" {self.unit}" if self.unit not in ("", "1") else ""
            return f"at the end of its range, {self.bounds[0]:g} to {self.bounds[1]:g}{unit}"
        return "" if self.determined else "not determined by these records"


@dataclass(frozen=True)
class Gain:
    """Share of the explainable squared force error (base minus noise floor) that goes away."""

    fit: float
    heldout: float
    heldout_interval: tuple[float, float]  # by resampling the records
    worst_record: float  # of those held out


def known(strength: Estimate) -> bool:
    """Whether a strength was read off, or acts and lies inside its range."""
    return strength.bounds is None or (strength.acts(0.0) and not strength.at_bound)


@dataclass(frozen=True)
class Cause:
    """An effect or fault that was identified; the largest comes first."""

    effect: str  # a name of the contract
    title: str
    explanation: str  # a sentence
    parameters: dict[str, Estimate]
    gain: Gain  # of the model with all causes; of a fault that was put right, of that alone

    @property
    def determined(self) -> dict[str, Estimate]:
        """The parameters that the records determine: strengths that act, and others whose value is not in doubt."""
        effect = EFFECTS.get(self.effect)
        strengths = effect.strength if effect else tuple(self.parameters)
        return {name: f for name, f in self.parameters.items() if (known(f) if name in strengths else not f.doubt)}

    @property
    def undetermined(self) -> list[str]:
        """The names of the other parameters."""
        return [name for name in self.parameters if name not in self.determined]


@dataclass(frozen=True)
class Alternative:
    """A candidate that explains the data about as well as the named cause."""

    effect: str
    heldout_gain: float  # share of the explainable squared error, as of the causes
    separable_by: str


@dataclass(frozen=True)
class Tried:
    """A candidate in a round of the selection."""

    round: int
    effect: str
    heldout_gain: float  # of the explainable error, against the model of the round before
    interval: tuple[float, float]
    decision: str  # chosen | rejected
    reason: str


@dataclass(frozen=True)
class Map:
    """Root mean square of the residual of all records over bins of a quantity."""

    quantity: str  # stroke, velocity, acceleration, time, cycle, dissipated energy, oil level, frequency
    unit: str
    centres: Array  # (b,)
    base: Array  # (b,) [N], NaN where a bin is empty
    extended: Array
    noise: Array
    mean: Array  # (b,) mean residual of the base model [N]: its sign


@dataclass(frozen=True)
class RecordResult:
    """A record: measured and simulated mean forces (n,) over its intervals, and errors [N]."""

    record: PreparedRecord
    split: str  # fit | heldout | left_out
    measured: Array
    base: Array
    recalibrated: Array
    extended: Array
    weight: Array  # (n,) 1 over the standard deviation [1/N] of each interval, 0 where it is not compared

    def rms(self, force: Array) -> float:
        """Error of a simulation [N]; an interval counts by its uncertainty."""
        return float((((self.weight * (force - self.measured)) ** 2).sum() / (self.weight**2).sum()) ** 0.5)

    @property
    def noise(self) -> float:
        """The error [N] that noise, sampling and the model's steps leave."""
        return float(((self.weight > 0).sum() / (self.weight**2).sum()) ** 0.5)


@dataclass(frozen=True)
class Errors:
    """Force and work errors over some records."""

    force_rmse_N: float
    work_rmse_J: float


@dataclass(frozen=True)
class Diagnosis:
    """The whole answer."""

    title: str
    verdict: str
    sentence: str
    causes: list[Cause]
    alternatives: list[Alternative]
    errors: dict[str, dict[str, Errors]]  # split (fit, heldout) -> base, recalibrated, extended, noise_floor
    where: str
    signature: str  # of what no candidate explains; empty if nothing is left
    maps: list[Map]
    tried: list[Tried]
    records: list[RecordResult]
    base: Damper
    recalibrated: Damper
    extended: Damper
    next_measurements: list[str]
    structure: dict[str, list[str]]  # base, recalibrated, extended -> records in which its residual is more than white noise
    probabilities: dict[str, float]  # of every candidate, fault, none, recalibrate and unknown, the largest first
    remarks: list[str] = field(default_factory=list)
    seconds: float = 0.0
    tolerance: float = 0.0  # accepted error of a good damper, share of each record's largest force
    left_out: list[RecordResult] = field(default_factory=list)  # records that do not belong, by the base model


def as_json(d: Diagnosis) -> dict[str, Any]:
    """The entries of diagnosis.json."""
    heldout = d.errors["heldout"]
    return {
        "verdict": d.verdict,
        "tolerance": d.tolerance,
        "sentence": d.sentence,
        "causes": [
            {
                "effect": c.effect,
                "parameters": {
                    name: {"value": f.value, "interval": [f.low, f.high], "unit": f.unit, "doubt": ""}
                    for name, f in c.determined.items()
                },
                "undetermined": c.undetermined,
                "gain": {
                    "fit": c.gain.fit, "heldout": c.gain.heldout, "heldout_interval": list(c.gain.heldout_interval),
                    "worst_record": c.gain.worst_record,
                },
            }
            for c in d.causes
        ],
        "alternatives": [
            {"effect": a.effect, "heldout_gain": a.heldout_gain, "separable_by": a.separable_by} for a in d.alternatives
        ],
        "error": {name: vars(value) for name, value in heldout.items()},
        "error_fit": {name: vars(value) for name, value in d.errors["fit"].items()},
        "where": d.where,
        "probabilities": d.probabilities,
        "signature": d.signature,
        "structure": d.structure,
        "tried": [vars(t) | {"interval": list(t.interval)} for t in d.tried],
        "records": [
            {
                "record": r.record.name, "split": r.split, "oil_level": r.record.oil_level, "top_speed": r.record.top_speed,
                "base_rmse_N": r.rms(r.base), "recalibrated_rmse_N": r.rms(r.recalibrated),
                "extended_rmse_N": r.rms(r.extended), "noise_N": r.noise,
            }
            for r in d.records
        ],
        "left_out": [
            {"record": r.record.name, "base_rmse_N": r.rms(r.base), "noise_N": r.noise} for r in d.left_out
        ],
        "next_measurements": d.next_measurements,
        "remarks": d.remarks,
        "seconds": d.seconds,
    }  # fmt: skip
