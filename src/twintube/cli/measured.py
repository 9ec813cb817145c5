"""Commands about measured data and larger computations: check, identify, diagnose, study, reproduce."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer
from tqdm import tqdm

from twintube.cli.base import app
from twintube.cli.outputs import check_folder, mark_folder, named, of_options, refuse_other
from twintube.engine.simulate import InputError
from twintube.files import write_text
from twintube.words import counted


@app.command(epilog="Example: twintube check my_dataset")
def check(
    dataset: Annotated[Path, typer.Argument(help="A folder with dataset.toml and its records, or that file.")],
) -> None:
    """Read measured data and report all errors, warnings and remarks; nothing is repaired."""
    from twintube.data import check_dataset, report

    result = check_dataset(dataset)
    if result.findings:
        typer.echo(report(result.findings))
    if result.errors:
        raise InputError(f"{dataset}: {counted(len(result.errors), 'error')}, the dataset cannot be used")
    warnings = sum(finding.severity == "warning" for finding in result.findings)
    left_out = sum(int((~record.usable).sum()) for record in result.records)
    samples = f", {counted(left_out, 'sample')} left out" if left_out else ""
    typer.echo(f"{dataset}: {len(result.records)} records{samples}, {counted(warnings, 'warning')}, no error")


@app.command(epilog="Example: twintube study oil_levels --output oil_levels.parquet")
def study(
    definition: Annotated[
        str, typer.Argument(help="variants (Figure 33), oil_levels (Figure 34), or a study file in TOML.")
    ],
    output: Annotated[Path, typer.Option(help="Parquet file for the result.")] = Path("study.parquet"),
    processes: Annotated[int | None, typer.Option(help="Processes on this machine; all cores if left out.")] = None,
    cluster: Annotated[
        str | None, typer.Option(help="Dask scheduler that computes instead, e.g. tcp://10.0.0.1:8786 (extra cluster).")
    ] = None,
) -> None:
    """Compute a grid over dampers, signals, parameters, oil levels and model variants into a Parquet file."""
    from twintube import studies

    loaded = studies.load(definition)
    if not named():
        refuse_other(output, same=studies.definition_of(output) == loaded.text)
    rows = studies.run(loaded, output, processes=processes, cluster=cluster)
    typer.echo(f"{output}: {rows} rows of {len(loaded)} cases, {loaded.title}")


@app.command(epilog="Example: twintube identify my_dataset --output identified")
def identify(
    dataset: Annotated[Path, typer.Argument(help="A folder with dataset.toml and its records, or that file.")],
    output: Annotated[Path, typer.Option(help="Folder for the parameter set, the report and its pictures.")] = Path(
        "identified"
    ),
    method: Annotated[
        str,
        typer.Option(
            help="de: all parameters together, by differential evolution and least squares; before that, pso (the paper's "
            "swarms) or cma take the paper's third and fourth step."
        ),
    ] = "de",
    quick: Annotated[
        bool, typer.Option("--quick", help="A shorter search and rougher intervals, for a first result.")
    ] = False,
    seed: Annotated[int, typer.Option(help="Seed of all random numbers.", min=0)] = 1,
) -> None:
    """Identify a damper from measured data, validate it on the held-out records, and say what it is good for.

    An interrupted run continues when it is started again with the same output folder.
    """
    from twintube.dampers import to_toml
    from twintube.data import load_dataset
    from twintube.identification import METHODS, PAPER, QUICK, headline, identify_dataset, require_known, summary, table

    if method not in METHODS:
        raise InputError(f"--method {method}: must be one of {', '.join(METHODS)}")
    read = load_dataset(dataset)
    require_known(read)  # before a folder is made
    made_from = {"command": "identify", "dataset": str(dataset.resolve())}
    check_folder(output, ("identification.json", "journal"), made_from)
    budget = QUICK if quick else PAPER
    journal = output / "journal"
    journal.mkdir(parents=True, exist_ok=True)
    mark_folder(output, made_from)
    with tqdm(total=budget.generations(method), unit="generation", leave=False) as bar:

        def progress(title: str, error: float) -> None:
            bar.set_description(title)
            bar.set_postfix_str(f"error {error:.4g}", refresh=False)
            bar.update()

        result = identify_dataset(read, method=method, budget=budget, seed=seed, journal=journal, progress=progress)
    from twintube.report.identification import write_report

    write_text(output / "identified.toml", to_toml(result.identification.damper))
    figures = summary(result, str(output))
    write_text(output / "identification.json", json.dumps(figures, indent=1) + "\n")
    write_report(result, output)
    shutil.rmtree(journal)
    for remark in result.remarks:
        typer.echo(f"note: {remark}")
    for line in table(result):
        typer.echo(line)
    for kind, text in (("fit", "fitted"), ("heldout", "held out")):
        if figures[kind] is not None:
            typer.echo(f"{text}: {headline(figures[kind])}")
    for sentence in figures["judgement"]:
        typer.echo(sentence)
    typer.echo(f"Next: {figures['next_step']}.")
    typer.echo(f"{output}: identified.toml, identification.json, report.html")


@app.command(epilog="Example: twintube reproduce --output reproduction")
def reproduce(
    output: Annotated[Path, typer.Option(help="Folder for the page, its pictures and reproduce.json.")] = Path(
        "reproduction"
    ),
    figure: Annotated[list[str] | None, typer.Option(help="Only these figures, e.g. 3 or 19-26; repeatable.")] = None,
    paper_budget: Annotated[
        bool, typer.Option("--paper-budget", help="Identify for Figures 19 to 26 with the paper's swarms: an hour.")
    ] = False,
    processes: Annotated[int | None, typer.Option(help="Processes on this machine; all cores if left out.")] = None,
) -> None:
    """Draw the paper's figures from the model, each with the paper's statement and whether it holds.

    The paper's measured curves are unpublished. The virtual rig replaces them; the pictures are marked.
    """
    from twintube.report.reproduce import reproduce as run

    check_folder(output, ("reproduce.json",), of_options())
    report = run(output, figures=figure, quick=not paper_budget, processes=processes, report=typer.echo)
    mark_folder(output, of_options())
    typer.echo(f"{report.page}: {len(report.pictures)} figures")


@app.command(epilog="Example: twintube diagnose my_dataset --output diagnosis --tolerance 3%")
def diagnose(
    dataset: Annotated[Path, typer.Argument(help="A folder with dataset.toml and its records, or that file.")],
    output: Annotated[Path, typer.Option(help="Folder for the answer, the extended parameter set and the report.")] = Path(
        "diagnosis"
    ),
    tolerance: Annotated[
        str,
        typer.Option(help="Error that a good damper may have: 3%, or 0.03, of the largest force of each record."),
    ] = "0%",
) -> None:
    """Find the cause of the deviation from the measurement and extend the model, judged on held-out records.

    extended.toml is written where something is named that changes the parameter set. docs/diagnosis.md gives the hit rates.
    """
    from twintube.dampers import to_toml
    from twintube.data import ReferenceGivenError, UnknownFillError
    from twintube.diagnosis import as_json
    from twintube.diagnosis import diagnose as run
    from twintube.diagnosis.rules import RULES
    from twintube.report.answer import has_extension, lines, next_step
    from twintube.report.diagnosis import write_report
    from twintube.report.engineering import in_words

    accepted = share_of(tolerance, RULES.most_tolerance, "--tolerance")
    written: list[str] | None = None
    made_from = {"command": "diagnose", "dataset": str(dataset.resolve())}
    check_folder(output, ("diagnosis.json",), made_from)
    with tqdm(bar_format="{elapsed}  {desc}", leave=False) as bar:

        def progress(text: str) -> None:
            bar.set_description_str(in_words(text))

        try:
            result = run(dataset, progress, tolerance=accepted)
        except (UnknownFillError, ReferenceGivenError):
            if accepted > 0.0:
                raise InputError("--tolerance: cannot be given where a fill is unknown or records are a reference") from None
            written = by_evidence(dataset, output, progress)
    if written is not None:
        mark_folder(output, made_from)
        for line in written:
            typer.echo(line)
        return
    mark_folder(output, made_from)
    extended = output / "extended.toml"
    if has_extension(result):
        write_text(extended, to_toml(result.extended))
    else:
        extended.unlink(missing_ok=True)  # of an earlier run
    content = as_json(result) | {"next_step": next_step(result)}
    write_text(output / "diagnosis.json", json.dumps(content, indent=1) + "\n")
    write_report(result, output)
    for line in lines(result):
        typer.echo(line)
    files = ["report.html", "diagnosis.json", *([extended.name] if has_extension(result) else [])]
    typer.echo(f"{output}: {', '.join(files)} ({result.seconds:.0f} s)")


def by_evidence(dataset: Path, output: Path, progress: Callable[[str], None]) -> list[str]:
    """Find fills that are unknown, and what has happened since a reference; write the answer; its lines for the terminal."""
    from twintube.dampers import to_toml
    from twintube.data import load_dataset
    from twintube.evidence import answer
    from twintube.evidence.contract import as_json
    from twintube.report.answered import lines, write_report

    read = load_dataset(dataset)
    found = answer(read, progress)
    output.mkdir(parents=True, exist_ok=True)
    write_text(output / "diagnosis.json", json.dumps(as_json(found), indent=1, allow_nan=False) + "\n")
    extended = output / "extended.toml"
    if found.extended is not None:
        write_text(extended, to_toml(found.extended))
    else:
        extended.unlink(missing_ok=True)
    write_report(read.title, found, output)
    files = ["report.html", "diagnosis.json", *(["extended.toml"] if found.extended is not None else [])]
    return [*lines(found), f"{output}: {', '.join(files)} ({found.seconds:.0f} s)"]


def share_of(text: str, most: float, option: str) -> float:
    """A share up to `most` from a text such as `3%` or `0.03`; raises InputError that names the option."""
    digits = text.strip().removesuffix("%")
    divisor = 1.0 if digits == text.strip() else 100.0
    try:
        value = float(digits) / divisor
    except ValueError:
        raise InputError(f"{option} {text}: must be a percentage such as 3% or a share such as 0.03") from None
    if not 0.0 <= value <= most:
        raise InputError(f"{option} {text}: must be from 0% to {100 * most:g}%, or from 0 to {most:g}")
    return value
