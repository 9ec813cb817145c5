"""report.html of an answer about fills and changes: what it is, what it rests on, and what it cannot say."""

from collections.abc import Sequence

import numpy as np

from twintube.common.words import counted, listed
from twintube.dampers import Damper
from twintube.dampers.damper import gas_in_words
from twintube.data import Record
from twintube.diagnosis import Answer
from twintube.report.common.html_page import Page, Section
from twintube.report.diagnosis import budget, changes, state

TRIED = "It was tried on made records only: no real damper that lost oil was at hand."
FILL_ONLY = (
    "While the fill is unknown, nothing but it and the zero of the load cell is looked for: no wear, no heat, no fault."
)
CATALOGUE = "Only what is in the catalogue can be named. A wrong name usually has over 99 %: let the next step confirm it."


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
        head = state.headline(answer.states)
        sections = [limits(answer), state.section(answer.states)]
    else:
        head = changes.headline(answer)
        sections = [budget.section(answer), limits(answer), budget.loops(answer), changes.section(answer)]
        if answer.states:
            sections.append(state.section(answer.states, pictures=[state.drawn(answer.states)]))
    foot = f"Computed in {answer.seconds:.0f} s."
    return Page(f"Diagnosis: {answer.title}", sections, headline=head, foot=foot)


def limits(answer: Answer) -> Section:
    """The part of the page with the limits; it is open, as nobody should miss it."""
    what = FILL_ONLY if answer.changes is None else CATALOGUE
    text = [taken(answer.damper), covered(answer.records), what, TRIED]
    return Section("limits", "What this cannot say", items=text, open=True)


def taken(damper: Damper) -> str:
    """Which damper it is taken for, and what of it is assumed."""
    names = {
        "fv": "F-v curve",
        "friction": "friction",
        "gas_spring": "gas force",
        "geometry.dead_length": f"dead length ({1e3 * damper.parameters.dead_length:.0f} mm)",
    }
    guessed = [text for name, text in names.items() if any(key.startswith(name) for key in damper.assumed)]
    known = f"The damper is taken to be {damper.name}."
    if guessed:
        known += f" Assumed in that parameter set, not measured: {listed(guessed, len(guessed))}."
    return f"{known} Its forces may be some per cent off. Another dead length moves the oil level."


def covered(records: Sequence[Record]) -> str:
    """Which motions and fills the answer has seen."""
    speed = max(float(np.abs(record.velocity).max()) for record in records)
    reach = max(float(np.abs(record.stroke).max()) for record in records)
    fills = list(dict.fromkeys(map(fill, records)))
    seen = f"{counted(len(records), 'record')} up to {speed:.2f} m/s and {1e3 * reach:.0f} mm from the middle"
    return (
        f"Covered: {seen}; {'fill' if len(fills) == 1 else 'fills'}: {listed(fills, 4)}. It says nothing of faster strokes."
    )


def fill(record: Record) -> str:
    """What the file says of the fill of a record."""
    if record.oil_level is None and record.gas_preload is None:
        return "unknown"
    oil = "oil unknown" if record.oil_level is None else f"{100 * record.oil_level:.0f} % oil"
    return f"{oil}, gas {'unknown' if record.gas_preload is None else gas_in_words(record.gas_preload)}"
