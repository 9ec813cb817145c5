"""The page about oil level and preload that nobody knows: what the records say, with a picture of its probability."""

from collections.abc import Sequence
from functools import partial

import numpy as np
from matplotlib.figure import Figure

from twintube.common.words import listed, lower
from twintube.diagnosis import StateAnswer
from twintube.diagnosis.channels import FAULTS
from twintube.diagnosis.channels import TARED as TARED_CELL
from twintube.diagnosis.measurement.faults import BOTH_SIGNS
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.posterior import LOST, PARTLY, TARED, THERE, StatePosterior
from twintube.report.common import style
from twintube.report.common.html_page import Headline, Picture, Section, Table
from twintube.report.common.probabilities import chance

BADGES = {  # of answers about changes: verdict -> badge, class of the style sheet
    "cause": ("cause named", "found"),
    "none": ("nothing missing", "yes"),
    "tolerance": ("within tolerance", "yes"),
    "state": ("another fill than stated", "warn"),
    "ambiguous": ("cannot tell apart", "warn"),
    "unexplained": ("unexplained", "open"),
    "measurement_fault": ("measurement fault", "no"),
}
REPAIRS = {name: fault.repair for name, fault in FAULTS.items()} | {
    BOTH_SIGNS: "set force_sign = -1 and stroke_sign = -1 in dataset.toml, or leave both out where they stand there"
}
PICTURE = "state"
SURE = 0.95  # probability from which a preload is said to be there or lost
BAR = 0.02  # width of a bar of the picture
WIDE = 0.2  # width of the interval above which a record that would narrow it is named
NARROWER = (
    "Records in which the damper cavitates or foams tell the oil level: drive 40 mm and more at 1 m/s and faster. "
    "Where the oil fills both working chambers in every stroke, nothing in the force depends on how much is left."
)
MISSED = "and missing in the records: the load cell was set to zero with the damper in it"
MAYBE_MISSED = "the load cell may have been set to zero with the damper in it"
STACKED = (
    (THERE, style.BLUE, "preload there"),
    (PARTLY, style.GREEN, "preload lost in part"),
    (TARED, style.ORANGE, "preload there, cell set to zero with it"),
    (LOST, style.RED, "preload lost"),
)
CAPTION = "Probability of each oil level, stacked by the state of the gas. Grey: it lies there with 90 %."


def sentence(answer: StateAnswer) -> str:
    """What the records say of a state, in a sentence."""
    level, (low, high) = answer.posterior.level, answer.posterior.interval()
    if high - low > WIDE:
        oil = f"The damper holds {100 * low:.0f} to {100 * high:.0f} % of its oil; these records tell no more"
    else:
        oil = f"The damper holds {100 * level:.0f} % of its oil ({100 * low:.0f} to {100 * high:.0f} %)"
    return f"{oil}; {gas(answer.posterior)}."


def gas(posterior: StatePosterior) -> str:
    """What the records say of the gas preload, as the end of a sentence."""
    lost, there, tared = posterior.gas_lost, posterior.gas_there, posterior.tared
    if tared > SURE:
        return f"its gas preload is there, {MISSED} ({chance(tared)})"
    if undecided(posterior):
        other = f"a load cell set to zero with the damper in it ({chance(tared)})"
        return f"these records cannot tell a lost gas preload ({chance(lost)}) from {other}"
    maybe = f"; {MAYBE_MISSED} ({chance(tared)})" if tared > 1.0 - SURE else ""
    if max(lost, there) > SURE:
        return f"its gas preload is {'lost' if lost > SURE else 'there'} ({chance(max(lost, there))}){maybe}"
    low, high = posterior.gas_interval()
    whether = f", lost with {chance(lost)}" if lost > 1.0 - SURE else ""
    return f"its gas preload is at {100 * posterior.gas:.0f} % ({100 * low:.0f} to {100 * high:.0f} %){whether}{maybe}"


def undecided(posterior: StatePosterior) -> bool:
    """Whether a lost preload and a load cell that was set to zero with the damper in it are both in question."""
    return min(posterior.gas_lost, posterior.tared) > 1.0 - SURE


def lines(answers: Sequence[StateAnswer]) -> list[str]:
    """The answers for the terminal."""
    return [*sentences(answers), f"Next: {next_step(answers)}"]


def sentences(answers: Sequence[StateAnswer]) -> list[str]:
    """A sentence for each state; of several, behind the names of its records."""
    return [("" if len(answers) == 1 else f"{listed(one.records, 3)}: ") + sentence(one) for one in answers]


