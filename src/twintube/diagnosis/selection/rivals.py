"""What explains the records as well as what was chosen."""

from twintube.diagnosis.fits.candidates import CONTENTS, FACTORS, FILLED, FRICTION, LOSING, RECALIBRATE
from twintube.diagnosis.fits.options import Option, Selection
from twintube.diagnosis.records.seen import MEASUREMENT
from twintube.diagnosis.rules import RULES


def rivals(selection: Selection, left: bool) -> list[Option]:
    """Options that are as good as the chosen causes; `left` says that more than noise is left.

    Of several causes each is compared where the others are known: alone a rival explains some of theirs, too.
    """
    final = selection.final
    if len(selection.chosen) < 2:
        others = near(selection, left)
    else:
        close = max(selection.limit, RULES.close * max(selection.start.score - final.score, 0.0))
        close = max(close, RULES.law_apart * final.score) if left else close
        others = [o for o in (*selection.beside, *instead(selection)) if o.score - final.score <= close]
        others = sorted((o for o in others if not richer(o, final)), key=lambda o: o.score)
        # All are rivals of the same cause: the other is sure.
        others = [o for o in others if {*final.names} & {*o.names} == {*final.names} & {*others[0].names}][
            : RULES.alternatives
        ]
    return [o for o in others if o.total < selection.start.total]  # a rival takes squared error away, too


def instead(selection: Selection) -> list[Option]:
    """The final model with another cause in place of the last, from the round in which that was added."""
    last = selection.rounds[min(len(selection.final.names), len(selection.rounds)) - 1]
    final = {*selection.final.names}
    others = [o for o in last if len(o.names) == len(final) and {*o.names[:-1]} < final]
    return [o for o in others if o.names[-1] not in (RECALIBRATE, *final, *selection.neutral)]


def leading(selection: Selection) -> Option | None:
    """The best option of the first round whose cause was chosen; None for a calibration."""
    best = next((o for o in selection.rounds[0] if o.names[-1] in selection.chosen), None)
    return None if best is None or best.names[-1] == RECALIBRATE else best


def near(selection: Selection, left: bool) -> list[Option]:
    """Options of the first round that are nearly as good as the leading option, and its best where that became superfluous.

    A law that leaves much may be that of another cause, which leaves little more.
    """
    best = leading(selection)
    if best is None:
        return []
    gained = max(selection.start.score - best.score, 0.0)
    # A gain of a channel is exact: where it leaves noise alone, only noise makes a law as good.
    exact = not left and best.names[-1] in {*FACTORS} & {*MEASUREMENT}
    close = selection.limit if exact else max(selection.limit, RULES.close * gained)
    wide = max(close, RULES.law_apart * best.score) if left else close
    others = [o for o in selection.rounds[0] if o.names[-1] not in (RECALIBRATE, *selection.neutral, *selection.chosen)]
    others = [o for o in others if left or o.score >= best.score or o is selection.rounds[0][0]]

    def most(other: Option) -> float:
        pair = {best.names[-1], other.names[-1]}
        if pair <= {*FRICTION}:  # one friction follows a good part of any other
            return close
        # What becomes of freed gas shows in few strokes, where a law of one follows another's.
        if pair & {*FILLED} and pair & {*LOSING} and best.total > RULES.odd_right * selection.count:
            return max(wide, RULES.contents_apart * gained)  # a fill that is wrong all along would leave noise alone
        return max(wide, RULES.contents_apart * gained) if pair <= {*CONTENTS} else wide

    return [o for o in others if o.score - best.score <= most(o) and not richer(o, best)][: RULES.alternatives]


def richer(option: Option, than: Option) -> bool:
    """Whether an option is no better, though its new cause can do what the other's does and has more parameters."""
    return option.score >= than.score and general(option, than)


def general(option: Option, than: Option) -> bool:
    """Whether the new cause of an option can do what the other's does, with more parameters.

    Friction that depends on the position may be the same everywhere, and wear of the valves that of all branches alike.
    """
    new, old = ({*some.names} - {*other.names} for some, other in ((option, than), (than, option)))
    alike = any((new | old) <= {*group} for group in (FRICTION, FACTORS))
    more = [len(some.fits[0].free) if some.fits else 0 for some in (option, than)]
    return alike and more[0] > more[1]
