"""Statements of the paper with their verdicts, and figures with their statements, stand-ins and assumed values."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from matplotlib.figure import Figure

from twintube.claims import Claim
from twintube.report.common.style import STAND_IN

NOT_CHECKABLE = "not checkable"
VIRTUAL = (STAND_IN,)
# Unpublished values, named alike in pictures, page and JSON
FV = "F-v curve"
FRICTION = "friction"
GAS = "gas spring"
REACH = "maximum stroke"
SPEEDS = "block velocities"
DEAD = "dead length (calibrated)"
DRIVES = "strokes of the drives (quarter car, road, obstacles)"
HARMONIC = (FV, FRICTION, GAS, DEAD, REACH, SPEEDS)


def verdict(holds: Iterable[bool | None]) -> str:
    """`holds` if all that can be checked holds, `does not hold`, or `not checkable`."""
    checked = [each for each in holds if each is not None]
    return NOT_CHECKABLE if not checked else "holds" if all(checked) else "does not hold"


@dataclass(frozen=True)
class Statement:
    """One statement of the paper; `holds` is computed, None if the check needs unpublished data."""

    statement: str
    source: str  # section or figure of the paper
    holds: bool | None
    numbers: dict[str, Any]
    basis: str  # a `Claim.kind`, or stand-in | consistency | not checkable
    criterion: str = ""  # of the verdict: a claim's test, or our own where the paper gives no number
    reason: str = ""  # why it does not hold, given or not where it does; or why it cannot be checked
    claim: str = ""  # id in `twintube paper claims`

    def __post_init__(self) -> None:
        if self.holds is not None:
            object.__setattr__(self, "holds", bool(self.holds))  # numpy's bool cannot be written as JSON
        if self.holds:
            object.__setattr__(self, "reason", "")


def unchecked(statement: str, source: str, reason: str, numbers: dict[str, Any] | None = None) -> Statement:
    """A statement that needs unpublished data."""
    return Statement(statement, source, None, numbers or {}, NOT_CHECKABLE, reason=reason)


def from_claim(claim: Claim, numbers: dict[str, Any] | None = None) -> Statement:
    """A claim as statement, with all its figures or the given ones."""
    why = f"{claim.because}: {claim.reason}" if claim.reason else ""
    figures = claim.figures if numbers is None else numbers
    return Statement(claim.statement, claim.source, claim.holds, figures, claim.kind, claim.tested, why, claim.id)


@dataclass(frozen=True)
class Plot:
    """A figure of the paper, drawn from the model."""

    number: int
    title: str
    figure: Figure
    statements: tuple[Statement, ...]
    assumed: tuple[str, ...] = ()  # unpublished values that are used
    stand_ins: tuple[str, ...] = ()  # replacements of unpublished measurements
    remarks: tuple[str, ...] = ()  # differences from the paper's figure, contradictions in the paper
    model: str = ""  # which one it is, where it is not the published one

    @property
    def notes(self) -> list[str]:
        """The lines under the picture."""
        texts = [f"{text[0].upper()}{text[1:]}." for text in self.stand_ins]
        texts += [f"Model: {self.model}."] if self.model else []
        return texts + ([f"Assumed (unpublished): {', '.join(self.assumed)}."] if self.assumed else [])

    @property
    def verdict(self) -> str:
        """`holds` if all checkable statements hold."""
        return verdict(s.holds for s in self.statements)

    @property
    def tally(self) -> str:
        """`2 of 3`: number of checkable statements that hold."""
        checked = [s.holds for s in self.statements if s.holds is not None]
        return f"{sum(checked)} of {len(checked)}" if checked else ""


def plain(value: Any) -> Any:
    """Numbers for JSON: numpy types become Python types, keys text, floats have four significant digits."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    return float(f"{value:.4g}") if isinstance(value, float) else value


def as_json(plot: Plot) -> dict[str, Any]:
    """The machine-readable entry of a figure."""
    return {
        "figure": plot.number,
        "title": plot.title,
        "picture": f"figure_{plot.number:02}.png",
        "verdict": plot.verdict,
        "statements": [plain(asdict(statement)) for statement in plot.statements],
        "stand_ins": list(plot.stand_ins),
        "assumed": list(plot.assumed),
        "remarks": list(plot.remarks),
    }
