"""The page of `twintube diagnose`: what is wrong with the damper or its measurement, how sure that is, what to do next."""

import itertools
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from twintube.core.effects import EFFECTS, Parameters
from twintube.diagnosis.faults import PUT_RIGHT
from twintube.diagnosis.result import Cause, Diagnosis, Errors, Estimate
from twintube.diagnosis.rules import RULES
from twintube.files import write_bytes, write_text
from twintube.readable import MISSING, amount, digits, percent, unit_of, with_interval
from twintube.report import style
from twintube.report.diagnosis_pictures import MOST, pictures, shown_record
from twintube.report.diagnosis_records import compared, models, name_of, noise, ranked
from twintube.report.engineering import is_share, meaning, title_of
from twintube.report.page import Headline, Picture, Section, Table, html

BADGES = {  # verdict -> badge, class of the style sheet
    "cause": ("cause named", "found"),
    "none": ("nothing missing", "yes"),
    "recalibrate": ("recalibrate", "warn"),
    "ambiguous": ("cannot tell apart", "warn"),
    "unexplained": ("unexplained", "open"),
    "measurement_fault": ("measurement fault", "no"),
}
SPLITS = {"heldout": "held-out records", "fit": "fitted records"}
ROWS = {"noise_floor": "noise floor"}
AGREES = (
    "The error of the base model is that of the noise and of the numerics: no effect needs to be added and no parameter "
    "changed. The pictures below show the agreement."
)
RESIDUAL = "Residual: measured less simulated force, so that positive values are force that the model lacks."


def error(d: Diagnosis, split: str, name: str) -> Errors | None:
    """Errors of a simulation over some records, if there are any."""
    return d.errors.get(split, {}).get(name)


def headline(d: Diagnosis) -> Headline:
    """The verdict with the figures that carry it."""
    badge, mark = BADGES[d.verdict]
    split = "heldout" if error(d, "heldout", "base") else "fit"
    labels = ROWS | {m.name: m.label for m in models(d)}
    tiles = []
    for name in ("base", *(m.name for m in compared(d)[1:]), "noise_floor"):
        errors = error(d, split, name)
        if errors and np.isfinite(errors.force_rmse_N):
            label = labels[name]
            tiles.append((amount(errors.force_rmse_N, "N"), f"{label}, force error on {SPLITS[split]}"))
    if d.causes:
        first = d.causes[0]
        which = "putting the fault right explains" if first.effect in PUT_RIGHT else "explained"
        if first.effect not in PUT_RIGHT and len(d.causes) > 1:
            which = "all causes together explain"
        low, high = first.gain.heldout_interval
        tiles.append((percent(first.gain.heldout), f"{which} on held-out records, 95 %: {percent(low)} to {percent(high)}"))
        tiles.append((percent(first.gain.worst_record), "in the worst held-out record"))
    return Headline(d.sentence, badge, mark, tiles)


def lead(d: Diagnosis) -> list[str]:
    """The paragraphs below the verdict."""
    paragraphs = []
    for cause in d.causes:
        effect = EFFECTS.get(cause.effect)
        errs = f" What a model without it gets wrong: {effect.absence}" if effect else ""
        paragraphs.append(f"{cause.title}: {cause.explanation}{errs}")
    if d.verdict == "none":
        paragraphs.append(AGREES)
    elif d.where:
        paragraphs.append(f"Where the base model is wrong: {d.where}")
    counts = ", ".join(f"{len(d.structure[m.name])} for the {m.label}" for m in compared(d))
    test = f"signs of neighbouring intervals, {percent(RULES.structure_alarm)} false alarms"
    paragraphs.append(
        f"Records of {len(d.records)} in which the residual, however small, is not white noise: {counts} ({test})."
    )
    if d.signature:
        paragraphs.append(f"What no candidate explains: {d.signature}")
    return paragraphs


def doubt(f: Estimate, share: bool) -> str:
    """Why a value is not to be relied on, with its range in the unit of the value."""
    if not (f.at_bound and f.bounds):
        return f.doubt
    name, factor = unit_of(f.unit, f.value, share)
    low, high = (f"{x * factor:.4g}" for x in f.bounds)
    return f"at the end of its range, {low} to {high} {name}".rstrip()


