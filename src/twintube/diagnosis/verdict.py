"""The verdict: the only place where it is decided, and its sentence."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from twintube.diagnosis.candidates import Candidate
from twintube.diagnosis.faults import Fault
from twintube.diagnosis.gains import removed
from twintube.diagnosis.result import Signature
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.select import RECALIBRATE, Option, Selection

NUMBERS = {2: "Two", 3: "Three"}


@dataclass(frozen=True)
class Judgement:
    """The verdict and what it rests on."""

    verdict: str  # of the dataset
    remaining: str  # the verdict without regard to the faults that were put right before anything was fitted
    causes: list[str]  # candidates that are named, the largest first
    kept: list[str]  # candidates, or `recalibrate`, that the extended model has
    nearest: list[str]  # candidates that explain too little to be named
    rivals: list[Option]  # what explains the records as well as the named cause
    outside: list[Signature]  # causes outside the catalogue that decide
    explained: float  # share of the explainable squared error that goes away, geometric mean over the records


def judge(
    selection: Selection,
    candidates: Mapping[str, Candidate],
    seen: Sequence[Signature],
    base_error: float,
    faults: Sequence[Fault],
) -> Judgement:
    """The verdict from the selected causes, the signatures in the records and the faults that were put right.

    `base_error` [N] is the force error of the base model on held-out records.
    """
    explained = removed(selection.start.score, selection.final.score, selection.count)
    right = selection.final.score <= RULES.right * selection.count
    outside = [signature for signature in seen if signature.size > RULES.shows * base_error]
    causes = [name for name in selection.chosen if name != RECALIBRATE]
    close = rivals(selection)
    if outside:
        remaining = "unexplained"
    elif not selection.chosen:
        remaining = "none" if right else "unexplained"
    elif explained < RULES.explained and not right:
        remaining = "unexplained"
    elif not causes:
        remaining = "recalibrate"
    elif close:
        remaining = "ambiguous"
    else:
        remaining = "measurement_fault" if candidates[causes[0]].fault else "cause"
    named = remaining in ("cause", "ambiguous", "measurement_fault")
    return Judgement(
        verdict="measurement_fault" if faults else remaining,
        remaining=remaining,
        causes=causes if named else [],
        kept=selection.chosen if named or remaining == "recalibrate" else [],
        nearest=causes if remaining == "unexplained" else [],
        rivals=close if remaining == "ambiguous" else [],
        outside=outside,
        explained=explained,
    )


def rivals(selection: Selection) -> list[Option]:
    """Options of the first round that are as good as the chosen candidate."""
    best, *others = selection.rounds[0]
    if best.names[-1] == RECALIBRATE or not selection.chosen:
        return []
    margin = max(selection.limit, RULES.close * max(selection.start.score - best.score, 0.0))
    near = [o for o in others if 0.0 <= o.score - best.score <= margin and o.names[-1] != RECALIBRATE]
    return near[: RULES.alternatives]


def sentence(judgement: Judgement, candidates: Mapping[str, Candidate], faults: Sequence[Fault]) -> str:
    """The verdict in words."""
    rest = remaining_sentence(judgement, candidates)
    if not faults:
        return rest
    wrong = "; ".join(lower(fault.explanation.rstrip(".")) for fault in faults)
    return f"The measurement is faulty: {wrong}. With this put right: {rest}"


def remaining_sentence(judgement: Judgement, candidates: Mapping[str, Candidate]) -> str:
    """The verdict without the faults that were put right."""
    gain = f"{100 * judgement.explained:.0f} % of the explainable squared error of a typical held-out record"
    titles = [lower(candidates[name].title) for name in judgement.causes]
    if judgement.outside:
        return f"No known cause explains the records: {judgement.outside[0].text}."
    match judgement.remaining:
        case "none":
            margin = 100 * (np.exp(RULES.right / 2) - 1)
            return f"Nothing is missing: the error on held-out records is at most {margin:.0f} % above noise and numerics."
        case "recalibrate":
            return "No effect is missing: other values of the degradation parameters explain the records."
        case "unexplained":
            near = " and ".join(lower(candidates[name].title) for name in judgement.nearest)
            nearest = f"; the nearest, {near}, removes {gain}" if near else ""
            return f"The simulation is wrong in a way that no known cause explains{nearest}."
        case "ambiguous":
            others = " or ".join(lower(candidates[o.names[-1]].title) for o in judgement.rivals)
            return (
                f"These records do not tell apart: {' together with '.join(titles)}, or {others}. The first removes {gain}."
            )
    if len(titles) > 1:
        listed = "; ".join(f"({i}) {title}" for i, title in enumerate(titles, start=1))
        return f"{NUMBERS.get(len(titles), str(len(titles)))} causes: {listed}. All of them remove {gain}."
    kind = "The measurement is faulty" if judgement.remaining == "measurement_fault" else "The cause"
    return f"{kind}: {titles[0]}. It removes {gain}."


def lower(title: str) -> str:
    """A title inside a sentence; abbreviations such as F-v keep their capitals."""
    return title if title[1:2].isupper() or title[1:2] == "-" else title[0].lower() + title[1:]
