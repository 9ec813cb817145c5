"""Commands that evaluate the paper: its claims, its figures, its readings, and the dead lengths found from them."""

import json
import math
from dataclasses import asdict, fields
from pathlib import Path
from typing import Annotated, Any

import typer

from twintube.cli.base import PAPER, STYLE, App, Group, app
from twintube.cli.options import DAMPER, FREED_GAS, PROCESSES, START, STARTS, one_of
from twintube.cli.outputs import check_folder, mark_folder, of_options
from twintube.common.files import write_text
from twintube.errors import ParameterError

paper = App(**STYLE, cls=Group, no_args_is_help=True)
app.add_typer(paper, name="paper", rich_help_panel=PAPER)
BEGINNING = Annotated[str, one_of(STARTS, help="Where an oscillation begins.")]


@paper.callback()
def about() -> None:
    """Measure and judge as the paper: rig, claims, figures, readings."""


@paper.command(rich_help_panel=PAPER, epilog="Example: twintube paper figures --output reproduction")
def figures(
    output: Annotated[Path, typer.Option(metavar="FOLDER", help="For the page, its pictures and reproduce.json.")] = Path(
        "reproduction"
    ),
    figure: Annotated[
        list[str] | None, typer.Option(metavar="N", help="Only these figures, e.g. 3 or 19-26; repeatable.")
    ] = None,
    paper_budget: Annotated[
        bool, typer.Option("--paper-budget", help="Identify for Figures 19 to 26 with the paper's swarms: an hour.")
    ] = False,
    processes: PROCESSES = None,
) -> None:
    """Draw the paper's figures from the model.

    Each stands beside the paper's statement, and whether it holds. The paper's measured curves are unpublished. The virtual
    rig replaces them; the pictures are marked.
    """
    from twintube.report.paper.reproduce import reproduce

    check_folder(output, ("reproduce.json",), of_options())
    report = reproduce(output, figures=figure, quick=not paper_budget, processes=processes, report=typer.echo)
    mark_folder(output, of_options())
    typer.echo(f"{report.page}: {len(report.pictures)} figures")


@paper.command(rich_help_panel=PAPER, epilog="Example: twintube paper claims --json claims.json")
def claims(
    json_file: Annotated[
        Path | None, typer.Option("--json", metavar="FILE", help="Write one entry per claim to this file.")
    ] = None,
    reading: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=NUMBER", help="Another reading of the paper, e.g. leak_carries_oil=1; repeatable."),
    ] = None,
    start: BEGINNING = START,
    freed_gas: Annotated[
        str,
        one_of(
            FREED_GAS,
            metavar="WAY",
            help=f"What freed gas does in every run: {', '.join(FREED_GAS)}; if left out: stays, in drives dissolves.",
        ),
    ] = "",
    rear_curve: Annotated[
        bool, typer.Option("--rear-curve", help="Rear dampers with the rear F-v curve of the source of the front one.")
    ] = False,
) -> None:
    """Evaluate the paper's statements C1 to C17 with its parameters."""
    from twintube.claims import EVALUATORS, evaluate
    from twintube.common.bars import Bar

    readings = dict(parsed_reading(text) for text in reading or [])
    claims_one_by_one = evaluate(readings, bench(start, freed_gas), rear=rear_curve)
    results = list(Bar(claims_one_by_one, total=len(EVALUATORS), unit="claim", leave=False))
    if json_file is not None:
        write_text(
            json_file, json.dumps([asdict(c) | {"kind": c.kind, "evidence": c.evidence} for c in results], indent=1) + "\n"
        )
    for c in results:
        typer.echo(f"{c.id:4}{'holds' if c.holds else 'DOES NOT HOLD':15}{c.kind:17}{c.statement} ({c.source})")
        typer.echo(f'      the paper: "{c.quote}"')
        typer.echo(f"      tested: {c.tested}")
        for name, value in c.figures.items():
            typer.echo(f"      {name}: {json.dumps(value)}")
        typer.echo(f"      needs: {c.needs}")
        if c.calibrated:
            typer.echo(f"      used for the dead length of: {', '.join(c.calibrated)}")
        if not c.holds:
            typer.echo(f"      why not ({c.because}): {c.reason}")
    for kind in dict.fromkeys(["evidence", *(c.kind for c in results)]):
        some = [c for c in results if c.kind == kind]
        typer.echo(f"{kind}: {sum(c.holds for c in some)} of {len(some)} hold")


def bench(start: str, freed_gas: str = "") -> Any:
    """The bench of the claims; raises ParameterError."""
    from twintube.claims import Bench
    from twintube.dampers.freed_gas import known

    if start not in STARTS:
        raise ParameterError(f"--start {start}: must be one of {', '.join(STARTS)}")
    return Bench(start=start, freed_gas=known(freed_gas, "--freed-gas").name if freed_gas else "")


def parsed_reading(text: str) -> tuple[str, float]:
    """`name=value` of a reading; raises ParameterError."""
    from twintube.core.effects import Parameters

    name, _, value = text.partition("=")
    known = {item.name: item.metadata["integer"] for item in fields(Parameters) if item.metadata["group"] == "reading"}
    try:
        number = float(value)
    except ValueError:
        number = math.nan
    if name not in known or not math.isfinite(number) or (known[name] and number % 1):
        raise ParameterError(
            f"--reading {text}: must be NAME=NUMBER with a name of {', '.join(known)}, whole but for the last"
        )
    return name, int(number) if known[name] else number


@paper.command(rich_help_panel=PAPER, epilog="Example: twintube paper calibrate SA8")
def calibrate(
    damper: DAMPER,
    start: BEGINNING = START,
) -> None:
    """Find the dead length of the chambers from all claims.

    So it was done for the named dampers.
    """
    from twintube import dampers
    from twintube.claims.calibrate import calibrate as run

    result = run(dampers.load(damper), bench(start))
    for fit in result.fits:
        deviations = ", ".join(f"{name} {value:.2f}" for name, value in fit.deviations.items() if value)
        mark = "chosen" if fit is result.chosen else ""
        typer.echo(f"{mark:8}{fit.dead_length * 1e3:5.0f} mm  misfit {fit.misfit:7.2f}  {deviations}")
    low, high = (1e3 * x for x in result.range)
    typer.echo(f"as good as the best: {low:.0f} to {high:.0f} mm (deviations from the claims in units of their tolerances)")


@paper.command(rich_help_panel=PAPER, epilog="Example: twintube paper readings --json readings.json")
def readings(
    json_file: Annotated[
        Path | None, typer.Option("--json", metavar="FILE", help="Write every effect to this file.")
    ] = None,
) -> None:
    """Measure what other readings of the paper do to every claim.

    Varied are readings, start, position, amplitude, what freed gas does, and the F-v curve.
    """
    from twintube.claims.compare import alternatives, compare
    from twintube.common.bars import Bar

    table = []
    for other, effects in Bar(compare(), total=len(alternatives()), unit="choice", leave=False):
        flips = [f"{e.id} {'holds' if e.holds else 'fails'}" for e in effects if e.flips]
        Bar.write(f"{other.name} = {other.value}: {', '.join(flips) or 'no claim flips'}")
        for effect in effects:
            if effect.moves:
                Bar.write(f"      {effect.id:4}{effect.moves}")
        table.append({"choice": other.name, "value": other.value, "claims": [asdict(effect) for effect in effects]})
    if json_file is not None:
        write_text(json_file, json.dumps(table, indent=1) + "\n")
