"""Statements of the paper with their verdicts, and figures with their statements."""

from dataclasses import dataclass, field
from typing import Any

from matplotlib.figure import Figure

from twintube.claims import Claim

NOT_CHECKABLE = "not checkable"


@dataclass(frozen=True)
class Statement:
    """One statement of the paper; `holds` is computed, None if the check needs unpublished data."""

    text: str
    source: str  # section or figure of the paper
    holds: bool | None
    numbers: dict[str, Any]
    basis: str  # a `Claim.kind`, or stand-in | consistency | not checkable
    criterion: str = ""  # of the verdict: a claim's test, or our own where the paper gives no number
    reason: str = ""  # why it does not hold, or why it cannot be checked
    claim: str = ""  # id in `twintube paper claims`

    def __post_init__(self) -> None:
        if self.holds is not None:
            object.__setattr__(self, "holds", bool(self.holds))  # numpy's bool cannot be written as JSON

    @property
    def verdict(self) -> str:
        """`holds`, `does not hold` or `not checkable`."""
        return NOT_CHECKABLE if self.holds is None else "holds" if self.holds else "does not hold"


def from_claim(claim: Claim, numbers: dict[str, Any] | None = None) -> Statement:
    """A claim as statement, with all its figures or the given ones."""
    return Statement(
        text=claim.statement,
        source=claim.source,
        holds=claim.holds,
        numbers=claim.figures if numbers is None else numbers,
        basis=claim.kind,
        criterion=claim.tested,
        reason=f"{claim.because}: {claim.reason}" if claim.reason else "",
        claim=claim.id,
    )


@dataclass(frozen=True)
class Plot:
    """A figure of the paper, drawn from the model."""

    number: int
    title: str
    figure: Figure
    statements: tuple[Statement, ...]
    stand_ins: tuple[str, ...] = ()  # replacements of unpublished measurements
    assumed: tuple[str, ...] = ()  # unpublished values that are used
    remarks: tuple[str, ...] = field(default=())  # differences from the paper's figure, contradictions in the paper

    @property
    def verdict(self) -> str:
        """`holds` if all checkable statements hold."""
        checked = [s.holds for s in self.statements if s.holds is not None]
        return NOT_CHECKABLE if not checked else "holds" if all(checked) else "does not hold"

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
    if isinstance(value, float):
        return float(f"{value:.4g}")
    return value


def as_json(plot: Plot) -> dict[str, Any]:
    """The machine-readable entry of a figure."""
    return {
        "figure": plot.number,
        "title": plot.title,
        "picture": f"figure_{plot.number:02}.png",
        "verdict": plot.verdict,
        "statements": [
            {
                "statement": s.text,
                "source": s.source,
                "holds": s.holds,
                "basis": s.basis,
                "criterion": s.criterion,
                "numbers": plain(s.numbers),
                "reason": s.reason,
                "claim": s.claim,
            }
            for s in plot.statements
        ],
        "stand_ins": list(plot.stand_ins),
        "assumed": list(plot.assumed),
        "remarks": list(plot.remarks),
    }