def cause_tables(causes: list[Cause]) -> list[Table]:
    """Values and gains of the causes."""
    parameters = []
    for cause in causes:
        for name, f in cause.parameters.items():
            share = is_share(cause.effect, name)
            value, span = with_interval(f.value, f.low, f.high, f.unit, share)
            parameters.append([cause.title, name, meaning(name), value, span, doubt(f, share)])
    # Causes that act together have a gain in common.
    gains = [
        [" and ".join(c.title for c in together), percent(g.heldout), " to ".join(percent(x) for x in g.heldout_interval),
         percent(g.worst_record), percent(g.fit)]
        for g, together in itertools.groupby(causes, key=lambda c: c.gain)
    ]  # fmt: skip
    tables = []
    if parameters:
        tables.append(Table(["cause", "parameter", "", "value", "95 % interval", ""], parameters, "Values", (3, 4)))
    if gains:
        head = ["cause", "held-out records", "95 % interval", "worst held-out record", "fitted records"]
        title = "Share of the explainable squared force error of all records together that goes away"
        tables.append(Table(head, gains, title, (1, 2, 3, 4)))
    return tables


def changes(d: Diagnosis) -> Table | None:
    """Parameters that recalibration changed."""
    rows = []
    for item in fields(Parameters):
        before, after = getattr(d.base.parameters, item.name), getattr(d.recalibrated.parameters, item.name)
        if item.metadata["size"] > 1 or before == after:
            continue
        unit, factor = unit_of(str(item.metadata["unit"]), max(abs(before), abs(after)), share=False)
        texts = [digits(x * factor, abs(after - before) * factor / 2) for x in (before, after)]
        rows.append([item.name, str(item.metadata["description"]), *texts, unit])
    curve = [n for n in ("v_re", "F_re", "v_co", "F_co") if different(d.base, d.recalibrated, n)]
    if curve:
        rows.append(["F-v curve", "force over velocity", "as given", "changed", ""])
    return (
        Table(["parameter", "", "base", "recalibrated", "unit"], rows, "Parameters that were recalibrated", (2, 3))
        if rows
        else None
    )


def different(a: Any, b: Any, name: str) -> bool:
    """Whether two dampers differ in a list of parameters."""
    return list(getattr(a.parameters, name)) != list(getattr(b.parameters, name))


def totals(d: Diagnosis) -> Table:
    """Force and work errors over all records of a split."""
    labels = ROWS | {m.name: m.label for m in models(d)}
    rows = []
    for name in ("base", *(m.name for m in models(d)[1:]), "noise_floor"):
        cells: list[str] = []
        for split in SPLITS:
            e = error(d, split, name)
            cells += [amount(e.force_rmse_N, "N"), amount(e.work_rmse_J, "J")] if e else [MISSING, MISSING]
        rows.append([labels[name], *cells])
    head = ["", *(f"{split}, {what}" for split in ("held out", "fitted") for what in ("force", "work"))]
    return Table(head, rows, "Root mean square errors of force and of work per oscillation", (1, 2, 3, 4))


def record_table(d: Diagnosis) -> Table:
    """Every record with its errors."""
    shown = models(d)
    rows = [
        [r.record.name, "held out" if r.split == "heldout" else "fitted", name_of(r),
         *(amount(r.rms(m.force(r)), "N") for m in shown), amount(noise(r), "N"), amount(r.record.peak, "N")]
        for r in ranked(d)
    ]  # fmt: skip
    head = ["record", "", "state", *(m.label for m in shown), "noise floor", "peak force"]
    return Table(head, rows, "Root mean square error of the force", range(3, len(head)))


