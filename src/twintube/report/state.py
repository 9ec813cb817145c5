"""The page about oil level and preload that nobody knows: what the records say, with a picture of its probability."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from twintube.evidence import StateAnswer
from twintube.evidence.numbers import NUMBERS
from twintube.report import style
from twintube.report.answer import chance
from twintube.report.page import Picture, Section, Table
from twintube.words import listed

PICTURE = "state.png"
SURE = 0.95  # probability from which a preload is said to be there or lost
BAR = 0.02  # width of a bar of the picture
WIDE = 0.2  # width of the interval above which a record that would narrow it is named
NARROWER = (
    "Records in which the damper cavitates or foams tell the oil level: drive 40 mm and more at 1 m/s and faster. "
    "Where the oil fills both working chambers in every stroke, nothing in the force depends on how much is left."
)
ASSUMED = (
    "The parameter set is taken for this damper's, its own law some per cent off. Another dead length moves the level: see "
    "the level of collapse in `twintube dampers`. Nothing else is looked for where the fill is unknown."
)


def sentence(answer: StateAnswer) -> str:
    """What the records say of a state, in a sentence."""
    level, (low, high) = answer.posterior.level, answer.posterior.interval()
    lost = answer.posterior.gas_lost
    if high - low > WIDE:
        oil = f"The damper holds {100 * low:.0f} to {100 * high:.0f} % of its oil; these records tell no more"
    else:
        oil = f"The damper holds {100 * level:.0f} % of its oil ({100 * low:.0f} to {100 * high:.0f} %)"
    if SURE > lost > 1.0 - SURE:
        gas = f"whether its gas preload is lost cannot be told ({chance(lost)})"
    else:
        gas = f"its gas preload is {'lost' if lost > 0.5 else 'there'} ({chance(max(lost, 1.0 - lost))})"
    return f"{oil}; {gas}."


def lines(answers: Sequence[StateAnswer]) -> list[str]:
    """The answers for the terminal."""
    out = []
    for answer in answers:
        many = "" if len(answers) == 1 else f"{listed(answer.records, 3)}: "
        out.append(many + sentence(answer))
    return [*out, next_step(answers)]


def next_step(answers: Sequence[StateAnswer]) -> str:
    """What to do next."""
    wide = any(high - low > WIDE for low, high in (answer.posterior.interval() for answer in answers))
    if wide:
        return f"Next: {NARROWER[0].lower()}{NARROWER[1:]}"
    return "Next: state this fill in dataset.toml; `twintube diagnose` then asks what else the model lacks."


def picture(answers: Sequence[StateAnswer]) -> Figure:
    """Probability over the oil level of each state, with and without preload."""
    figure, axes = style.canvas(len(answers), 1, (7.5, 2.9 * len(answers)))
    for ax, answer in zip(axes[:, 0], answers, strict=True):
        p = answer.posterior
        low, high = p.interval()
        ax.axvspan(100 * low, 100 * high, color=style.FAINT, alpha=0.35, lw=0, label="90 %")
        edges = np.arange(NUMBERS.level_low, 1.0 - 1e-9, BAR)
        bars = [np.histogram(p.levels[:-1], [*edges, 1.0 + 1e-9], weights=row[:-1])[0] for row in p.probability]
        middles = np.concatenate([100 * (edges + BAR / 2), [100 * (1.0 + BAR)]])  # the last: nothing lost
        bottom = np.zeros(len(middles))
        for row, colour, label in ((1, style.BLUE, "preload there"), (0, style.RED, "preload lost")):
            height = 100 * np.concatenate([bars[row], p.probability[row, -1:]])
            ax.bar(middles, height, 90 * BAR, bottom, color=colour, label=label)
            bottom += height
        ax.set_xlim(100 * NUMBERS.level_low, 100 * (1.0 + 2 * BAR))
        ax.set_xticks([20, 40, 60, 80, 100 * (1.0 + BAR)], ["20", "40", "60", "80", "full"])
        ax.set_ylim(0, 1.3 * float(bottom.max()))
        ax.set_ylabel("probability [%]")
        style.title(ax, sentence(answer) if len(answers) == 1 else listed(answer.records, 2))
        ax.legend(loc="upper center", ncols=3)
    axes[-1, 0].set_xlabel("oil level [% of the intact volume]")
    return figure


def section(answers: Sequence[StateAnswer], text: Sequence[str] = ()) -> Section:
    """The part of the page about states of filling."""
    rows = [
        [
            listed(answer.records, 3),
            f"{100 * answer.posterior.level:.0f} %",
            "{:.0f} to {:.0f} %".format(*(100 * x for x in answer.posterior.interval())),
            chance(answer.posterior.gas_lost),
            chance(answer.posterior.as_stated) if answer.stated.anything else "",
        ]
        for answer in answers
    ]
    table = Table(("records", "oil level", "90 % interval", "preload lost", "as the file says"), rows)
    image = style.png(picture(answers))
    caption = "Probability of the oil level, stacked with and without preload. Grey: the shortest 90 % interval."
    return Section(
        "states",
        "State of the damper",
        text=text,
        tables=[table],
        pictures=[Picture(image, caption, caption)],
    )
