"""`python -m benchmarks NAME --json FILE`: kernel, fmu_step, quarter_car, car, identify, inspect and others."""

import json
import os
import platform
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from benchmarks.calibration import DRAWS, bench_calibration
from benchmarks.car import bench_car, bench_car_steps
from benchmarks.dead_length import bench_dead_length
from benchmarks.driving import bench_driving
from benchmarks.fmu import bench_fmu_step, bench_quarter_car
from benchmarks.gas_path_page import bench_gas_path
from benchmarks.identify import SEEDS, bench_identify
from benchmarks.importers import as_table, bench_importers
from benchmarks.inspect import bench_inspect
from benchmarks.kernel import bench_kernel
from benchmarks.marked_pages import with_table
from benchmarks.oil_leak_page import bench_oil_leak
from benchmarks.priors import bench_priors
from benchmarks.short_steps import bench_short_steps
from benchmarks.small_strokes import bench_small_strokes
from benchmarks.steps import bench_steps
from benchmarks.tiring import bench_rough_road, bench_tiring, bench_tiring_heat
from twintube.cli.base import standalone
from twintube.cli.tables import car_sensitivity, sensitivity
from twintube.engine import compiled
from twintube.errors import UserError

BENCHMARKS: dict[str, Callable[[], dict[str, Any]]] = {
    "kernel": bench_kernel,
    "fmu_step": bench_fmu_step,
    "quarter_car": bench_quarter_car,
    "car": bench_car,
    "car_steps": bench_car_steps,
    "importers": bench_importers,
    "inspect": bench_inspect,
    "driving": bench_driving,
    "steps": bench_steps,
    "short_steps": bench_short_steps,
    "small_strokes": bench_small_strokes,
    "dead_length": bench_dead_length,
    "tiring": bench_tiring,
    "tiring_heat": bench_tiring_heat,
    "rough_road": bench_rough_road,
}
SEEDED: dict[str, Callable[[int, Path | None], dict[str, Any]]] = {
    "identify": lambda seeds, _: bench_identify(seeds),
    "calibration": bench_calibration,
    "priors": lambda _, keep: bench_priors(keep),
}
FEW = {"identify": SEEDS, "calibration": DRAWS}  # seeds by default, where not MANY
MANY = 10
OTHERS: dict[str, Callable[[Path | None, Path | None, Path | None], dict[str, Any]]] = {
    "oil_leak": bench_oil_leak,
    "gas_path": bench_gas_path,
}  # of a parameter file, with picture and tables
OWN: dict[str, Callable[..., None]] = {
    "sensitivity": sensitivity,
    "car_sensitivity": car_sensitivity,
}  # options of their own
TABLES: dict[str, Callable[[Any], str]] = {"importers": as_table}
NAMES = ", ".join((*BENCHMARKS, *SEEDED, *OTHERS, *OWN))
app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)


def as_lines(figures: Mapping[str, Any]) -> str:
    """Figures for the terminal."""
    lines = []
    for key, value in figures.items():
        if isinstance(value, float):
            lines.append(f"{key:32}{value:12.3f}")
        elif isinstance(value, dict):
            lines.append(f"{key}:")
            for row, cells in value.items():
                told = ", ".join(f"{what} {n:.4g}" for what, n in cells.items()) if isinstance(cells, dict) else f"{cells:g}"
                lines.append(f"  {row:34}{told}")
    return "".join(f"{line}\n" for line in lines)


@app.command(epilog="Example: python -m benchmarks kernel --json kernel.json")
def main(
    name: Annotated[str, typer.Argument(help=f"One of {NAMES}.")],
    json_file: Annotated[Path | None, typer.Option("--json", help="Write the figures to this file.")] = None,
    seeds: Annotated[
        int | None,
        typer.Option(
            min=1,
            help=f"Datasets of each kind, for those that draw some; {MANY}, for identify {SEEDS}, for calibration {DRAWS}.",
        ),
    ] = None,
    keep: Annotated[
        Path | None,
        typer.Option(help="Folder that datasets, draws and answers stay in; those there count again."),
    ] = None,
    plot: Annotated[Path | None, typer.Option(help="Picture of oil_leak or gas_path.")] = None,
    tables: Annotated[Path | None, typer.Option(help="Their tables in Markdown.")] = None,
    page: Annotated[
        Path | None,
        typer.Option("--output", exists=True, dir_okay=False, help="Page to put the table into, between its marks."),
    ] = None,
    damper: Annotated[
        Path | None, typer.Option(help="Parameter file for them; by default the paper's eight, for gas_path SA8.")
    ] = None,
) -> None:
    """Measure speed, or make a table of the documentation anew, and print it.

    Short jobs are run several times, the shortest time counts.

    calibration draws datasets from the priors of the diagnosis; priors halves and doubles them on nine datasets. Both take
    about an hour. Datasets with hidden causes: python -m worlds run.
    """
    if name not in (*BENCHMARKS, *SEEDED, *OTHERS):
        typer.echo(f"error: unknown benchmark {name}: must be one of {NAMES}", err=True)
        raise typer.Exit(2)
    if page is not None and name not in TABLES:
        typer.echo(f"error: --output: {name} has no table for a page, only {' and '.join(TABLES)}", err=True)
        raise typer.Exit(2)
    seeds = FEW.get(name, MANY) if seeds is None else seeds
    compiled.module()
    figures: dict[str, Any]
    try:
        if page is not None:
            with_table(page, name, "")  # before hours of work
        if name in OTHERS:
            figures = OTHERS[name](damper, plot, tables)
        else:
            figures = BENCHMARKS[name]() if name in BENCHMARKS else SEEDED[name](seeds, keep)
    except UserError as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from error
    typer.echo(f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}")
    typer.echo(TABLES[name](figures) if name in TABLES else as_lines(figures), nl=False)
    if page is not None:
        page.write_text(with_table(page, name, TABLES[name](figures)), encoding="utf-8")
    if json_file is not None:
        json_file.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")


def run(words: list[str]) -> None:
    """`main`, or a table that has options of its own: `python -m benchmarks car_sensitivity -h`."""
    if words and words[0] in OWN:
        standalone(OWN[words[0]])(words[1:], prog_name=f"python -m benchmarks {words[0]}")
    app(words)


if __name__ == "__main__":
    run(sys.argv[1:])
