"""The page of the monitor: which damper of a driving car is worn, and what its wheel shows."""

import textwrap
from collections.abc import Sequence
from functools import partial

import numpy as np
from matplotlib.figure import Figure

from twintube.common.words import counted, listed
from twintube.driving.channels import NAMES, PLACES
from twintube.driving.model import FLEET, REFERENCE
from twintube.driving.monitor import FINE, STATES, UNCLEAR, WATCH, WORN_OUT, Answer, Watched, meaning
from twintube.driving.spectra import HOP
from twintube.report.common import style
from twintube.report.common.html_page import Headline, Page, Picture, Section, Table
from twintube.report.common.probabilities import LEAST, MOST

COLOURS = {FINE: style.GREEN, UNCLEAR: style.BLUE, WATCH: style.ORANGE, WORN_OUT: style.RED}
MARKS = {FINE: "yes", UNCLEAR: "warn", WATCH: "warn", WORN_OUT: "no"}
LOWEST, HIGHEST = 0.5, 24.0  # [Hz] of the spectra that are drawn: from below the body to above the wheels
BESIDE = {REFERENCE: "the same car in its good state", FLEET: "the cars of the training, as no reference was given"}
CAPTION = (
    "What each wheel speed shows over frequency; shaded: wheel hop. Where a damper has lost its damping, the wheel swings "
    "in a narrow, high peak. Gaps: frequencies of the wheel's own rotation."
)
UNSEEN = "Fine does not say that no oil is lost: a damper damps as new until its foot valve draws gas."
ALONE = "Take references: drives of this car in its good state, over the year. Then judge this drive again."
NEXT = {
    FINE: "Nothing to do. Judge the next drive in the same way.",
    UNCLEAR: "Judge a drive of 5 minutes or more, on a rougher road, with a reference of the same car.",
    WATCH: "Judge another drive of 5 minutes or more, on a rougher road, with a reference of the same car.",
    WORN_OUT: "Look for oil at the damper, and put the axle on an inspection bench: `twintube inspect` says what that sees.",
}


def damper(place: str) -> str:
    """A damper in words."""
    return NAMES[place].replace("wheel", "damper")


def dampers(some: Sequence[Watched]) -> str:
    """Some dampers in words."""
    *others, last = (NAMES[each.place].removesuffix(" wheel") for each in some)
    return f"{', '.join(others)} and {last} dampers" if others else f"{last} damper"


def percent(probability: float) -> str:
    """A probability in words; none is certain."""
    return "below 1 %" if probability < LEAST else "above 99 %" if probability > MOST else f"{100 * probability:.0f} %"


def called(each: Watched) -> str:
    """What is said of a damper: its state, the probability, and from which one on it is called."""
    return f"{each.state}: worn {percent(each.probability)}, called from {percent(each.limit)}"


def sentence(answer: Answer) -> str:
    """The answer in words."""
    parts = []
    for state, one, several in SAID:
        if some := answer.of(state):
            parts.append(f"The {dampers(some)} {one if len(some) == 1 else several}.")
    between = [each for each in answer.of(UNCLEAR) if not each.unlike]
    for some, why in (
        (answer.unlike, "unlike all that was trained"),
        (between, SILENT if any(x.limit == 1.0 for x in between) else "good and worn dampers look like that"),
    ):
        if some:
            who = "any damper" if len(some) == len(PLACES) else f"the {dampers(some)}"
            parts.append(f"{UNTOLD[answer.way]} about {who}: {why}.")
    if not parts:
        return "All four dampers damp as good ones."
    if rest := len(answer.of(FINE)):
        parts.append(f"{counted(rest, 'other')} {'damps as a good one' if rest == 1 else 'damp as good ones'}.")
    return " ".join(parts)


SILENT = "wheel speeds alone call nothing"
UNTOLD = {REFERENCE: "Cannot tell from this drive", FLEET: "Cannot tell from one drive without references"}
SAID = (  # of one damper and of several
    (WORN_OUT, "has lost its damping: replace", "have lost their damping: replace"),
    (WATCH, "damps less than usual: watch", "damp less than usual: watch"),
)


def worst_state(answer: Answer) -> str:
    """The state that decides about the car."""
    return next((state for state in (WORN_OUT, WATCH, UNCLEAR) if answer.of(state)), FINE)


def remark(answer: Answer) -> str:
    """Under which conditions the answer holds."""
    said = f"Compared with {BESIDE[answer.way]}, over {answer.seconds / 60:.1f} usable minutes."
    return f"{said} {seen(answer) if answer.of(UNCLEAR) else UNSEEN}"


def seen(answer: Answer) -> str:
    """What a drive showed, whatever it says of the dampers."""
    expected, found = answer.delay
    ratios = listed([f"{each.place} {each.damping:.1f}" for each in answer.dampers], 4)
    return (
        f"Seen: the rear wheels run over the road {found:.3f} s after the front wheels, {expected:.3f} s by wheelbase and "
        f"speed; coherence {answer.coherence:.2f}; damping ratio of wheel hop, times the usual: {ratios}."
    )


