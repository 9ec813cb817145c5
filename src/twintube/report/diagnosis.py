"""The page of `twintube diagnose`: what is wrong with the damper or its measurement, how sure that is, what to do next."""

import itertools
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from twintube.core.effects import EFFECTS, Parameters
from twintube.diagnosis.result import Cause, Diagnosis, Errors, Estimate, RecordResult
from twintube.diagnosis.rules import RULES
from twintube.files import write_bytes, write_text
from twintube.readable import MISSING, amount, digits, percent, unit_of, with_interval
from twintube.report import style
from twintube.report.answer import confidence, has_extension, next_step, number
from twintube.report.diagnosis_live import MOST as MOST_LIVE
from twintube.report.diagnosis_live import live_part
from twintube.report.diagnosis_loop import caption
from twintube.report.diagnosis_pictures import MOST, NARROW, PICTURES, pictures, shown_record
from twintube.report.diagnosis_records import KINDS, Model, compared, models, name_of, ranked
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
    "The error of the base model is that of the noise, of the numerics and of what is tolerated: no effect has to be added "
    "and no parameter changed. The pictures show the agreement."
)
EXTENDED = (
    "extended.toml is the parameter set that belongs to this answer, for twintube simulate, fmu and demo; where the records "
    "leave a value open, it holds the best guess."
)
RESIDUAL = "Residual: measured less simulated force, so that positive values are force that the model lacks."


def error(d: Diagnosis, split: str, name: str) -> Errors | None:
    """Errors of a simulation over some records, if there are any."""
    return d.errors.get(split, {}).get(name)


def headline(d: Diagnosis, picture: Picture | None) -> Headline:
    """A single verdict, number, next step and picture: what the first screen shows."""
    badge, mark = BADGES[d.verdict]
    value, label = number(d)
    tiles = [(value, label)] if value else []
    return Headline(d.sentence, badge, mark, [*tiles, ("Next step", next_step(d))], confidence(d), picture)


def lead(d: Diagnosis) -> list[str]:
    """The paragraphs below the answer."""
    paragraphs = []
    for cause in d.causes:
        effect = EFFECTS.get(cause.effect)
        errs = f" What a model without it gets wrong: {effect.absence}" if effect else ""
        paragraphs.append(f"{cause.title}: {cause.explanation}{errs}")
    paragraphs += open_values(d.causes)
    if d.verdict == "none":
        paragraphs.append(AGREES)
    elif d.where:
        paragraphs.append(f"Where the base model is wrong: {d.where.rstrip('.')}.")
    if d.signature and d.signature != d.where:
        paragraphs.append(f"What no candidate explains: {d.signature.rstrip('.')}.")
    if has_extension(d):
        paragraphs.append(EXTENDED)
    return paragraphs


def white_noise(d: Diagnosis) -> str:
    """In how many records the residual is more than white noise."""
    counts = ", ".join(f"{len(d.structure[m.name])} for the {m.label}" for m in compared(d))
    test = f"signs of neighbouring intervals, {percent(RULES.structure_alarm)} false alarms"
    return (
        f"Records of {len(d.records)} in which neighbouring residuals resemble each other, however small they are: {counts} "
        f"({test}). An error at the noise floor may have such a rest."
    )


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
        for name, f in cause.determined.items():
            share = is_share(cause.effect, name)
            value, span = with_interval(f.value, f.low, f.high, f.unit, share)
            parameters.append([cause.title, name, meaning(name), value, span if f.bounds or f.high > f.low else MISSING])
    # Causes that act together have a gain in common.
    gains = [
        [" and ".join(c.title for c in together), percent(g.heldout), " to ".join(percent(x) for x in g.heldout_interval),
         percent(g.worst_record), percent(g.fit)]
        for g, together in itertools.groupby(causes, key=lambda c: c.gain)
    ]  # fmt: skip
    tables = []
    interval = f"{percent(RULES.interval_level)} interval"
    if parameters:
        tables.append(Table(["cause", "parameter", "", "value", interval], parameters, "Values", (3, 4)))
    if gains:
        head = ["cause", "held-out records", interval, "worst held-out record", "fitted records"]
        title = (
            "Share of the explainable squared force error that goes away (a fault that was put right: relative to the force)"
        )
        tables.append(Table(head, gains, title, (1, 2, 3, 4)))
    return tables


