"""Commands about the model: parameter sets, simulation."""

from dataclasses import fields
from pathlib import Path
from typing import Annotated

import typer

from twintube.cli import simulated
from twintube.cli.base import MODEL, app
from twintube.cli.options import AS_PUBLISHED, DAMPER_ARGUMENT
from twintube.cli.outputs import keep_other
from twintube.cli.states import GAS_LOST, GAS_SHARE, OIL_LEVEL
from twintube.common.files import write_bytes, write_text
from twintube.errors import InputError

FOR_FMU = Annotated[
    bool, typer.Option("--for-fmu", help="Columns as the FMU names them, in SI units: for fmpy simulate --input-file.")
]


@app.command("dampers", rich_help_panel=MODEL, epilog="Example: twintube dampers SA8")
def list_dampers(
    damper: Annotated[str | None, DAMPER_ARGUMENT] = None,
    variables: Annotated[
        bool, typer.Option("--variables", help="All inputs, outputs and parameters as Markdown, in place of the dampers.")
    ] = False,
) -> None:
    """List the named dampers, or show one as a parameter file.

    The list has the oil level at which their chambers fall short. A parameter file (TOML) has the sources of its values.
    """
    from twintube import dampers
    from twintube.dampers.dead_length import bounds, collapse_level

    if variables and damper is not None:
        raise InputError(f"--variables: are those of every damper, leave out {damper}")
    if variables:
        print_variables()
        return
    if damper is not None:
        chosen = dampers.load(damper)
        typer.echo(dampers.to_toml(chosen), nl=False)
        return
    for name in dampers.names():
        named = dampers.load(name)
        levels = ", ".join(f"{level:.0%}" for level in named.measured_levels)
        low, high = (collapse_level(named.with_(dead_length=length)) for length in reversed(bounds(named)))
        typer.echo(
            f"{name}  {named.title:36} {named.parameters.V_oil * 1e6:4.0f} mL, measured at 100%, {levels}; "
            f"chambers full down to {collapse_level(named):.1%} ({low:.0%}-{high:.0%})"
        )
    typer.echo(
        "chambers full down to: oil = (A_1 + A_2) l / 2, l = h_l - dead_length; above it a damper that moves little is "
        "as new. In brackets: within the bounds of the dead length, which is assumed"
    )


RECORD = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="A record in any format of a dataset. If the dataset.toml of its folder names it, damper, oil level, "
        "preload, columns and signs come from there; else it needs 'time [s]' and 'stroke [mm]'.",
    ),
]
BLOCK = Annotated[
    int | None,
    typer.Option(metavar="N", min=1, help="Of a file with several tables: the number of the one, from 1."),
]
VELOCITY = Annotated[float, typer.Option(metavar="M/S", help="Without a record: maximum velocity of a harmonic block.")]
AMPLITUDE = Annotated[float, typer.Option(metavar="MM", help="Without a record: amplitude of the block.")]
CSV = Annotated[Path, typer.Option(metavar="FILE", help="CSV file for the result.")]
PLOT = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="PNG file for a picture: stroke, force over stroke and velocity."),
]


@app.command(
    rich_help_panel=MODEL,
    epilog="Example: twintube simulate SA8 --oil-level 0.6 --gas-lost --velocity 1.0 --output loop.csv",
    former={"--gas-present": "--gas-kept"},
)
def simulate(
    damper: Annotated[str | None, DAMPER_ARGUMENT] = None,
    record: RECORD = None,
    block: BLOCK = None,
    velocity: VELOCITY = 1.048,
    amplitude_mm: AMPLITUDE = 45.0,
    oil_level: OIL_LEVEL = None,
    gas_lost: GAS_LOST = None,
    gas: GAS_SHARE = None,
    temperature: Annotated[
        str | None,
        typer.Option(
            metavar="DEGC|column", help="Of oil, seals and gas; `column`: the record's. As the parameters if left out."
        ),
    ] = None,
    published: AS_PUBLISHED = False,
    for_fmu: FOR_FMU = False,
    output: CSV = Path("simulation.csv"),
    plot: PLOT = None,
) -> None:
    """Simulate a block or a record; write forces and volumes.

    The damper may be left out for a record of a dataset. Without a record a harmonic block with its preconditioning is
    simulated. A force in the record is compared with the simulated one.
    """
    from twintube.dampers.freed_gas import acting, as_published
    from twintube.data import Record

    entry = simulated.listed(record, block)
    chosen, state = simulated.filled(simulated.named(damper, record, entry), entry, oil_level, gas_lost, gas)
    chosen = as_published(chosen) if published else chosen
    state += simulated.in_words(temperature)
    motion, findings = (
        (simulated.block_motion(velocity, amplitude_mm), ())
        if record is None
        else simulated.driven_by(chosen, entry, record, block)
    )
    kelvins = simulated.kelvins(temperature, motion, record)
    typer.echo(f"{record}, as its dataset.toml says: {chosen.name}, {state}" if entry else f"{chosen.name}, {state}")
    for finding in findings:
        typer.echo(str(finding))
    result = simulated.run(chosen, motion, kelvins)
    simulated.warn(chosen, motion, result, record)
    text = simulated.as_csv(result, motion, kelvins, for_fmu=for_fmu)
    keep_other(output, text.encode())
    write_text(output, text)
    typer.echo(
        f"{output}: {len(motion.time)} samples, {result.work[-1]:.1f} J dissipated, "
        f"force from {result.force.min():.0f} to {result.force.max():.0f} N; freed gas: {acting(chosen)}"
    )
    if isinstance(motion, Record):
        typer.echo(simulated.against_measured(chosen, motion, result, kelvins))
    if plot is not None:
        name = f"{chosen.name}, {record.name if record else 'harmonic block'}"
        write_bytes(plot, simulated.drawn(name, motion, result))
        typer.echo(f"{plot}: stroke and force over time, force over stroke and velocity")


def print_variables() -> None:
    """Print all inputs, outputs and parameters as Markdown."""
    from twintube.core.effects import Parameters
    from twintube.core.variables import Inputs, Outputs, fmi_name

    typer.echo("Name, symbol, range and unit: meaning, *source*. Without a unit: a share or a number.")
    for record in (Inputs, Outputs, Parameters):
        typer.echo(f"\n## {record.__name__}\n")
        for item in fields(record):
            meta = item.metadata
            name, symbol = fmi_name(item), meta["symbol"]
            size = f"[1..{meta['size']}]" if meta["size"] > 1 else ""
            low, high = ("" if bound is None else f"{bound:g}" for bound in (meta["lower"], meta["upper"]))
            bounds = f"{low}..{high}" if low or high else ""
            unit = "" if meta["unit"] == "1" else meta["unit"]
            head = (
                f"`{name}{size}`" if symbol in ("", name.rpartition(".")[2]) else f"`{name}{size}` {symbol}",
                f"{bounds} {unit}".strip(),
            )
            source = f", *{meta['source']}*" if meta["source"] else ""
            typer.echo(f"- {', '.join(filter(None, head))}: {meta['description']}{source}")
