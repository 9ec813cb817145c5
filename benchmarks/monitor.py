"""`python -m benchmarks.monitor drives.parquet`: the monitor's tables, and how many worn dampers they see.

The drives are those of `twintube study driving`: the cars of the group `train` make the tables, those of other groups are
judged.
"""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from twintube.cli.base import standalone
from twintube.common.words import counted
from twintube.dampers.freed_gas import DEFAULT
from twintube.driving import detection
from twintube.driving.model import FILE, WORN, from_json, to_json
from twintube.driving.training import Drive, load, train

PARTS = (0.25, 0.5, 1.0)  # of the cars, for the learning curve


def trained(drives: Sequence[Drive]) -> dict[str, Any]:
    """What is said of a training in the file of the tables; scalar factors and other ways of the freed gas are not in it."""
    drives = [drive for drive in drives if drive.model == DEFAULT]
    cars, minutes = len({drive.car for drive in drives}), sum(len(drive.minutes) for drive in drives)
    says = (
        f"The tables were made from {counted(len(drives), 'simulated drive')} of {cars} cars, {minutes} minutes in all. "
        f"Worn means {WORN:.0%} oil or less. No measured car has been judged with them."
    )
    return {"says": says, "cars": cars, "drives": len(drives), "minutes": minutes, "worn_oil_level": WORN}


def lines(figures: dict[str, Any]) -> list[str]:
    """What was said, in Markdown, of the longest drives."""
    head = ("cars", "sensors", "compared with", "min", "good: called", "good: fine", "good: unlike", "worn: seen",
            "all four: seen", "worn: fine")  # fmt: skip
    table = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    longest = max(row["minutes"] for row in figures["answers"])
    for row in figures["answers"]:
        if row["minutes"] == longest:
            cells = [
                f"{row['cars']} {row['group']}", row["sensors"], row["compared_with"], row["minutes"],
                f"{row['called']} of {row['good']}", row["fine"], row["unlike"], f"{row['seen']} of {row['worn']}",
                f"{row['all four seen']} of {row['all four']}", row["missed"],
            ]  # fmt: skip
            table.append("| " + " | ".join(map(str, cells)) + " |")
    return table


def main(
    drives: Annotated[list[Path], typer.Argument(metavar="FILE", help="Files of `twintube study driving`.")],
    model_file: Annotated[
        Path | None, typer.Option("--model", metavar="FILE", help=f"Write the tables, as {FILE} of the package.")
    ] = None,
    others: Annotated[
        list[Path] | None,
        typer.Option("--others", metavar="FILE", help="Cars of another kind, for which the limits without references hold."),
    ] = None,
    json_file: Annotated[Path | None, typer.Option("--json", metavar="FILE", help="Write all figures to this file.")] = None,
) -> None:
    """Make the monitor's tables from the cars of the training, and judge the drives of the others."""
    loaded = [drive for path in drives for drive in load(path)]
    training = [drive for drive in loaded if drive.group == "train"]
    test = [drive for drive in loaded if drive.group != "train"]
    strange = [drive for path in others or [] for drive in load(path)]
    model = from_json(to_json(train(training, trained(training), strange)))
    if model_file is not None:
        model_file.write_text(to_json(model), encoding="utf-8")
    if not test:
        return
    figures = detection.summary(model, training, test)
    figures["learning_curve"] = detection.learning_curve(training, test, PARTS)
    if json_file is not None:
        json_file.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    typer.echo("\n".join(lines(figures)))


if __name__ == "__main__":
    standalone(main)()
