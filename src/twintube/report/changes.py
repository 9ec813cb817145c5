"""The page about what has happened since the reference: the answer in a sentence, all probabilities, what it is worth."""

import numpy as np
from matplotlib.figure import Figure

from twintube.core.effects import EFFECTS
from twintube.diagnosis.verdict.verdict import lower
from twintube.evidence import Answer
from twintube.evidence.changes import NONE, STATE, UNKNOWN, Hypothesis
from twintube.evidence.mechanisms import META
from twintube.readable import amount
from twintube.report import style
from twintube.report.answer import REPAIRS, chance
from twintube.report.engineering import title_of
from twintube.report.page import Section, Table
from twintube.report.state import sentence as state_sentence
from twintube.words import listed

PICTURE = "changes.png"
SHOWN = 8  # hypotheses of the picture
TITLES = {
    NONE: "Nothing has changed",
    STATE: "Another fill than stated",
    UNKNOWN: "Something has changed that is not in the catalogue",
}
UNITS = {
    "force_offset": "N", "force_gain": "1", "channel_delay": "s", "stroke_gain": "1", "time_base": "1", "zero_drift": "N/s",
    "clock_error": "1", "clamp_inertia": "kg",
}  # fmt: skip


def title(h: Hypothesis) -> str:
    """A hypothesis in words."""
    return TITLES.get(h.name) or title_of(h.name)


def sentence(answer: Answer) -> str:
    """What has happened since the reference, in a sentence."""
    first, named = answer.named[0], answer.named
    if len(named) > 1:
        several = listed([f"{lower(title(h))} ({chance(h.probability)})" for h in named], len(named))
        return f"The records cannot tell: {several}."
    if first.kind == STATE:
        told = sorted((one for one in answer.states if one.stated.anything), key=lambda one: one.posterior.as_stated)
        changed = [one for one in told if one.posterior.as_stated < 0.5] or told[:1]  # several may be doubtful, none alone
        return " ".join(f"{state_sentence(one)} The file says otherwise." for one in changed)
    if first.name in (NONE, UNKNOWN):
        return f"{title(first)} since the reference ({chance(first.probability)})."
    return f"Changed since the reference: {lower(title(first))} ({chance(first.probability)}){worth(answer)}."


def worth(answer: Answer) -> str:
    """The error on records that the cause was not fitted to, without and with it."""
    known = [h for h in answer.held_out if h.with_cause is not None]
    if not known:
        return ""
    without, with_cause, noise = (
        float(np.sqrt(np.mean(np.square(values))))
        for values in zip(*((h.without, h.with_cause, h.noise) for h in known), strict=True)
    )
    before, after, floor = (amount(x, "N") for x in (without, with_cause, noise))
    return f": error {before} → {after} on records that it was not fitted to (noise {floor})"


def next_step(answer: Answer) -> str:
    """What to do next."""
    first = answer.named[0]
    if len(answer.named) > 1:
        decides = [EFFECTS[h.name].decides for h in answer.named if h.name in EFFECTS]
        wanted = f"what would decide: {decides[0]}" if decides else "repeat the records, at more velocities"
        return f"Next: {wanted}."
    if first.kind == "fault":
        return f"Next: {REPAIRS[first.name]}."
    return {
        NONE: "Next: nothing. The records after the reference are as the records before.",
        STATE: "Next: state the true fill in dataset.toml.",
        UNKNOWN: "Next: look at where the error is; no cause of the catalogue explains it.",
    }.get(first.name, "Next: build the extended set into the FMU with `build_fmu.py --parameters extended.toml`.")


def lines(answer: Answer) -> list[str]:
    """The answer for the terminal."""
    return [sentence(answer), next_step(answer)]


def picture(answer: Answer) -> Figure:
    """Probabilities of the hypotheses, the largest first."""
    assert answer.changes is not None
    several = answer.changes.hypotheses[:SHOWN][::-1]
    figure, axes = style.canvas(1, 1, (7.5, 0.6 + 0.35 * len(several)))
    ax = axes[0, 0]
    inside = set(answer.changes.credible)
    colours = [style.BLUE if h.name in inside else style.FAINT for h in several]
    ax.barh([title(h) for h in several], [100.0 * h.probability for h in several], color=colours)
    ax.set_xlim(0, 100)
    ax.set_xlabel("probability [%]")
    return figure


def rows_of(answer: Answer) -> list[Table]:
    """Tables: hypotheses, strengths of the named cause, errors of records that were left out."""
    assert answer.changes is not None
    several = [[title(h), chance(h.probability), f"{h.log_evidence:.1f}"] for h in answer.changes.hypotheses[:SHOWN]]
    caption = (
        "Log evidence: how much better it predicts all records than `nothing has changed`, its strength integrated out."
    )
    tables = [Table(("hypothesis", "probability", "log evidence"), several, caption, (1, 2))]
    if answer.cause is not None:
        f = answer.cause
        units = {n: str(META[n]["unit"]) if n in META else UNITS[n] for n in f.values}
        rows = [[n, f"{x:.3g}", f"{f.spread[n]:.2g}", units[n]] for n, x in f.values.items()]
        tables.append(
            Table(("parameter", "value", "standard deviation", "unit"), rows, title_of(f.mechanism.effect), (1, 2))
        )
    if answer.held_out:
        left = [
            [
                h.record,
                amount(h.without, "N"),
                "" if h.with_cause is None else amount(h.with_cause, "N"),
                amount(h.noise, "N"),
            ]
            for h in answer.held_out
        ]
        head = ("record left out", "without the cause", "with it", "noise")
        tables.append(Table(head, left, "Force error (RMS) of each later record, predicted from all others.", (1, 2, 3)))
    return tables


def section(answer: Answer) -> Section:
    """The part of the page about changes."""
    assert answer.changes is not None
    always = [title_of(m.effect) for m in answer.changes.base]
    text = [next_step(answer)]
    if always:
        text.append(f"Always there, and no change: {listed(always, len(always))}.")
    return Section("changes", "What has happened since the reference", text=text, tables=rows_of(answer))
