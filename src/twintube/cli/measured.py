"""Commands about measured data and larger computations: check, identify, diagnose, study, reproduce."""

import json
import shutil
from pathlib import Path
from typing import Annotated

import typer
from tqdm import tqdm

from twintube.cli.base import app
from twintube.engine.simulate import InputError
from twintube.files import write_text
from twintube.words import counted


@app.command(epilog="Example: twintube check my_dataset")
def check(
    dataset: Annotated[Path, typer.Argument(help="A folder with dataset.toml and its records, or that file.")],
) -> None:
    """Read measured data and report all errors and warnings; nothing is repaired."""
    from twintube.data import check_dataset

    result = check_dataset(dataset)
    for finding in result.findings:
        typer.echo(str(finding))
    if result.errors:
        raise InputError(f"{dataset}: {counted(len(result.errors), 'error')}, the dataset cannot be used")
    typer.echo(f"{dataset}: {len(result.records)} records, {counted(len(result.findings), 'warning')}, no error")


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
    rows = studies.run(loaded, output, processes=processes, cluster=cluster)
    typer.echo(f"{output}: {rows} rows of {len(loaded)} cases, {loaded.title}")


@app.command(epilog="Example: twintube identify my_dataset --output identified")
def identify(
    dataset: Annotated[Path, typer.Argument(help="A folder with dataset.toml and its records, or that file.")],
    output: Annotated[Path, typer.Option(help="Folder for the parameter set, the report and its pictures.")] = Path(
        "identified"
    ),
    method: Annotated[
        str, typer.Option(help="Optimiser of the third and fourth step: pso (the paper's), cma or de.")
    ] = "pso",
    quick: Annotated[bool, typer.Option("--quick", help="A tenth of the paper's budget, for a first result.")] = False,
    seed: Annotated[int, typer.Option(help="Seed of all random numbers.", min=0)] = 1,
) -> None:
    """Identify a damper from measured data with the paper's four steps, and validate it on the held-out records.

    An interrupted run continues when it is started again with the same output folder.
    """
    from twintube.dampers import to_toml
    from twintube.data import load_dataset
    from twintube.identification import METHODS, PAPER, QUICK, identify_dataset, summary

    if method not in METHODS:
        raise InputError(f"--method {method}: must be one of {', '.join(METHODS)}")
    read = load_dataset(dataset)
    budget = QUICK if quick else PAPER
    journal = output / "journal"
    journal.mkdir(parents=True, exist_ok=True)
    with tqdm(total=budget.generations, unit="generation", leave=False) as bar:

        def progress(title: str, error: float) -> None:
            bar.set_description(title)
            bar.set_postfix_str(f"error {error:.4g}", refresh=False)
            bar.update()

        result = identify_dataset(read, method=method, budget=budget, seed=seed, journal=journal, progress=progress)
    from twintube.report.identification import write_report

    write_text(output / "identified.toml", to_toml(result.identification.damper))
    figures = summary(result)
    write_text(output / "identification.json", json.dumps(figures, indent=1) + "\n")
    write_report(result, output)
    shutil.rmtree(journal)
    for remark in result.remarks:
        typer.echo(f"note: {remark}")
    for e in result.identification.estimates:
        suffix = "" if e.determined else "  not determined"
        typer.echo(
            f"{e.name:10}{e.value:9.3g}   {e.low:.3g} to {e.high:.3g}{suffix}{'  at its bound' if e.at_bound else ''}"
        )
    for kind in ("fit", "heldout"):
        if figures[kind] is not None:
            typer.echo(
                f"{kind:8}{figures[kind]['records']} records: force {figures[kind]['force_rmse_N']:.1f} N "
                f"({figures[kind]['force_rmse_of_peak']:.1%} of the peak), work of the first oscillation "
                f"{figures[kind]['work_error_first']:.1%} off, of the last {figures[kind]['work_error_last']:.1%}"
            )
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

    report = run(output, figures=figure, quick=not paper_budget, processes=processes, report=typer.echo)
    typer.echo(f"{report.page}: {len(report.pictures)} figures")


@app.command(epilog="Example: twintube diagnose my_dataset --output diagnosis")
def diagnose(
    dataset: Annotated[Path, typer.Argument(help="A folder with dataset.toml and its records, or that file.")],
    output: Annotated[Path, typer.Option(help="Folder for the answer, the extended parameter set and the report.")] = Path(
        "diagnosis"
    ),
) -> None:
    """Find the cause of the deviation from the measurement and extend the model, judged on held-out records.

    docs/diagnosis.md gives the hit rates.
    """
    from twintube.dampers import to_toml
    from twintube.diagnosis import as_json
    from twintube.diagnosis import diagnose as run
    from twintube.report.diagnosis import write_report

    with tqdm(unit="fit", leave=False) as bar:

        def progress(text: str) -> None:
            bar.set_description(text)
            bar.update()

        result = run(dataset, progress)
    output.mkdir(parents=True, exist_ok=True)
    write_text(output / "extended.toml", to_toml(result.extended))
    write_text(output / "diagnosis.json", json.dumps(as_json(result), indent=1) + "\n")
    write_report(result, output)
    typer.echo(result.sentence)
    typer.echo(f"{output}: diagnosis.json, extended.toml, report.html ({result.seconds:.0f} s)")
