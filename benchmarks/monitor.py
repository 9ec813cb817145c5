"""`python -m benchmarks.monitor drives.parquet`: the monitor's tables, and how many worn dampers they see.

The drives are those of `twintube study driving`: the cars of the group `train` make the tables, those of other groups are
judged.
"""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import pyarrow.parquet as pq
import typer

from twintube.cli.base import standalone
from twintube.common.words import counted
from twintube.dampers.freed_gas import DEFAULT
from twintube.driving import detection
from twintube.driving.draws import vehicle
from twintube.driving.model import AXLES, FILE, WORN, from_json, to_json
from twintube.driving.training import Drive, load, train

MUCH = 100.0  # [N] friction of the suspension that hides wear


def trained(drives: Sequence[Drive]) -> dict[str, Any]:
    """What is said of a training in the file of the tables; scalar factors and other ways of the freed gas are not in it."""
    drives = [drive for drive in drives if drive.model == DEFAULT]
    cars, minutes = len({drive.car for drive in drives}), sum(len(drive.minutes) for drive in drives)
    says = (
        f"The tables were made from {counted(len(drives), 'simulated drive')} of {cars} cars, {minutes} minutes in all. "
        f"Worn means {WORN:.0%} oil or less. No measured car whose dampers are known has been judged with them."
    )
    return {"says": says, "cars": cars, "drives": len(drives), "minutes": minutes, "worn_oil_level": WORN}


def lines(answers: Sequence[dict[str, Any]]) -> list[str]:
    """What was said, in Markdown, of the longest drives."""
    head = ("dampers of", "sensors", "compared with", "min", "good: called", "good: fine", "good: unlike", "worn: seen",
            "all four: seen", "worn: fine")  # fmt: skip
    table = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
    longest = max(row["minutes"] for row in answers)
    for row in answers:
        if row["minutes"] == longest:
            cells = [
                f"{row['cars']} cars, {row['kind']}", row["sensors"], row["compared_with"], row["minutes"],
                f"{row['called']} of {row['good']}", row["fine"], row["unlike"], f"{row['seen']} of {row['worn']}",
                f"{row['all four seen']} of {row['all four']}", row["missed"],
            ]  # fmt: skip
            table.append("| " + " | ".join(map(str, cells)) + " |")
    return table


def frictions(path: Path, drives: Sequence[Drive]) -> dict[tuple[str, str], float]:
    """Friction [N] of the suspension by car and axle; a study's file says from which seed its cars were drawn."""
    seed = json.loads(pq.read_schema(path).metadata[b"twintube.study"])["seed"]
    found: dict[tuple[str, str], float] = {}
    for car in {drive.car for drive in drives}:
        group, number, *_ = car.split()
        for axle, values in vehicle(group, int(number), seed).car.axles.items():
            found[car, axle] = values["friction"]
    return found


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
    loaded = {path: load(path) for path in drives}
    every = [drive for some in loaded.values() for drive in some]
    training = [drive for drive in every if drive.group == "train"]
    test = [drive for drive in every if drive.group != "train"]
    strange = [drive for path in others or [] for drive in load(path)]
    model = from_json(to_json(train(training, trained(training), strange)))
    if model_file is not None:
        model_file.write_text(to_json(model), encoding="utf-8")
    if not test:
        return
    friction = {key: value for path, some in loaded.items() for key, value in frictions(path, some).items()}

    def rubbing(each: detection.Judged) -> str:
        """Whether friction may hide the wear of a damper."""
        above = friction[each.drive.car, AXLES[each.place]] > MUCH
        return f"friction {'above' if above else 'up to'} {MUCH:g} N"

    some = detection.tested(model, training, test)
    figures = detection.summary(some) | {"by_friction": detection.answers(some, rubbing)}
    if json_file is not None:
        json_file.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    typer.echo("\n".join([*lines(figures["answers"]), "", *lines(figures["by_friction"])]))


if __name__ == "__main__":
    standalone(main)()
