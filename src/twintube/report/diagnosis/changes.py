"""The page about what has happened since the reference: the answer in a sentence, all probabilities, what it is worth."""

from collections.abc import Sequence
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from twintube.common.readable import amount
from twintube.common.words import listed, lower
from twintube.core.effects import EFFECTS
from twintube.diagnosis import Answer
from twintube.diagnosis.changes import NONE, STATE, UNKNOWN, Hypothesis
from twintube.diagnosis.channels import TARED
from twintube.diagnosis.heldout import HeldOut
from twintube.diagnosis.measurement.faults import BOTH_SIGNS
from twintube.diagnosis.mechanisms import unit_of
from twintube.report.common import style
from twintube.report.common.html_page import Headline, Picture, Section, Table
from twintube.report.common.probabilities import LEAST, certain, chance
from twintube.report.common.titles import title_of
from twintube.report.diagnosis import state
from twintube.report.diagnosis.state import BADGES, REPAIRS

PICTURE = "changes"
SHOWN = 8  # hypotheses of the picture
OTHER_FILL = "Another fill than stated"
TITLES = {  # by whether there is a reference
    True: {NONE: "Nothing has changed", UNKNOWN: "Something has changed that is not in the catalogue"},
    False: {NONE: "Nothing is missing", UNKNOWN: "Another damper than that of the parameter set"},
}


def title(h: Hypothesis, compared: bool) -> str:
    """A hypothesis in words; `compared` with a reference."""
    cause = h.name.removeprefix(f"{STATE}+")
    words = OTHER_FILL if cause == STATE else TITLES[compared].get(cause) or title_of(cause)
    return words if cause == h.name else f"{OTHER_FILL} + {lower(words)}"


def name_of(h: Hypothesis, answer: Answer) -> str:
    """The same, where the answer tells a fill as well, which may be another than before."""
    return "Nothing beside the fill" if h.name == NONE and answer.asked else title(h, answer.compared)


def sentence(answer: Answer) -> str:
    """The answer in a sentence, behind what was wrong with the bench."""
    if not answer.faults:
        return remaining(answer)
    wrong = "; ".join(lower(fault.explanation.rstrip(".")) for fault in answer.faults)
    without = all(fault.records and answer.measured and fault.records == answer.measured.odd for fault in answer.faults)
    how = "Without it" if without else "With this put right"
    return f"The measurement is faulty: {wrong}. {how}: {lower(remaining(answer))}"


def remaining(answer: Answer) -> str:
    """What has happened since the reference, or what the model lacks, in a sentence."""
    named, since = answer.named, " since the reference" if answer.compared else ""
    first = named[0]
    if answer.unexplained:
        near = f"; nearest: {lower(title(first, answer.compared))}" if first.found is not None else ""
        return f"No cause of the catalogue explains the records: {answer.unexplained}{near}."
    if len(named) > 1:
        return f"The records cannot tell: {choice(answer)}."
    if first.kind == STATE:
        told = sorted((one for one in answer.states if one.stated.anything), key=lambda one: one.posterior.as_stated)
        changed = [one for one in told if one.posterior.rather_misstated] or told[:1]  # several may be doubtful, none alone
        return " ".join(f"{state.sentence(one)} The file says otherwise." for one in changed)
    if first.name == NONE and answer.asked:
        what = "has changed" if answer.compared else "is missing"
        return f"Beside the fill nothing {what}{since}. {certain(first.probability)}"
    if first.name in (NONE, UNKNOWN):
        within = ": the error lies within what such dampers and benches differ by" if answer.verdict == "tolerance" else ""
        return f"{title(first, answer.compared)}{since}{within}. {certain(first.probability)}"
    kind = f"Changed{since}" if answer.compared else "Cause" if first.kind == "effect" else "The measurement is faulty"
    return f"{kind}: {lower(title(first, answer.compared))}.{worth(answer)} {certain(first.probability)}"