def open_values(causes: list[Cause]) -> list[str]:
    """The parameters of the causes that are not among their values, with the reason."""
    texts = []
    for cause in causes:
        reasons = {name: doubt(cause.parameters[name], is_share(cause.effect, name)) for name in cause.undetermined}
        listed = ", ".join(f"{name} ({reason or 'neutral within its interval'})" for name, reason in reasons.items())
        if listed:
            texts.append(f"{cause.title}, without a value of its own: {listed}.")
    return texts


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

    def rms(r: RecordResult, model: Model) -> str:
        return MISSING if r.split == "left_out" and model.name != "base" else amount(r.rms(model.force(r)), "N")

    rows = [
        [r.record.name, KINDS[r.split], name_of(r), *(rms(r, m) for m in shown), amount(r.noise, "N"),
         amount(r.record.peak, "N")]
        for r in [*d.left_out, *ranked(d)]
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
    head = ["round", "candidate", "gain", f"{percent(RULES.interval_level)} interval", "", "reason"]
    title = "What was tried; gain: share of the log-likelihood of held-out records, against the round before"
    return Table(head, rows, title, (2, 3)) if rows else None


def alternative_table(d: Diagnosis) -> Table | None:
    """What explains the data about as well."""
    rows = [[title_of(a.effect), percent(a.heldout_gain), a.separable_by] for a in d.alternatives]
    title = "Alternatives; share of the explainable squared force error that goes away"
    return Table(["alternative", "held-out records", "what would tell it apart"], rows, title, (1,)) if rows else None


def sections(d: Diagnosis, drawn: dict[str, Picture]) -> list[Section]:
    """The page below the verdict; what has nothing to show is left out."""
    best = compared(d)[1:]
    tables, texts = cause_tables(d.causes), lead(d)
    first = {"recalibrate": changes, "ambiguous": alternative_table}.get(d.verdict)
    carrying = first(d) if first else None
    tables += [carrying] if carrying else []
    parts = [Section("answer", "The answer in detail", text=texts, tables=tables)] if texts or tables else []
    has = [drawn[name] for name in ("loops", "work") if name in drawn]
    parts += [Section("compared", "Force and work, measured and simulated", pictures=has)] if has else []
    has = [drawn[name] for name in ("maps", "residual") if name in drawn]
    if has:
        title = "Residual before and after" if best else "Residual"
        parts.append(Section("residual", title, text=[RESIDUAL], pictures=has))
    if d.records:
        tables = [t for t in (totals(d), changes(d) if d.verdict != "recalibrate" else None, record_table(d)) if t]
        parts.append(
            Section("records", "Errors of all records", text=[white_noise(d)], pictures=[drawn["errors"]], tables=tables)
        )
    tables = [t for t in (alternative_table(d) if d.verdict != "ambiguous" else None, tried_table(d)) if t]
    if tables:
        has = [drawn["ranking"]] if "ranking" in drawn else []
        parts.append(Section("candidates", "Candidates", pictures=has, tables=tables))
    live = live_part(d)
    if live:
        text = (
            f"The {MOST_LIVE} records of the largest base error at most, oscillation by oscillation."
            if len(d.records) > MOST_LIVE
            else ""
        )
        parts.insert(1, Section("records-live", "Look into the records", text=[text] if text else [], live=live))
    if d.remarks:
        parts.append(Section("remarks", "Remarks", items=d.remarks))
    return parts


def captions(d: Diagnosis) -> dict[str, str]:
    """The text below each picture, which is also its alternative text."""
    record = shown_record(d).record.name if d.records else ""
    many = max((sum(r.split == split for r in d.records) for split in SPLITS), default=0) > MOST
    which = f"the {MOST} worst records of each kind" if many else "every record"
    return {
        "answer": caption(d) if d.records else "",
        "loops": "Mean force over stroke (left) and over velocity (right), first and last oscillation of the fastest block. "
                 "The records of the largest base error, held-out ones first. Curves are broken where a record is not "
                 "compared, as at the ramped ends of a block.",
        "work": "Work per oscillation of these records.",
        "maps": "Root mean square of the residual over each quantity; bars: mean residual of the base model with its sign.",
        "residual": f"Residual over time, record {record}.",
        "errors": f"Error of {which}, held-out ones shaded.",
        "ranking": "Gain: share of the log-likelihood of the held-out records that a candidate takes away, with its "
                   f"{percent(RULES.interval_level)} interval. A triangle at the left edge: it makes things much worse.",
    }  # fmt: skip


def page(d: Diagnosis, images: dict[str, bytes]) -> str:
    """The page with its pictures; that of the answer has a second shape for small screens."""
    texts = captions(d)
    narrow = images.get(NARROW, b"")
    drawn = {name: Picture(data, texts[name], texts[name]) for name, data in images.items() if name in texts}
    first = replace(drawn["answer"], narrow=narrow) if "answer" in drawn else None
    foot = f"Computed in {d.seconds:.0f} s." if d.seconds else ""
    return html(f"Diagnosis: {d.title}", [], sections(d, drawn), [], foot, headline(d, first))


def write_report(diagnosis: Diagnosis, folder: Path) -> list[Path]:
    """Write report.html and its pictures; returns the files. Pictures of an earlier diagnosis are removed."""
    images = {name: style.png(figure) for name, figure in pictures(diagnosis).items()}
    text = page(diagnosis, images)
    files = {folder / f"{name}.png": images[name] for name in images if name != NARROW}
    for name in PICTURES:
        if folder / f"{name}.png" not in files:
            (folder / f"{name}.png").unlink(missing_ok=True)
    for file, data in files.items():
        write_bytes(file, data)
    write_text(folder / "report.html", text)
    return [*files, folder / "report.html"]
