"""Commands about measured data and larger computations: check, identify, diagnose, study."""

import json
import os
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from twintube.cli.base import BENCH, MODEL, app
from twintube.cli.options import DATASET, PROCESSES, SEARCHES, one_of
from twintube.cli.outputs import check_folder, mark_folder, named, refuse_other
from twintube.common.files import write_text
from twintube.common.words import counted
from twintube.errors import InputError

if TYPE_CHECKING:
    from twintube.diagnosis import Answer
    from twintube.identification.dataset import Result


@app.command(rich_help_panel=BENCH, epilog="Example: twintube check my_dataset")
def check(
    dataset: DATASET,
) -> None:
    """Report errors and doubts about measured data.

    Nothing is repaired.
    """
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


@app.command(rich_help_panel=MODEL, epilog="Example: twintube study oil_levels --output oil_levels.parquet")
def study(
    definition: Annotated[
        str,
        typer.Argument(
            metavar="STUDY",
            help="variants (Figure 33), oil_levels (Figure 34), driving (signals of random cars), or a study file in TOML.",
        ),
    ],
    output: Annotated[Path, typer.Option(metavar="FILE", help="Parquet file for the result.")] = Path("study.parquet"),
    processes: PROCESSES = None,
    cluster: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="Dask scheduler that computes instead, e.g. tcp://10.0.0.1:8786 (extra cluster)."
        ),
    ] = None,
    drives: Annotated[int, typer.Option(metavar="N", help="Of driving: number of drives.")] = 1000,
    minutes: Annotated[float, typer.Option(metavar="MIN", help="Of driving: length of a drive.")] = 5.0,
    seed: Annotated[int, typer.Option(metavar="N", help="Of driving: seed of all that is drawn.")] = 1,
    scalar: Annotated[
        bool, typer.Option("--scalar", help="Of driving: worn dampers as scalar factors, too, on the same roads.")
    ] = False,
    freed_gas: Annotated[
        bool,
        typer.Option("--freed-gas", help="Of driving: worn dampers with the other ways of the freed gas, too."),
    ] = False,
    group: Annotated[
        str | None, typer.Option(metavar="GROUP", help="Of driving: only cars of train, of test, or of other.")
    ] = None,
    per_car: Annotated[
        int, typer.Option(metavar="N", help="Of driving: drives of each car, of which four are its references.")
    ] = 10,
    signals: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Of driving: write the signals of every drive to this folder.")
    ] = None,
) -> None:
    """Compute cases or random drives into a Parquet file.

    A case is a damper, a signal, parameters, an oil level and a variant of the model. The rows of driving are minutes, with
    the features of their signals; started again it goes on where it was interrupted.
    """
    from twintube import studies

    if definition == "driving":
        from twintube.driving.study import Plan, run, summary

        folder = None if signals is None else str(signals.resolve())
        plan = Plan(drives, minutes, seed, scalar, freed_gas, group, per_car, folder)
        if not named():
            refuse_other(output, same=studies.definition_of(output) == plan.text)
        count = (os.cpu_count() or 1) if processes is None else processes
        counts = run(plan, output, processes=count, cluster=cluster)
        typer.echo(summary(plan, output, counts))
        return
    for name in ("drives", "minutes", "seed", "scalar", "freed_gas", "group", "per_car", "signals"):
        if named(name):
            raise InputError(f"--{name.replace('_', '-')}: only with the study driving, not with {definition}")
    loaded = studies.load(definition)
    if not named():
        refuse_other(output, same=studies.definition_of(output) == loaded.text)
    rows = studies.run(loaded, output, processes=processes, cluster=cluster)
    typer.echo(f"{output}: {rows} rows of {len(loaded)} cases, {loaded.title}")