def next_step(answer: Answer) -> str:
    """What to do now."""
    state = worst_state(answer)
    return ALONE if state == UNCLEAR and answer.way == FLEET else NEXT[state]


def spectra(answer: Answer, narrow: bool = False) -> Figure:
    """What each wheel speed shows, in the places of the wheels."""
    figure, axes = style.grid(4, (4.6, 2.6), narrow, most=2, sharex=True, sharey=True)
    shown = (answer.frequency >= LOWEST) & (answer.frequency <= HIGHEST)
    frequency = answer.frequency[shown]
    for ax, each in zip(axes.flat, answer.dampers, strict=True):
        ax.axvspan(*HOP, color=style.FAINT, alpha=0.35, lw=0)
        if answer.usual:
            ax.semilogy(frequency, answer.usual[each.place][shown], color=style.GREY, lw=1.3, label="in its good state")
        drawn = answer.density[each.place][shown]
        for state, colour in COLOURS.items():  # the key names all states in their order
            own = state == each.state
            ax.semilogy(frequency if own else [], drawn if own else [], color=colour, lw=1.7, label=f"this drive: {state}")
        text = f"{NAMES[each.place].removesuffix(' wheel')}, {called(each)}".replace(": ", ":\n" if narrow else ": ")
        style.title(ax, text[0].upper() + text[1:])
    style.label(axes, "frequency [Hz]", "(wheel speed / mean)²\nper Hz")
    style.legend_above(figure, *axes.flat[:4])
    return figure


def summary(answer: Answer) -> Table:
    """A row for each damper."""
    rows = [
        [
            damper(each.place), each.state, percent(each.probability), percent(each.limit), f"{each.damping:.2f}",
            f"{np.exp(each.difference['speed_hop']):.1f}", f"{max(0.0, each.distance / each.far):.2f}",
        ]
        for each in answer.dampers
    ]  # fmt: skip
    head = (
        "damper",
        "state",
        "probability that it is worn",
        "called from",
        "damping ratio of wheel hop",
        "power at wheel hop",
        "distance",
    )
    caption = "Damping ratio and power as factors of what is usual; distance from the training over the largest judged"
    return Table(head, rows, caption, numeric=(2, 3, 4, 5, 6))


def reasons(answer: Answer) -> Table:
    """By which factor each feature differs from what is usual, and what that adds to the log odds."""
    names = list(answer.dampers[0].difference)
    rows = [[meaning(name), *(reason(each, name) for each in answer.dampers)] for name in names]
    return Table(
        ("feature", *PLACES), rows, "Factor of what is usual, and in brackets what it adds to the log odds", (1, 2, 3, 4)
    )


def reason(each: Watched, name: str) -> str:
    """A cell of `reasons`."""
    added = f" ({each.parts[name]:+.1f})" if name in each.parts else ""
    return f"{np.exp(each.difference[name]):.2f}{added}"


def terminal(answer: Answer) -> str:
    """The answer as text."""
    table = summary(answer)
    rows = [["damper", "state", "worn", "called from", "damping", "hop power", "distance"], *map(list, table.rows)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    return "\n".join([*lines, *(row for text in (sentence(answer), remark(answer)) for row in textwrap.wrap(text, 118))])


def page(answer: Answer, name: str, references: Sequence[str], about: str) -> Page:
    """The page; `about` says what the tables were made from."""
    state = worst_state(answer)
    head = Headline(
        sentence(answer), state, MARKS[state], remark(answer), next_step(answer),
        Picture.drawn(partial(spectra, answer), CAPTION),
    )  # fmt: skip
    left = [f"{reason}: {counted(count, 'window')}" for reason, count in answer.left_out.items() if count]
    drive = [
        ("Usable", f"{counted(answer.windows, 'window')} of 4 s among {answer.all_windows}"),
        ("Left out", listed(left, 4) if left else "none"),
        ("Mean speed", f"{3.6 * answer.speed:.0f} km/h"),
        ("Coherence of front and rear wheels at wheel hop", f"{answer.coherence:.2f}"),
        ("Rear wheels after front wheels", f"{answer.delay[1]:.3f} s; {answer.delay[0]:.3f} s by wheelbase and speed"),
        ("Sensors", answer.sensors),
        ("References", listed(list(references), 5) if references else "none"),
    ]
    states = [(name, text) for name, text in STATES.items()]
    return Page(
        f"Dampers of the driving car: {name}",
        [
            Section("dampers", "The four dampers", tables=[summary(answer)], notes=states),
            Section("reasons", "What speaks for it", text=[REASONS], tables=[reasons(answer)]),
            Section("drive", "The drive", notes=drive),
            Section("limits", "What this cannot say", text=[UNSEEN, about]),
        ],
        headline=head,
    )


REASONS = (
    "Each feature is compared with what is usual at the drive's speed and road. Log odds above 0 speak for a worn damper. "
    "A feature without brackets has no weight: it says nothing that the others do not."
)
