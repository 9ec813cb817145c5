"""Commands to start with measured data: new-dataset, example."""

from importlib.resources import as_file, files
from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import BENCH, app
from twintube.cli.options import DAMPER_ARGUMENT
from twintube.cli.states import GAS, GAS_SHARE, gas_preload
from twintube.errors import InputError

EXAMPLE = "bench_SA8"
DRIVE_EXAMPLE = "drive"  # `twintube drive --speed 80 --road-class C --minutes 0.5`, worn: rear left, 40 % oil, no gas


@app.command(
    "new-dataset",
    rich_help_panel=BENCH,
    epilog="Example: twintube new-dataset my_dataset SA8 --from block.csv",
    former={"--damper": "", "--gas-present": "--gas-kept"},
)
def new_dataset(
    folder: Annotated[
        Path, typer.Argument(metavar="FOLDER", help="Of the new dataset; files that lie in it are taken, too.")
    ],
    damper: Annotated[str, DAMPER_ARGUMENT] = "",
    source: Annotated[
        list[Path] | None,
        typer.Option("--from", metavar="FILE", help="A measured record to copy into the folder; repeatable."),
    ] = None,
    reference: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="FILE",
            help="A record of the damper as it was, before whatever happened to it; taken like --from; repeatable.",
        ),
    ] = None,
    oil_level: Annotated[
        float | None,
        typer.Option(
            metavar="0..1", min=0.0, max=1.0, help="Share of the intact oil volume in all files; unknown if left out."
        ),
    ] = None,
    gas_lost: Annotated[bool | None, typer.Option(GAS, help="Gas preload in all files; unknown if left out.")] = None,
    gas: GAS_SHARE = None,
) -> None:
    """Write the dataset.toml of measured files for you to confirm.

    Delimiter, decimal sign, header, names and units are found. What is not certain is said in its comments; an oil level and
    a gas preload that are not given are "unknown". No file is overwritten.
    """
    from twintube.data import check_dataset, report
    from twintube.data.findings import UNCONFIRMED
    from twintube.data.sniff.template import Fill, new_dataset

    preload = gas_preload(gas_lost, gas)
    remarks = new_dataset(
        folder, source or [], damper, Fill(oil_level, bool(preload) if preload in (0, 1) else preload), reference or []
    )
    typer.echo(f"{folder / 'dataset.toml'} is written.")
    for doubt, records in remarks.items():
        typer.echo(f"not sure: {doubt} ({', '.join(records)})" if records else f"not sure: {doubt}")
    dataset = check_dataset(folder)
    findings = [finding for finding in dataset.findings if not finding.message.startswith(UNCONFIRMED)]  # said above
    if findings:
        typer.echo(report(findings))
    if dataset.errors:
        typer.echo(f"Next: edit {folder / 'dataset.toml'}, then run: twintube check {folder}")
        return
    typer.echo(f"Next: confirm what is not sure in {folder / 'dataset.toml'}, then run: twintube check {folder}")
    needs = ", which needs oil level and gas preload stated" if any(record.unknown for record in dataset.records) else ""
    typer.echo(f"After that: twintube diagnose {folder}, or twintube identify {folder}{needs}")


@app.command(rich_help_panel=BENCH, epilog="Example: twintube example my_example")
def example(
    folder: Annotated[
        Path, typer.Argument(metavar="FOLDER", help="To copy the example into; it must not exist or be empty.")
    ],
    drive: Annotated[
        bool, typer.Option("--drive", help="Signals of a driving car in place of it: 30 s good, 30 s worn, for the monitor.")
    ] = False,
) -> None:
    """Copy a dataset of seven records to try things on.

    They are from a simulated bench, and `twintube diagnose` finds a cause in them.
    """
    from twintube.common.files import write_bytes

    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError(f"{folder} is there already and not an empty folder; nothing is overwritten")
    with as_file(files("twintube.examples") / (DRIVE_EXAMPLE if drive else EXAMPLE)) as stored:
        paths = sorted(stored.iterdir())
        for path in paths:
            write_bytes(folder / path.name, path.read_bytes())
    if drive:
        typer.echo(f"{folder}: {' and '.join(path.name for path in paths)}")
        typer.echo(f"Next: twintube monitor {folder}/worn.parquet --reference {folder}/good.parquet")
        return
    typer.echo(f"{folder}: dataset.toml and {len(paths) - 1} records")
    typer.echo(f"Next: twintube diagnose {folder}")
