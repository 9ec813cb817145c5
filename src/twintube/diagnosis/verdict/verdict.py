"""The verdict: the only place where it is decided, and its sentence."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from twintube.diagnosis.fits.candidates import EXACT, FACTORS, LATE, RECALIBRATE, Candidate
from twintube.diagnosis.fits.options import Option, Selection
from twintube.diagnosis.measurement.faults import STRANGER, Fault
from twintube.diagnosis.result import Errors, Estimate, Gain, Signature, Tried
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.selection.rivals import rivals
from twintube.diagnosis.verdict.moved_zero import ZERO

NUMBERS = {2: "Two", 3: "Three"}


@dataclass(frozen=True)
class Judgement:
    """The verdict and what it rests on."""

    verdict: str  # of the dataset
    remaining: str  # the verdict without regard to the faults that were put right before anything was fitted
    causes: list[str]  # candidates that are named, the largest first
    kept: list[str]  # candidates, or `recalibrate`, that the extended model has
    nearest: list[str]  # candidates that explain too little to be named
    doubts: dict[str, str]  # why a chosen candidate is not named
    rivals: list[Option]  # what explains the records as well as the named cause
    outside: list[Signature]  # causes outside the catalogue that decide
    explained: float  # share of the explainable squared error that goes away, on held-out records
    loud: bool = False  # nothing is missing, though the error is above the noise floor: it does not repeat


def judge(
    selection: Selection,
    candidates: Mapping[str, Candidate],
    estimates: Mapping[str, Mapping[str, Estimate]],
    seen: Sequence[Signature],
    errors: Mapping[str, Errors],
    gain: Gain,
    faults: Sequence[Fault],
    attempts: Sequence[Tried],
    only_noise: bool = False,
    moved: bool = False,
) -> Judgement:
    """The verdict from the selected causes, the signatures in the records and the faults that were put right.

    `estimates` are the values of the chosen causes, `errors` those of the models on held-out records, `gain` that of the
    model with all chosen causes, `attempts` the candidates as the page shows them, `only_noise` says that the errors of the
    model as given do not repeat, `moved` that a zero that moved with the filling explains as much. A cause is named only
    where none of these figures speaks against it.
    """
    base, extended, floor = (errors[name].force_rmse_N for name in ("base", "extended", "noise_floor"))
    right = selection.final.score <= RULES.right * selection.count
    quiet = base <= RULES.quiet * floor
    # What the model has in its own force, as a ring after a step, is no cause where its error is noise.
    real = [signature for signature in seen if not (signature.repeats and quiet)]
    outside = [signature for signature in real if RULES.shows * base < signature.size < np.inf]
    unlimited = [signature for signature in seen if signature.size == np.inf]
    causes = [name for name in selection.chosen if name != RECALIBRATE]
    doubts = {name: doubt for name in causes if (doubt := doubtful(candidates[name], estimates[name]))}
    if beaten(selection):
        doubts |= dict.fromkeys(causes, "other values of the degradation parameters explain far more of the records")
    lows = [gain.heldout_interval[0], *(a.interval[0] for a in attempts if a.decision == "chosen" and a.effect in causes)]
    proven = gain.heldout > 0.0 and min(lows) > 0.0 and extended < base and base > floor
    # Where noise alone is left, what is explained of little is known badly.
    enough = gain.heldout >= (RULES.half if right else RULES.explained)
    late = any(name in LATE for name in causes)
    much = extended**2 > RULES.odd_right * floor**2
    if much and late:
        enough = gain.heldout >= RULES.explained_late  # play in a joint and a filter make a force late as well
    elif much and RECALIBRATE in selection.chosen:
        enough = gain.heldout >= RULES.explained_most  # fourteen parameters follow a good part of any effect
    if causes and {*causes} <= {*EXACT} and much:
        enough = False  # a gain of the force has no other formulation that would leave so much
    if quiet and all(candidates[name].fault for name in causes):
        # So little is within what a careful bench is off by, which an effect of the damper is not.
        enough = selection.final.score <= (1 - RULES.half) * selection.start.score
    if quiet and (surpassed(selection) or {*causes} <= {fault.effect for fault in faults}):
        enough = False  # not twice: with the fault put right the error is noise
    if late and base <= RULES.quiet_late * floor:
        enough = False  # sampling moves the steps of the force, too
    close = rivals(selection, extended > RULES.quiet * floor)
    if moved and len(selection.chosen) == 1 and not any(candidates[name].fault for name in causes):
        close = [o for o in selection.rounds[0] if o.names[-1] == ZERO] or close
    solved = bool(selection.chosen) and proven and enough and not doubts
    if outside and not (solved and extended <= RULES.quiet * floor):
        remaining = "unexplained"
    elif not solved:
        remaining = "none" if quiet or only_noise else "unexplained"
    elif not causes:
        # So many parameters take something away of any error.
        remaining = "none" if quiet else "recalibrate"
    elif close:
        remaining = "ambiguous"
    else:
        remaining = "measurement_fault" if candidates[causes[0]].fault else "cause"
    if unlimited and remaining in ("none", "unexplained"):
        remaining, outside = "unexplained", unlimited + outside
    named = remaining in ("cause", "ambiguous", "measurement_fault")
    return Judgement(
        verdict="measurement_fault" if faults else remaining,
        remaining=remaining,
        causes=causes if named else [],
        kept=selection.chosen if named or remaining == "recalibrate" else [],
        nearest=causes if remaining == "unexplained" else [],
        doubts=doubts,
        rivals=close if remaining == "ambiguous" else [],
        outside=outside if remaining == "unexplained" else [],
        explained=gain.heldout,
        loud=remaining == "none" and not quiet,
    )


def surpassed(selection: Selection) -> bool:
    """Whether a single cause that may not be named, as every measurement has some of it, explains far more."""
    best = min((o.score for o in selection.rounds[0] if o.names[-1] != RECALIBRATE), default=np.inf)
    start = selection.start.score
    return start - selection.final.score < RULES.near_best * (start - best)


def doubtful(candidate: Candidate, values: Mapping[str, Estimate]) -> str:
    """Why the strength of a cause is not to be relied on; empty where one is determined and inside its range."""
    acting = [values[name] for name in candidate.strength if name in values and values[name].acts(candidate.least[name])]
    if not acting:
        return "its strength is not determined by these records"
    ends = [value.doubt for value in acting if value.at_bound]
    if ends:
        return f"its strength is {ends[0]}"
    # Factors of the force alone: a leak beside the valves makes it smaller.
    factors = [values[name] for name in candidate.strength if name in values and values[name].unit == "1"]
    more = max((factor.value - (factor.neutral or 0.0) for factor in factors), default=0.0)
    if candidate.name in FACTORS and more > RULES.stiffer:
        return f"no calibration, wear or lack of oil makes forces {more:.0%} larger: identify this damper first"
    return ""


def beaten(selection: Selection) -> bool:
    """Whether a calibration that may not be named, as the history of a record is not known, is better by either measure."""
    other, final = selection.recalibrated, selection.final
    less = other.total <= (1 - RULES.next_share) * final.total
    return less and other.score < final.score and RECALIBRATE not in selection.chosen


def sentence(judgement: Judgement, candidates: Mapping[str, Candidate], faults: Sequence[Fault]) -> str:
    """The verdict in words."""
    rest = remaining_sentence(judgement, candidates)
    if not faults:
        return rest
    wrong = "; ".join(lower(fault.explanation.rstrip(".")) for fault in faults)
    odd = [fault for fault in faults if fault.effect == STRANGER]
    how = "With this put right" if len(odd) < len(faults) else "Without it" if len(odd[0].records) == 1 else "Without them"
    return f"The measurement is faulty: {wrong}. {how}: {rest}"


def remaining_sentence(judgement: Judgement, candidates: Mapping[str, Candidate]) -> str:
    """The verdict without the faults that were put right."""
    gain = f"{share(judgement.explained)} of the explainable squared error of the held-out records"
    titles = [lower(candidates[name].title) for name in judgement.causes]
    if judgement.outside:
        text = judgement.outside[0].text
        return f"No effect of the damper: {text}."
    match judgement.remaining:
        case "none":
            margin = 100 * (RULES.quiet - 1)
            if judgement.loud:
                return (
                    "Nothing is missing: what the error has above the noise floor does not come again where the motion does."
                )
            return f"Nothing is missing: the error on held-out records is less than {margin:.0f} % above the noise floor."
        case "recalibrate":
            return "No effect is missing: other values of the degradation parameters explain the records."
        case "unexplained":
            near = " and ".join(lower(candidates[name].title) for name in judgement.nearest)
            alone = len(judgement.nearest) == 1
            doubts = ((lower(candidates[name].title), doubt) for name, doubt in judgement.doubts.items())
            why = "; ".join(doubt if alone else f"of {title}, {doubt}" for title, doubt in doubts)
            nearest = f"; the nearest, {near}, removes {gain}" if near and judgement.explained > 0 else ""
            nearest += f", but {why}" if nearest and why else ""
            return f"The simulation is wrong in a way that no known cause explains{nearest}."
        case "ambiguous":
            others = " or ".join(lower(candidates[o.names[-1]].title) for o in judgement.rivals)
            if len(titles) == 1:
                return f"These records do not tell apart: {titles[0]}, or {others}. The first removes {gain}."
            sure = [name in judgement.rivals[0].names for name in judgement.causes]
            known, open_ = titles[sure.index(True)], titles[sure.index(False)]
            return (
                f"Two causes: {known}; and {open_} or {others}, which these records do not tell apart. "
                f"With the first of these they remove {gain}."
            )
    if len(titles) > 1:
        listed = "; ".join(f"({i}) {title}" for i, title in enumerate(titles, start=1))
        return f"{NUMBERS.get(len(titles), str(len(titles)))} causes: {listed}. All of them remove {gain}."
    kind = "The measurement is faulty" if judgement.remaining == "measurement_fault" else "The cause"
    return f"{kind}: {titles[0]}. It removes {gain}."


def share(gain: float) -> str:
    """A gain in percent, never rounded up to all of it."""
    return f"{100.0 * gain:.0f} %" if gain < 0.99 else "over 99 %"


def lower(title: str) -> str:
    """A title inside a sentence; abbreviations such as F-v keep their capitals."""
    return title if title[1:2].isupper() or title[1:2] == "-" else title[0].lower() + title[1:]
