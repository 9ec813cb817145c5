"""report.html of an answer about states of filling and about what has happened since a reference."""

from twintube.diagnosis import Answer
from twintube.report.common.html_page import Page
from twintube.report.diagnosis import budget, changes, limits, loops, state


def lines(answer: Answer) -> list[str]:
    """The answer for the terminal."""
    if answer.changes is None:
        return state.lines(answer.states)
    known = answer.budget()
    errors = budget.lines(known) if known is not None else []
    return [*state.sentences(answer.asked), *changes.lines(answer), *errors]


def page(answer: Answer) -> Page:
    """The page of an answer, with its first picture."""
    if answer.changes is None:
        head, name = state.headline(answer.states), state.PICTURE
        sections = [limits.section(answer), state.section(answer.states)]
    else:
        head, name = changes.headline(answer), changes.PICTURE
        sections = [budget.section(answer), limits.section(answer), loops.section(answer), changes.section(answer)]
        if answer.states:
            sections.append(state.section(answer.states, pictures=[state.drawn(answer.states)]))
    assert head.picture is not None, "both answers are drawn"
    foot = f"Computed in {answer.seconds:.0f} s."
    return Page(f"Diagnosis: {answer.title}", sections, headline=head, foot=foot, pictures={name: head.picture})