def choice(answer: Answer) -> str:
    """What the records leave open, as the end of a sentence."""
    if answer.doubted:
        likely, share = lower(name_of(answer.named[0], answer)), chance(answer.named[0].probability)
        other = lower(title(next(h for h in answer.named if h.name in answer.doubting), answer.compared))
        return f"{likely} explains all records best ({share}), but {other} predicts records that were left out better"
    several = [f"{lower(name_of(h, answer))} ({chance(h.probability)})" for h in answer.named]
    return listed(several, len(several))


def worth(answer: Answer) -> str:
    """The error on records that the cause was not fitted to, without and with it."""
    known = gained(answer)
    if not known:
        return ""
    without, with_cause, noise = (
        float(np.sqrt(np.mean(np.square(values))))
        for values in zip(*((h.without, h.with_cause, h.noise) for h in known), strict=True)
    )
    before, after, floor = (amount(x, "N") for x in (without, with_cause, noise))
    return f" Error {before} → {after} (noise {floor})."


def next_step(answer: Answer) -> str:
    """What to do next."""
    first = answer.named[0]
    unread = TARED in [h.name for h in answer.named] or any(state.undecided(one.posterior) for one in answer.asked)
    steps = [REPAIRS[BOTH_SIGNS if fault.title == BOTH_SIGNS else fault.effect] for fault in answer.faults]
    if answer.unexplained:
        steps.append("look at the rig and at where the error is")
    elif unread:
        steps.append(REPAIRS[TARED])
    elif len(answer.named) > 1:
        tells = {name: effect.decides for name, effect in EFFECTS.items()} | REPAIRS
        decides = [tells[name] for h in answer.named for name in h.name.split("+") if name in tells]
        steps.append(f"what would decide: {decides[0]}" if decides else "repeat the records, at more velocities")
    elif first.kind == "fault":
        steps += [REPAIRS[name] for name in first.name.split("+") if name in REPAIRS]
    elif first.name.startswith(f"{STATE}+"):
        steps.append("state the true fill in dataset.toml, and ask again")
    elif first.kind == "effect":
        steps.append("build the extended set into an FMU: `twintube fmu extended.toml`")
    elif first.kind == STATE:
        steps.append("state the true fill in dataset.toml")
    elif first.kind == NONE and answer.asked:
        steps.append("state this fill in dataset.toml")
    elif first.kind == UNKNOWN:
        known = "look at where the error is; no cause of the catalogue explains it"
        steps.append(known if answer.compared else "identify this damper first (twintube identify)")
    return f"{'; '.join(dict.fromkeys(steps)) or 'nothing'}."


def lines(answer: Answer) -> list[str]:
    """The answer for the terminal."""
    put_right = [f"{remark}." for remark in answer.remarks] if answer.tared or answer.unlike else []
    return [sentence(answer), *put_right, f"Next: {next_step(answer)}"]


def headline(answer: Answer) -> Headline:
    """What the first screen says."""
    badge, mark = BADGES[answer.verdict]
    if answer.verdict == NONE and answer.asked:
        badge, mark = state.badge(answer.asked)
    elif answer.verdict == NONE and answer.compared:
        badge = "nothing has changed"
    later = "later " if answer.compared else ""
    caption = "How likely each answer is (blue: these hold 90 %)"
    caption += f", and the error of each {later}record, predicted from all other records." if gained(answer) else "."
    if answer.unexplained:
        caption = "The error of each record, predicted from all other records: no cause of the catalogue takes it away."
    elif answer.doubted:
        caption = "The error of each record, predicted from all other records: in all it is larger with the cause."
    drawn = Picture.drawn(partial(picture, answer), caption, PICTURE)
    text = " ".join([*state.sentences(answer.asked), sentence(answer)])
    return Headline(text, badge, mark, next=next_step(answer), picture=drawn)


