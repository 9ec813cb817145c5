"""Commands under former names, hidden and said to be former; they go with the next release."""

from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import app
from twintube.cli.fmu import SSV, write_ssv
from twintube.cli.options import AS_PUBLISHED, DAMPER, FRONT, PLATFORM, REAR, SSP, WORN_AT
from twintube.cli.ssp import four, write_container
from twintube.cli.states import GAS_LOST, GAS_SHARE, OIL_LEVEL, WORN_GAS_LOST, WORN_OIL_LEVEL, in_state, worn_preload
from twintube.cli.tables import car_sensitivity, sensitivity

app.command(hidden=True)(car_sensitivity)
app.command(hidden=True, former={"--damper": ""})(sensitivity)


@app.command(hidden=True)
def ssv(
    damper: DAMPER,
    oil_level: OIL_LEVEL = None,
    gas_lost: GAS_LOST = None,
    gas: GAS_SHARE = None,
    published: AS_PUBLISHED = False,
    version: SSP = 1,
    output: Annotated[Path, typer.Option(metavar="FILE", help="SSV file for the parameters.")] = SSV,
) -> None:
    """Write the parameters of a damper for the FMU's importer."""
    from twintube.dampers import load

    write_ssv(in_state(load(damper, as_published=published), oil_level, gas_lost, gas), output, version)


@app.command(hidden=True)
def container(
    output: Annotated[Path, typer.Option(metavar="FILE|FOLDER", help="An .fmu file, or a folder for it.")] = Path(),
    front: FRONT = "SA7",
    rear: REAR = "SA8",
    worn: WORN_AT = "all",
    oil_level: WORN_OIL_LEVEL = 1.0,
    gas_lost: WORN_GAS_LOST = None,
    gas: GAS_SHARE = None,
    step_ms: Annotated[float, typer.Option(metavar="MS", help="Communication step.")] = 1.0,
    platform: PLATFORM = None,
    published: AS_PUBLISHED = False,
) -> None:
    """Write the four dampers of a car as one container FMU."""
    from twintube.dampers.damper import in_words

    preload = worn_preload(gas_lost, gas)
    dampers = four(front, rear, worn, oil_level, preload, published=published)
    write_container(dampers, output, step_ms, platform, f"{front} and {rear}, {worn}: {in_words(oil_level, preload)}")