def tried_table(d: Diagnosis) -> Table | None:
    """All candidates of all rounds with the reason for what became of them."""
    rows = [
        [f"{t.round}", title_of(t.effect), percent(t.heldout_gain), " to ".join(percent(x) for x in t.interval), t.decision,
         t.reason]
        for t in sorted(d.tried, key=lambda t: (t.round, t.decision != "chosen", -t.heldout_gain))
    ]  # fmt: skip
    head = ["round", "candidate", "gain", "95 % interval", "", "reason"]
    title = "What was tried; gain: share of the log-likelihood of held-out records, against the round before"
    return Table(head, rows, title, (2, 3)) if rows else None


def alternative_table(d: Diagnosis) -> Table | None:
    """What explains the data about as well."""
    rows = [[title_of(a.effect), percent(a.heldout_gain), a.separable_by] for a in d.alternatives]
    title = "Alternatives; gain: share of the squared error of a typical held-out record"
    return Table(["alternative", "gain", "what would tell it apart"], rows, title, (1,)) if rows else None


def sections(d: Diagnosis, drawn: dict[str, Picture]) -> list[Section]:
    """The page below the verdict; what has nothing to show is left out."""
    best = compared(d)[1:]
    has = [drawn[name] for name in ("loops", "work") if name in drawn]
    parts = [Section("compared", "Force and work, measured and simulated", pictures=has)] if has else []
    has = [drawn[name] for name in ("maps", "residual") if name in drawn]
    if has:
        title = "Residual before and after" if best else "Residual"
        parts.append(Section("residual", title, text=[RESIDUAL], pictures=has))
    if d.records:
        tables = [t for t in (totals(d), changes(d) if d.verdict != "recalibrate" else None, record_table(d)) if t]
        parts.append(Section("records", "Errors of all records", pictures=[drawn["errors"]], tables=tables))
    tables = [t for t in (alternative_table(d) if d.verdict != "ambiguous" else None, tried_table(d)) if t]
    if tables:
        has = [drawn["ranking"]] if "ranking" in drawn else []
        parts.append(Section("candidates", "Candidates", pictures=has, tables=tables))
    if d.next_measurements:
        parts.append(Section("next", "What to measure next", items=d.next_measurements))
    if d.remarks:
        parts.append(Section("remarks", "Remarks", items=d.remarks))
    return parts


def captions(d: Diagnosis) -> dict[str, str]:
    """The text below each picture, which is also its alternative text."""
    record = shown_record(d).record.name if d.records else ""
    many = max((sum(r.split == split for r in d.records) for split in SPLITS), default=0) > MOST
    which = f"the {MOST} worst records of each kind" if many else "every record"
    return {
        "loops": "Mean force over stroke (left) and over velocity (right), first and last oscillation of the fastest block. "
                 "The records of the largest base error, held-out ones first.",
        "work": "Work per oscillation of these records.",
        "maps": "Root mean square of the residual over each quantity; bars: mean residual of the base model with its sign.",
        "residual": f"Residual over time, record {record}.",
        "errors": f"Error of {which}, held-out ones shaded.",
        "ranking": "Gain: share of the log-likelihood of the held-out records that a candidate takes away, with its 95 % "
                   "interval. A triangle at the left edge: it makes things much worse.",
    }  # fmt: skip


def page(d: Diagnosis, images: dict[str, bytes]) -> str:
    """The page with its pictures."""
    texts = captions(d)
    drawn = {name: Picture(data, texts[name], texts[name]) for name, data in images.items()}
    tables = cause_tables(d.causes)
    first = {"recalibrate": changes, "ambiguous": alternative_table}.get(d.verdict)
    carrying = first(d) if first else None
    tables += [carrying] if carrying else []
    foot = f"Computed in {d.seconds:.0f} s." if d.seconds else ""
    return html(f"Diagnosis: {d.title}", lead(d), sections(d, drawn), tables, foot, headline(d))


def write_report(diagnosis: Diagnosis, folder: Path) -> list[Path]:
    """Write report.html and its pictures; returns the files."""
    images = {name: style.png(figure) for name, figure in pictures(diagnosis).items()}
    text = page(diagnosis, images)
    files = [folder / f"{name}.png" for name in images]
    for file, data in zip(files, images.values(), strict=True):
        write_bytes(file, data)
    write_text(folder / "report.html", text)
    return [*files, folder / "report.html"]
