"""The command about inspection: one corner of a car on the benches of a workshop."""

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from twintube.cli.base import VEHICLE, app
from twintube.cli.options import CAR, FREED_GAS, INSPECTIONS, JSON_FILE, dampers, one_of
from twintube.cli.outputs import check_folder, mark_folder, of_options
from twintube.cli.states import GAS_SHARE, LOST_BELOW_FULL, worn_preload
from twintube.common.files import write_text
from twintube.errors import InputError

if TYPE_CHECKING:
    from twintube.dampers import Damper


def at_dead_lengths(damper: "Damper", lengths_mm: Sequence[float] | None) -> "list[Damper]":
    """The damper with each of these dead lengths, which its name then says; raises InputError outside their bounds."""
    from twintube.core.checks import outside
    from twintube.dampers.dead_length import LONGEST, SHORTEST

    changed = []
    for length in lengths_mm or []:
        message = outside("--dead-length", length, SHORTEST * 1e3, LONGEST * 1e3, "mm")
        if message:
            raise InputError(f"{message}: piston with its valves, foot valve and rebound stop take that much of the tube")
        changed.append(replace(damper.with_(dead_length=length * 1e-3), name=f"{damper.name}_{length:g}mm"))
    return changed or [damper]


def wanted_dampers(names: Sequence[str], lengths_mm: Sequence[float]) -> "list[Damper]":
    """Each damper once, with each dead length once; raises InputError."""
    from twintube.dampers import load

    chosen, lengths = [load(name) for name in dict.fromkeys(names)], list(dict.fromkeys(lengths_mm))
    return [each for damper in chosen for each in at_dead_lengths(damper, lengths)]


NAMES = Annotated[
    list[str] | None,
    typer.Argument(metavar="DAMPER", autocompletion=dampers, help="Names or parameter files; SA8 if left out."),
]
METHODS = Annotated[
    list[str] | None,
    one_of(
        INSPECTIONS,
        "--method",
        metavar="NAME",
        help=f"{', '.join(INSPECTIONS)}; repeatable; if left out all but tiring, which takes as long as they do.",
    ),
]
LEVELS = Annotated[
    list[float] | None,
    typer.Option(
        "--oil-level",
        metavar="0..1",
        help="Oil, share of the intact volume; repeatable; 1.0 to 0.3 if left out. The gas preload stays unless --gas-lost.",
    ),
]
DEAD_LENGTHS = Annotated[
    list[float] | None,
    typer.Option(
        "--dead-length", metavar="MM", help="Dead length in place of the damper's, 60 to 110; several are compared."
    ),
]
WAY = Annotated[
    str | None,
    one_of(FREED_GAS, metavar="WAY", help=f"What freed gas does: {', '.join(FREED_GAS)}; several as a band if left out."),
]
PLATES = Annotated[
    list[float] | None,
    typer.Option(metavar="MM", help="Amplitude of the plate of tiring; several in turn; 6, 8 and 10 if left out."),
]
SCATTER = Annotated[int, typer.Option(metavar="N", help="Cars and testers drawn for the detection; 0 for none.", min=0)]


@app.command(
    rich_help_panel=VEHICLE,
    epilog="Example: twintube inspect SA8 SA1 --method eusama --oil-level 1 --oil-level 0.5 --gas-lost --json inspect.json",
    former={"--with-preload": "--gas-kept"},
)
def inspect(
    names: NAMES = None,
    methods: METHODS = None,
    levels: LEVELS = None,
    gas_lost: LOST_BELOW_FULL = None,
    gas: GAS_SHARE = None,
    dead_lengths: DEAD_LENGTHS = None,
    car: CAR = "passat_b8",
    freed_gas: WAY = None,
    plate: PLATES = None,
    scatter: SCATTER = 100,
    seed: Annotated[int, typer.Option(metavar="N", help="Seed of the scatter.", min=0)] = 1,
    processes: Annotated[int | None, typer.Option(metavar="N", help="Processes; all cores if left out.", min=1)] = None,
    json_file: JSON_FILE = None,
    output: Annotated[Path | None, typer.Option(metavar="FOLDER", help="For the page and its pictures.")] = None,
) -> None:
    """Put a corner of the car on inspection benches.

    It says from which oil level on each method sees the loss.
    """
    from twintube.common.bars import Bar
    from twintube.dampers.freed_gas import VARIED, known
    from twintube.inspection import LEVELS as USUAL_LEVELS
    from twintube.inspection import USUAL, Setting, conditions, inspected, method, study
    from twintube.inspection.detection import check_count
    from twintube.inspection.tiring import AMPLITUDES, shaker
    from twintube.report.inspection.page import page
    from twintube.report.inspection.summary import Inspection, summary, terminal
    from twintube.vehicle.cars import load_car

    if output is not None:
        check_folder(output, ("report.html",), of_options())
    if scatter:
        check_count(scatter)
    wanted = tuple(dict.fromkeys(method(name).name for name in methods or USUAL))
    if plate and "tiring" not in wanted:
        raise InputError("--plate: is the plate of --method tiring, which is not among the methods")
    plates = shaker(sorted(x * 1e-3 for x in dict.fromkeys(plate)) if plate else AMPLITUDES)
    loaded, vehicle = wanted_dampers(names or ["SA8"], dead_lengths or []), load_car(car)
    steps = sorted(dict.fromkeys(levels or USUAL_LEVELS), reverse=True)
    states = conditions(steps, worn_preload(gas_lost, gas))
    ways = VARIED if freed_gas is None else (known(freed_gas, "--freed-gas").name,)
    setting = Setting(shaker=plates)
    entries = [entry for d in loaded for entry in inspected(d, vehicle, states, wanted, ways=ways, setting=setting)]
    detections = []
    if scatter:
        with Bar(total=scatter * len(loaded), unit="car", leave=False) as bar:
            detections = study(
                loaded, vehicle, states, wanted,
                count=scatter, seed=seed, ways=ways, plates=plates, processes=processes, progress=bar.update,
            )  # fmt: skip
    result = Inspection(loaded, vehicle, entries, detections, ways, seed, [each.amplitude for each in plates])
    if json_file is not None:
        write_text(json_file, json.dumps(summary(result), indent=1) + "\n")
    typer.echo(terminal(result))
    if output is not None:
        files = page(result).write(output)
        mark_folder(output, of_options())
        typer.echo(f"{output}: {', '.join(file.name for file in files)}")
