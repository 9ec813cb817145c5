"""report.html of an answer about states of filling and about what has happened since a reference."""

from pathlib import Path

from twintube.common.files import write_bytes, write_text
from twintube.diagnosis import Answer
from twintube.report.common.html_page import html
from twintube.report.diagnosis import budget, changes, limits, loops, state


def lines(answer: Answer) -> list[str]:
    """The answer for the terminal."""
    if answer.changes is None:
        return state.lines(answer.states)
    known = answer.budget()
    errors = budget.lines(known) if known is not None else []
    return [*state.sentences(answer.asked), *changes.lines(answer), *errors]


def write_report(answer: Answer, folder: Path) -> None:
    """Write report.html and its picture."""
    if answer.changes is None:
        head, name = state.headline(answer.states), state.PICTURE
        sections = [limits.section(answer), state.section(answer.states)]
    else:
        head, name = changes.headline(answer), changes.PICTURE
        sections = [budget.section(answer), limits.section(answer), loops.section(answer), changes.section(answer)]
        if answer.states:
            sections.append(state.section(answer.states, pictures=[state.drawn(answer.states)]))
    assert head.picture is not None, "both answers are drawn"
    write_bytes(folder / name, head.picture.png)
    foot = f"Computed in {answer.seconds:.0f} s."
    write_text(folder / "report.html", html(f"Diagnosis: {answer.title}", [], sections, [], foot=foot, headline=head))
