"""The command about the signals of a driving car."""

import json
from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import VEHICLE, app
from twintube.cli.options import CARS, JSON_FILE, one_of
from twintube.common.files import write_text
from twintube.errors import InputError


@app.command(
    rich_help_panel=VEHICLE, epilog="Example: twintube monitor drive.parquet --reference good.parquet --output monitor.html"
)
def monitor(
    signals: Annotated[Path, typer.Argument(metavar="SIGNALS", help="Signals of a drive: .csv, .parquet or .mf4.")],
    reference: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="FILE", help="A drive of the same car in its good state; repeatable; the fleet's values if left out."
        ),
    ] = None,
    car: Annotated[
        str | None,
        one_of(CARS, "--car", metavar="CAR", help="Where the files do not say it: a car's file with wheelbase and radius."),
    ] = None,
    json_file: JSON_FILE = None,
    output: Annotated[Path | None, typer.Option(metavar="FILE", help="Write a page, .html.")] = None,
) -> None:
    """Judge the dampers of a car from the signals of a drive.

    It gives each damper a probability that it is worn, and a state: fine, watch or replace.
    """
    from twintube.driving.model import shipped
    from twintube.driving.monitor import watch
    from twintube.driving.sheet import data_sheet
    from twintube.driving.signals import read
    from twintube.report.monitor import page, terminal

    if output is not None and output.suffix != ".html":
        raise InputError(f"--output {output}: must end in .html")
    files = [signals, *(reference or [])]
    if signals.resolve() in [each.resolve() for each in files[1:]]:
        raise InputError(f"--reference {signals}: is the drive itself: must be another drive of the car, in its good state")
    sheet = None if car is None else data_sheet(car)
    drive, *others = [read(path, sheet) for path in files]
    names = [path.name for path in files]
    answer = watch(drive, others, names)
    if json_file is not None:
        content = {"signals": names[0], "references": names[1:], **answer.as_json, "trained_on": shipped().about}
        write_text(json_file, json.dumps(content, indent=1) + "\n")
    typer.echo(terminal(answer))
    if output is not None:
        write_text(output, page(answer, names[0], names[1:], str(shipped().about["says"])).html)
        typer.echo(f"{output}")
