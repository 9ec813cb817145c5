"""What explains the records as well as what was chosen."""

from collections.abc import Callable, Sequence
from typing import Protocol

from twintube.diagnosis.candidates import FACTORS, FRICTION, RECALIBRATE
from twintube.diagnosis.fit import Free
from twintube.diagnosis.options import Option, Selection
from twintube.diagnosis.rules import RULES


class Fitting(Protocol):
    """What fits models fold by fold."""

    def free(self, names: Sequence[str], values: dict[str, float]) -> list[Free]:
        """The free parameters of a model."""

    def option(self, names: Sequence[str], frees: Sequence[Sequence[Free]]) -> Option:
        """The model fitted in every fold."""


def rivals(selection: Selection, left: bool) -> list[Option]:
    """Options that are as good as the chosen causes; `left` says that more than noise is left.

    Of several causes the first is compared where the others are known: alone a rival explains some of theirs, too.
    """
    if len(selection.chosen) > 1:
        final = selection.final.score
        close = max(selection.limit, RULES.close * max(selection.start.score - final, 0.0))
        near_by = [option for option in selection.beside if option.score - final <= close]
        return [option for option in near_by if not richer(option, selection.final)]
    return near(selection, left)[: RULES.alternatives]


def near(selection: Selection, left: bool) -> list[Option]:
    """Options of the first round that are nearly as good as its best, where that was chosen.

    A law that leaves much may be that of another cause, which leaves little more.
    """
    best, *others = selection.rounds[0]
    if best.names[-1] == RECALIBRATE or best.names[-1] not in selection.chosen:
        return []
    close = max(selection.limit, RULES.close * max(selection.start.score - best.score, 0.0))
    wide = max(close, RULES.law_apart * best.score) if left else close
    others = [o for o in others if o.names[-1] not in (RECALIBRATE, *selection.neutral, *selection.chosen)]
    others = [o for o in others if not richer(o, best)]
    # One friction follows a good part of any other.
    friction = best.names[-1] in FRICTION
    return [o for o in others if 0.0 <= o.score - best.score <= (close if friction and o.names[-1] in FRICTION else wide)]


def richer(option: Option, than: Option) -> bool:
    """Whether an option is no better, though its new cause can do what the other's does and has more parameters.

    Friction that depends on the position may be the same everywhere, and wear of the valves that of all branches alike.
    """
    new, old = ({*some.names} - {*other.names} for some, other in ((option, than), (than, option)))
    alike = any((new | old) <= {*group} for group in (FRICTION, FACTORS))
    more = [len(some.fits[0].free) if some.fits else 0 for some in (option, than)]
    return alike and option.score >= than.score and more[0] > more[1]


def beside(fitting: Fitting, selection: Selection, progress: Callable[[str], None]) -> list[Option]:
    """The final model of several causes with each rival of the first in its place, the rival last."""
    first, options = selection.rounds[0][0].names[-1], []
    for rival in near(selection, left=True)[: RULES.alternatives]:
        name = rival.names[-1]
        progress(f"{name} instead of {first}")
        names = [*(other for other in selection.final.names if other != first), name]
        pairs = zip(selection.final.fits, rival.fits, strict=True)
        options.append(fitting.option(names, [fitting.free(names, {**own.values, **fit.values}) for own, fit in pairs]))
    return options