def picture(answer: Answer, narrow: bool = False) -> Figure:
    """Probabilities of the hypotheses, the largest first, and the errors that the first one takes away."""
    assert answer.changes is not None
    if answer.unexplained or answer.doubted:
        return unexplained(answer, narrow)
    several = [h for h in answer.changes.hypotheses[:SHOWN] if h.probability >= LEAST]
    blue = answer.changes.credible
    bars = [(name_of(h, answer), 100 * h.probability, style.BLUE if h.name in blue else style.FAINT) for h in several]
    bars.append(("Everything else", 100 * max(0.0, 1.0 - sum(h.probability for h in several)), style.FAINT))
    known = gained(answer)
    figure, axes = style.grid(2 if known else 1, (5.4 if known else 9.0, max(2.4, 0.8 + 0.45 * len(bars))), narrow, most=2)
    style.bars(axes.flat[0], bars, 24 if narrow else 32)
    axes.flat[0].set(xlim=(0, 100), xlabel="probability [%]")
    if known:
        errors(axes.flat[1], known)
    return figure


def unexplained(answer: Answer, narrow: bool) -> Figure:
    """What no hypothesis explains, or the only one makes worse: no probability of theirs says anything of that."""
    several = answer.held_out
    figure, axes = style.grid(1, (9.0, max(2.4, 1.4 + 0.45 * len(several))), narrow, most=1)
    likely = "with the nearest one" if answer.unexplained else "with the likeliest one"
    errors(axes.flat[0], several, ("without a cause", likely))
    return figure


def gained(answer: Answer) -> list[HeldOut]:
    """The records that say what a cause is worth."""
    return [h for h in answer.held_out if h.with_cause is not None]


def errors(ax: Axes, several: Sequence[HeldOut], labels: tuple[str, str] = ("without", "with the cause")) -> None:
    """Error of each record, without and with the cause, over its noise."""
    rows = np.arange(len(several))[::-1]
    ax.barh(rows, [h.without for h in several], 0.7, color=style.FAINT, label=labels[0])
    if any(h.with_cause is not None for h in several):
        ax.barh(rows, [h.with_cause or 0.0 for h in several], 0.35, color=style.BLUE, label=labels[1])
    ax.plot([h.noise for h in several], rows, "|", color=style.INK, ms=14, mew=2, label="noise")
    ax.set_yticks(rows, [style.plain(h.record) for h in several])
    ax.set_xlabel("force error, RMS [N]")
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, columnspacing=1.0, handlelength=1.2, frameon=False)


def rows_of(answer: Answer) -> list[Table]:
    """Tables: hypotheses, strengths of the named cause, errors of records that were left out."""
    assert answer.changes is not None
    shown = answer.changes.hypotheses[:SHOWN]
    weights = [f"{h.log_evidence:.1f}" if np.isfinite(h.log_evidence) else "too slight" for h in shown]
    several = [[name_of(h, answer), chance(h.probability), weight] for h, weight in zip(shown, weights, strict=True)]
    nothing = lower(TITLES[answer.compared][NONE])
    caption = f"Log evidence: how much better it predicts all records than '{nothing}', whatever its strength is."
    likely = "probability, if one of them were right" if answer.unexplained or answer.doubted else "probability"
    tables = [Table(("answer", likely, "log evidence"), several, caption, (1, 2))]
    if answer.cause is not None:
        f = answer.cause
        rows = [[n, f"{x:.3g}", f"{f.spread[n]:.2g}", unit_of(n)] for n, x in f.values.items()]
        head = ("parameter", "value", "standard deviation", "unit")
        tables.append(Table(head, rows, title_of(f.mechanism.effect), (1, 2)))
    if answer.held_out:
        errors_of = ((h.record, (h.without, h.with_cause, h.noise)) for h in answer.held_out)
        left = [[name, *("" if x is None else amount(x, "N") for x in several)] for name, several in errors_of]
        head = ("record left out", "without the cause", "with it", "noise")
        tables.append(Table(head, left, "Force error (RMS) of each record, predicted from all others.", (1, 2, 3)))
    return tables


def section(answer: Answer) -> Section:
    """The part of the page about changes."""
    assert answer.changes is not None
    always = [title_of(m.effect) for m in answer.changes.base]
    text = [f"Always there, and no change: {listed(always, len(always))}."] if always else []
    text += [f"{remark[0].upper()}{remark[1:]}." for remark in answer.remarks]
    return Section("changes", "All answers and errors in numbers", text=text, tables=rows_of(answer))