def next_step(answers: Sequence[StateAnswer]) -> str:
    """What to do next."""
    if any(answer.posterior.tared > 1.0 - SURE for answer in answers):
        return f"{REPAIRS[TARED_CELL]}."
    wide = any(high - low > WIDE for low, high in (answer.posterior.interval() for answer in answers))
    if wide:
        return lower(NARROWER)
    return "state this fill in dataset.toml; `twintube diagnose` then asks what else the model lacks."


def headline(answers: Sequence[StateAnswer]) -> Headline:
    """What the first screen says."""
    text = " ".join(sentences(answers))
    return Headline(text, *badge(answers), next=next_step(answers), picture=drawn(answers, PICTURE))


def badge(answers: Sequence[StateAnswer]) -> tuple[str, str]:
    """The answer in two words with its class of the style sheet; the worst of several states."""
    intervals = [answer.posterior.interval() for answer in answers]
    if any(high < 1.0 for _, high in intervals):
        return "oil lost", "no"
    if any(answer.posterior.gas_lost > SURE for answer in answers):
        return "gas preload lost", "no"
    if any(answer.posterior.by_gas[[LOST, PARTLY]].sum() > SURE for answer in answers):
        return "gas preload lost in part", "no"
    if any(answer.posterior.tared > SURE for answer in answers):
        return "load cell set to zero with the damper", "warn"
    if any(high - low > WIDE for low, high in intervals) or any(undecided(answer.posterior) for answer in answers):
        return "cannot tell", "warn"
    return "no oil lost", "yes"


def drawn(answers: Sequence[StateAnswer], name: str = "") -> Picture:
    """The picture for wide and narrow screens."""
    return Picture.drawn(partial(picture, answers), CAPTION, name)


def picture(answers: Sequence[StateAnswer], narrow: bool = False) -> Figure:
    """Probability over the oil level of each state, by what became of the gas."""
    figure, axes = style.grid(len(answers), (8.5, 3.3), narrow, most=1)
    for ax, answer in zip(axes[:, 0], answers, strict=True):
        p = answer.posterior
        low, high = p.interval()
        end = high if high < 1.0 else 1.0 + 2 * BAR  # beyond it stands the bar of a damper that has lost nothing
        ax.axvspan(100 * low, 100 * end, color=style.FAINT, alpha=0.35, lw=0, label="90 % interval")
        edges = np.arange(numbers().level_low, 1.0 - 1e-9, BAR)
        bars = [np.histogram(p.levels[:-1], [*edges, 1.0 + 1e-9], weights=row[:-1])[0] for row in p.by_gas]
        middles = np.concatenate([100 * (edges + BAR / 2), [100 * (1.0 + BAR)]])  # the last: nothing lost
        bottom = np.zeros(len(middles))
        for row, colour, label in STACKED:
            height = 100 * np.concatenate([bars[row], p.by_gas[row, -1:]])
            ax.bar(middles, height, 90 * BAR, bottom, color=colour, label=label)
            bottom += height
        ax.set_xticks([20, 40, 60, 80, 100 * (1.0 + BAR)], ["20", "40", "60", "80", "full"])
        ax.set(xlim=(100 * numbers().level_low, 100 * (1.0 + 2 * BAR)), ylim=(0, 1.05 * float(bottom.max())))
        ax.set_ylabel("probability [%]")
        if len(answers) > 1:
            style.title(ax, listed(answer.records, 2))
    style.legend_above(figure, axes[0, 0], columns=3)
    axes[-1, 0].set_xlabel("oil level [% of the intact volume]")
    return figure


def section(answers: Sequence[StateAnswer], pictures: Sequence[Picture] = ()) -> Section:
    """The part of the page about states of filling; without pictures where the first screen has them."""
    rows = []
    for answer in answers:
        p, between = answer.posterior, "{:.0f} to {:.0f} %"
        oil = [f"{100 * p.level:.0f} %", between.format(*(100 * x for x in p.interval()))]
        gas = [f"{100 * p.gas:.0f} %", between.format(*(100 * x for x in p.gas_interval()))]
        stated = chance(p.as_stated) if answer.stated.anything else ""
        rows.append([listed(answer.records, 3), *oil, *gas, chance(p.gas_lost), chance(p.tared), stated])
    head = ("records", "oil level", "90 % interval", "gas preload", "90 % interval", "lost",
            "there, cell set to zero with it", "as the file says")  # fmt: skip
    return Section("states", "Oil and gas in numbers", tables=[Table(head, rows)], pictures=pictures)
