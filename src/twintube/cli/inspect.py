"""The command about inspection: one corner of a car on the benches of a workshop."""

import json
from pathlib import Path
from typing import Annotated

import typer
from tqdm import tqdm

from twintube import dampers
from twintube.cli.base import app
from twintube.cli.outputs import check_folder, mark_folder, of_options
from twintube.files import write_text


@app.command(epilog="Example: twintube inspect SA8 SA1 --method eusama --oil-level 1 --oil-level 0.5 --json inspect.json")
def inspect(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[DAMPER]...", help="Names or parameter files; SA8 if left out.")
    ] = None,
    methods: Annotated[
        list[str] | None,
        typer.Option("--method", help="eusama, phase_shift, damping_ratio, push_down, bump or tiring; all but tiring if left out, which takes as long as "
            "they."),
    ] = None,
    levels: Annotated[
        list[float] | None, typer.Option("--oil-level", help="Oil, share of the intact volume; 1.0 to 0.3 if left out.")
    ] = None,
    gas_lost: Annotated[
        bool | None, typer.Option("--gas-lost/--with-preload", help="Gas preload; lost below 100 % oil if left out.")
    ] = None,
    car: Annotated[str, typer.Option(help="A named car or a car's file.")] = "passat_b8",
    freed_gas: Annotated[str | None, typer.Option(help="What freed gas does; several ways, as a band, if left out.")] = None,
    scatter: Annotated[int, typer.Option(help="Cars and testers drawn for the detection; 0 for none.", min=0)] = 100,
    seed: Annotated[int, typer.Option(help="Seed of the scatter.", min=0)] = 1,
    processes: Annotated[int | None, typer.Option(help="Processes; all cores if left out.", min=1)] = None,
    json_file: Annotated[Path | None, typer.Option("--json", help="Write all figures to this file.")] = None,
    output: Annotated[Path | None, typer.Option(help="Folder for the page and its pictures.")] = None,
) -> None:
    """Put one corner of a car on the inspection benches, and say from which oil level on each method sees the loss."""
    from twintube.dampers.freed_gas import VARIED, known
    from twintube.inspection import LEVELS, USUAL, conditions, inspected, method, study
    from twintube.inspection.detection import check_count
    from twintube.report.inspection import Inspection, summary, terminal, write_report
    from twintube.vehicle.cars import load_car

    if output is not None:
        check_folder(output, ("report.html",), of_options())
    if scatter:
        check_count(scatter)
    wanted = tuple(dict.fromkeys(method(name).name for name in methods or USUAL))
    loaded, vehicle = [dampers.load(name) for name in dict.fromkeys(names or ["SA8"])], load_car(car)
    steps = sorted(dict.fromkeys(levels or LEVELS), reverse=True)
    states = conditions(steps, None if gas_lost is None else int(not gas_lost))
    ways = VARIED if freed_gas is None else (known(freed_gas, "--freed-gas").name,)
    entries = [entry for d in loaded for entry in inspected(d, vehicle, states, wanted, ways=ways)]
    detections = []
    if scatter:
        with tqdm(total=scatter * len(loaded), unit="car", leave=False) as bar:
            detections = study(
                loaded,
                vehicle,
                states,
                wanted,
                count=scatter,
                seed=seed,
                ways=ways,
                processes=processes,
                progress=bar.update,
            )
    result = Inspection(loaded, vehicle, entries, detections, ways, seed)
    if json_file is not None:
        write_text(json_file, json.dumps(summary(result), indent=1) + "\n")
    typer.echo(terminal(result))
    if output is not None:
        files = write_report(result, output)
        mark_folder(output, of_options())
        typer.echo(f"{output}: {', '.join(file.name for file in files)}")
