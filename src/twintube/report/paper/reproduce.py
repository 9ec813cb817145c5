"""The reproduction report: the figures of the paper that a model can produce, and the verdicts on its statements."""

import json
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from twintube.common.bars import Bar
from twintube.common.files import write_bytes
from twintube.dampers import ParameterError
from twintube.engine.simulate import InputError
from twintube.report.common import style
from twintube.report.common.html_page import Finding, Page, Picture, Section, Table
from twintube.report.paper.context import Context
from twintube.report.paper.figures import FIGURES
from twintube.report.paper.statement import Plot, Statement, as_json, plain, verdict
from twintube.version import __version__

TITLE = "Degraded twin-tube shock absorbers: the paper's figures, reproduced"
PAPER = (
    "Schramm, Zwosta, Prokop: Investigation and Phenomenological Modeling of Degraded Twin-Tube Shock Absorbers for Oil "
    "and Gas Loss. Vehicles 2025, 7(1), 26, doi 10.3390/vehicles7010026."
)
LEAD = (
    PAPER,
    "Each figure that a model can produce is drawn as in the paper, with the paper's statements about it. The report "
    "computes whether they hold and gives the numbers; where the paper gives no number, the criterion is stated.",
    "The paper's measurements are unpublished. A virtual rig with other physics replaces them. Its pictures are marked; a "
    "statement checked against the rig shows how well the method handles such data, not how the paper's dampers behave. "
    "F-v curves, friction, gas springs, maximum strokes, dead lengths and drives are assumed; docs/open_choices.md gives "
    "the reasons, and every picture names the assumptions it uses.",
)
BASES = {
    "evidence": "published parameters of Table 9; the F-v curve is assumed or that of the stand-in",
    "calibrated": "not evidence: the statement was used to calibrate the dead lengths",
    "by assumption": "not evidence: the result follows from an assumed value",
    "by construction": "not evidence: the thresholds are written into the code",
    "expectation": "not evidence: the paper expects it and did not measure it",
    "stand-in": "against the virtual rig, not the paper's measurement",
    "consistency": "the model follows its equations",
    "not checkable": "unpublished data would be needed",
}


@dataclass(frozen=True)
class Report:
    """Files and verdicts of the report."""

    page: Path
    json: Path
    pictures: tuple[Path, ...]
    verdicts: dict[int, str]


def figure_numbers(figures: Sequence[str | int] | None) -> list[int]:
    """The numbers of the figures, e.g. `["3", "19-26"]`; raises ParameterError."""
    if not figures:
        return sorted(FIGURES)
    selected: set[int] = set()
    for text in figures:
        first, _, last = str(text).partition("-")
        if not first.isdigit() or (last and not last.isdigit()):
            raise ParameterError(f"figure {text!r}: must be a number or a range like 19-26")
        span = range(int(first), int(last or first) + 1)
        available = {n for n in span if n in FIGURES}
        if not available:
            raise ParameterError(f"figure {text}: must be one of {', '.join(str(n) for n in sorted(FIGURES))}")
        selected |= available
    return sorted(selected)


def reproduce(
    output: Path,
    *,
    figures: Sequence[str | int] | None = None,
    quick: bool = True,
    processes: int | None = None,
    report: Callable[[str], None] | None = None,
) -> Report:
    """Draw the paper's figures and write `index.html`, a PNG per figure and `reproduce.json` into the folder `output`.

    Args:
        output: the folder; it also stores records of the virtual rig and identified dampers for the next run.
        figures: numbers or ranges like `"19-26"`; all if None.
        quick: identify with the small budget instead of the paper's swarms.
        processes: for the virtual rig; all cores if None.
        report: called with a line of text per figure.

    Raises:
        ParameterError: a figure does not exist.
        InputError: a record cannot be simulated, or `processes` is less than 1.

    """
    numbers = figure_numbers(figures)
    if processes is not None and processes < 1:
        raise InputError(f"processes = {processes}: must be at least 1")
    output.mkdir(parents=True, exist_ok=True)
    context = Context(output, quick=quick, processes=processes)
    context.records.prepare(job for number in numbers for job in FIGURES[number].jobs())
    entries, sections, verdicts = [], [], {}
    for number in Bar(numbers, unit="figure", leave=False):
        plot = FIGURES[number].draw(context)
        entries.append(as_json(plot))
        sections.append(section(plot))
        verdicts[number] = plot.verdict
        if report is not None:
            report(f"Figure {number:2}  {plot.verdict:14} {plot.tally}")
    content: dict[str, Any] = {"paper": PAPER, "twintube": __version__, "bases": BASES, "figures": entries}
    write_bytes(output / "reproduce.json", (json.dumps(content, indent=1) + "\n").encode())
    *pictures, page = Page(TITLE, sections, LEAD, [summary(entries)]).write(output, "index.html")
    return Report(page, output / "reproduce.json", tuple(pictures), verdicts)


def section(plot: Plot) -> Section:
    """A figure as a section of the page."""
    notes = [("Stand-in", text.removeprefix("stand-in: ")) for text in plot.stand_ins]
    notes += [("Assumed (unpublished)", ", ".join(plot.assumed))] if plot.assumed else []
    notes += [("Remark", text) for text in plot.remarks]
    return Section(
        anchor=f"figure-{plot.number}",
        title=f"Figure {plot.number}. {plot.title}",
        verdict=plot.verdict,
        tally=plot.tally,
        pictures=[Picture(style.png(plot.figure), f"Figure {plot.number}. {plot.title}", name=f"figure_{plot.number:02}")],
        findings=[finding(statement) for statement in plot.statements],
        notes=notes,
    )


def finding(s: Statement) -> Finding:
    """The page's finding of a statement."""
    claim = s.claim and f"{s.claim} of twintube paper claims"
    facts = {"Source": s.source, "Claim": claim, "Basis": f"{s.basis}: {BASES[s.basis]}", "Criterion": s.criterion}
    given = [(name, text) for name, text in (facts | {"Reason": s.reason}).items() if text]
    return Finding(s.statement, verdict([s.holds]), given, plain(s.numbers))


def summary(entries: Sequence[dict[str, Any]]) -> Table:
    """Number of distinct statements that hold, by basis; a statement of several figures counts once."""
    distinct: dict[str, dict[str, Any]] = {}
    for entry in entries:
        for s in entry["statements"]:
            distinct[s["claim"] or json.dumps([s["statement"], s["numbers"]])] = s
    count = Counter((s["basis"], s["holds"]) for s in distinct.values())
    rows = [
        [basis, meaning, str(count[basis, True]), str(count[basis, False]), str(count[basis, None])]
        for basis, meaning in BASES.items()
        if any(count[basis, holds] for holds in (True, False, None))
    ]
    return Table(("basis", "meaning", "holds", "does not hold", "not checkable"), rows, "Statements by basis")
