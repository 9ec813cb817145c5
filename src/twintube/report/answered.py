"""report.html of an answer about states of filling and about what has happened since a reference."""

from pathlib import Path

from twintube.evidence import Answer
from twintube.files import write_bytes, write_text
from twintube.report import changes, state, style
from twintube.report.page import Headline, Picture, html


def lines(answer: Answer) -> list[str]:
    """The answer for the terminal."""
    if answer.changes is None:
        return state.lines(answer.states)
    unknown = [state.sentence(one) for one in answer.states if not one.stated.anything]
    return [*unknown, *changes.lines(answer)]


def write_report(title: str, answer: Answer, folder: Path) -> None:
    """Write report.html and its pictures."""
    if answer.changes is None:
        image, name = style.png(state.picture(answer.states)), state.PICTURE
        text, caption = " ".join(state.sentence(one) for one in answer.states), "Probability of the oil level."
        sections = [state.section(answer.states, [state.next_step(answer.states), state.ASSUMED])]
    else:
        image, name = style.png(changes.picture(answer)), changes.PICTURE
        text, caption = changes.sentence(answer), "Probability of each hypothesis. Blue: together they hold 90 %."
        sections = [changes.section(answer), state.section(answer.states)]
    head = Headline(text, picture=Picture(image, caption, caption))
    write_bytes(folder / name, image)
    write_text(folder / "report.html", html(title, [], sections, [], f"Computed in {answer.seconds:.0f} s.", head))