@app.command(rich_help_panel=BENCH, epilog="Example: twintube identify my_dataset --output identified")
def identify(
    dataset: DATASET,
    output: Annotated[
        Path, typer.Option(metavar="FOLDER", help="For the parameter set, the report and its pictures.")
    ] = Path("identified"),
    method: Annotated[
        str,
        one_of(
            SEARCHES,
            help="de: all parameters together, by differential evolution and least squares; before that, pso (the paper's "
            "swarms) takes the paper's third and fourth step.",
        ),
    ] = "de",
    quick: Annotated[
        bool, typer.Option("--quick", help="A shorter search and rougher intervals, for a first result.")
    ] = False,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of all random numbers.", min=0)] = 1,
) -> None:
    """Identify the parameters of a damper from measured data.

    They are validated on records that the search did not see, and it is said what they are good for. An interrupted run
    continues when it is started again with the same output folder.
    """
    from twintube.common.bars import Bar
    from twintube.dampers import to_toml
    from twintube.data import load_dataset
    from twintube.identification import METHODS, PAPER, QUICK, identify_dataset, require_known, summary

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
    with Bar(total=budget.generations(method), unit="generation", leave=False) as bar:

        def progress(title: str, error: float) -> None:
            bar.set_description(title)
            bar.set_postfix_str(f"error {error:.4g}", refresh=False)
            bar.update()

        result = identify_dataset(read, method=method, budget=budget, seed=seed, journal=journal, progress=progress)
    from twintube.report.identification.page import page, write_table

    write_text(output / "identified.toml", to_toml(result.identification.damper))
    figures = summary(result, str(output))
    write_text(output / "identification.json", json.dumps(figures, indent=1) + "\n")
    page(result, output.name).write(output)
    files = write_table(result, output)
    shutil.rmtree(journal)
    for line in identified_lines(result, figures):
        typer.echo(line)
    tables = ", ".join(file.name for file in files)
    typer.echo(f"{output}: identified.toml, identification.json, {tables}, report.html")


def identified_lines(result: "Result", figures: Mapping[str, Any]) -> list[str]:
    """An identification for the terminal."""
    from twintube.identification import headline, table

    kinds = (("fit", "fitted"), ("heldout", "held out"))
    return [
        *(f"note: {remark}" for remark in result.remarks),
        *table(result),
        *(f"{text}: {headline(figures[kind])}" for kind, text in kinds if figures[kind] is not None),
        *figures["judgement"],
        f"Next: {figures['next_step']}.",
    ]


@app.command(rich_help_panel=BENCH, epilog="Example: twintube diagnose my_dataset --output diagnosis")
def diagnose(
    dataset: DATASET,
    output: Annotated[
        Path, typer.Option(metavar="FOLDER", help="For the answer, the extended parameter set and the report.")
    ] = Path("diagnosis"),
    priors: Annotated[
        Path | None, typer.Option(metavar="FILE", help="TOML file with other numbers, see docs/diagnosis_method.md.")
    ] = None,
) -> None:
    """Find a damper's state, what changed, or what is wrong.

    The model is extended by the cause and judged on records that it was not fitted to. extended.toml is written where
    something is named that changes the parameter set. docs/diagnosis.md gives the hit rates.
    """
    from twintube import diagnosis
    from twintube.common.bars import Bar
    from twintube.report.common.titles import in_words

    made_from = {"command": "diagnose", "dataset": str(dataset.resolve())}
    if priors is not None:
        made_from["priors"] = str(priors.resolve())
    with diagnosis.priors(priors or {}):
        check_folder(output, ("diagnosis.json",), made_from)
        with Bar(bar_format="{elapsed}  {desc}", leave=False) as bar:

            def progress(text: str) -> None:
                bar.set_description_str(in_words(text))

            found = diagnosis.diagnose(dataset, progress)
        mark_folder(output, made_from)
        write_answer(found, output)


def write_answer(found: "Answer", output: Path) -> None:
    """Write the files of an answer, and say it."""
    from twintube.dampers import to_toml
    from twintube.diagnosis.contract import as_json
    from twintube.report.diagnosis.page import lines, page

    *sentences, step = lines(found)
    content = as_json(found) | {"sentence": " ".join(sentences), "next_step": step.removeprefix("Next: ")}
    write_text(output / "diagnosis.json", json.dumps(content, indent=1, allow_nan=False) + "\n")
    extended = output / "extended.toml"
    if found.extended is not None:
        write_text(extended, to_toml(found.extended))
    else:
        extended.unlink(missing_ok=True)  # of an earlier run
    page(found).write(output)
    for line in (*sentences, step):
        typer.echo(line)
    files = ["report.html", "diagnosis.json", *([extended.name] if found.extended is not None else [])]
    typer.echo(f"{output}: {', '.join(files)} ({found.seconds:.0f} s)")
