"""`python -m benchmarks.good_cars FILE`: how often the monitor calls one of four good dampers.

Drives of test cars with four good dampers are judged.

The cars, tyres and roads are those of the study's group `test`: none is in the training. Four drives of each car are its
references, the others are judged. FILE keeps the drives, so that other tables can judge them again.
"""

import json
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer
from scipy import stats

from twintube.cli.base import standalone
from twintube.common.bars import Bar
from twintube.driving import study
from twintube.driving.channels import PLACES
from twintube.driving.draws import GROUPS, PER_CAR, REFERENCES, draw
from twintube.driving.model import AXLES, FILE, REFERENCE, Model, from_json, shipped
from twintube.driving.scenes import Wear
from twintube.driving.study import Plan
from twintube.driving.training import examples, load

SEED = 7001  # of the cars and drives; the shipped tables were made from others


def numbers(judged: int) -> list[int]:
    """The numbers of so many judged drives of test cars, and of the references of those cars."""
    found: list[int] = []
    car = GROUPS.index("test")
    while judged > 0:
        drives = min(PER_CAR - REFERENCES, judged)
        found += range(car * PER_CAR, car * PER_CAR + REFERENCES + drives)
        judged -= drives
        car += len(GROUPS)
    return found


def good_rows(plan: Plan, number: int) -> list[dict[str, Any]]:
    """The rows of a drive of the study, with four good dampers."""
    drawn = replace(draw(number, 60.0 * plan.minutes, plan.seed), wear=Wear())
    return study.minutes_of(drawn)


def driven(plan: Plan, judged: int, processes: int) -> Iterator[list[dict[str, Any]]]:
    """The rows of each drive."""
    which = numbers(judged)
    with ProcessPoolExecutor(processes) as pool:
        yield from Bar(pool.map(partial(good_rows, plan), which), total=len(which), unit="drive")


def counts(model: Model, file: Path) -> list[dict[str, Any]]:
    """By length, sensors and axle: good dampers that are called, and drives in which any is."""
    drives = load(file)
    seen: Counter[tuple[Any, ...]] = Counter()
    total: Counter[tuple[Any, ...]] = Counter()
    called: dict[tuple[int, str], dict[int, bool]] = {}
    for place in PLACES:
        for drive, length, difference in examples(model, drives, REFERENCE, place):
            for sensors in model.tables[REFERENCE]:
                table = model.table(REFERENCE, sensors, place)
                if all(name in difference.values for name in table.weights):
                    beyond = table.probability(difference) > table.limit
                    key = (length, sensors, AXLES[place])
                    seen[key] += beyond
                    total[key] += 1
                    of_drive = called.setdefault((length, sensors), {})
                    of_drive[id(drive)] = of_drive.get(id(drive), False) or beyond
    table_rows = [(*key, seen[key], total[key]) for key in total]
    table_rows += [(*key, "any of four", sum(some.values()), len(some)) for key, some in called.items()]
    return [as_row(*row) for row in sorted(table_rows)]


def as_row(length: int, sensors: str, axle: str, called: int, of: int) -> dict[str, Any]:
    """A row with the 95 % interval of its share (Clopper and Pearson)."""
    interval = stats.binomtest(called, of).proportion_ci()
    return {"minutes": length, "sensors": sensors, "axle": axle, "called": called, "of": of,
            "share": called / of, "low": float(interval.low), "high": float(interval.high)}  # fmt: skip


def main(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Parquet file of the drives; made if it is not there.")],
    drives: Annotated[int, typer.Option(metavar="N", min=1, help="Judged drives.")] = 2000,
    minutes: Annotated[float, typer.Option(metavar="MIN", min=1.0, help="Length of a drive.")] = 1.0,
    processes: Annotated[int, typer.Option(metavar="N", min=1)] = 1,
    model_file: Annotated[
        Path | None, typer.Option("--model", metavar="FILE", exists=True, help=f"Other tables than the package's {FILE}.")
    ] = None,
) -> None:
    """Drive good cars, and count what the monitor calls."""
    plan = Plan(drives, minutes, SEED)
    if not file.exists():
        study.write_table(plan, [row for rows in driven(plan, drives, processes) for row in rows], file)
    model = shipped() if model_file is None else from_json(model_file.read_text(encoding="utf-8"))
    typer.echo(json.dumps(counts(model, file), indent=1))


if __name__ == "__main__":
    standalone(main)()
