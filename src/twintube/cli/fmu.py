"""Commands about the FMU: build it, write its parameters."""

import time
from pathlib import Path
from typing import Annotated, Literal

import typer

from twintube.cli.base import MODEL, app
from twintube.cli.options import AS_PUBLISHED, DAMPER, DAMPER_ARGUMENT, PLATFORM, SSP
from twintube.cli.outputs import keep_other, refuse_other
from twintube.cli.states import GAS_LOST, OIL_LEVEL, in_state, in_words
from twintube.common.files import write_text
from twintube.common.words import printable

PARAMETERS = Annotated[Path | None, typer.Option(metavar="FILE", help="A parameter file (TOML) instead of a named damper.")]


def tested(fmu: Path) -> None:
    """Print how far an FMU is from its reference run; ends with 1 where that is too far. Raises TrialError."""
    from twintube.fmu.instance import FmuError
    from twintube.fmu.trial import TOLERANCE, tried

    try:
        differences = tried(fmu)
    except FmuError as error:
        typer.echo(f"{fmu}: {error}")
        raise typer.Exit(1) from None
    right = all(each.right for each in differences)
    verdict = "computes its reference run" if right else f"differs from its reference run by more than {TOLERANCE:g}"
    typer.echo(f"{fmu}: {verdict}; largest difference: {', '.join(map(str, differences))}")
    if not right:
        raise typer.Exit(1)


@app.command(rich_help_panel=MODEL, epilog="Example: twintube fmu SA8 --oil-level 0.6 --gas-lost --output rear_60.fmu")
def fmu(
    ctx: typer.Context,
    damper: Annotated[str | None, DAMPER_ARGUMENT] = None,
    parameters: PARAMETERS = None,
    oil_level: OIL_LEVEL = None,
    gas_lost: GAS_LOST = None,
    kind: Annotated[
        Literal["native", "python"],
        typer.Option(metavar="native|python", help="Compiled, or Python source that the host's Python runs."),
    ] = "native",
    fmi: Annotated[Literal[2, 3], typer.Option(metavar="2|3", help="Version of FMI, 2.0 or 3.0.")] = 2,
    platform: PLATFORM = None,
    published: AS_PUBLISHED = False,
    output: Annotated[Path, typer.Option(metavar="FILE|FOLDER", help="An .fmu file, or a folder for it.")] = Path(),
    test: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Build nothing: run this FMU against its own reference run.")
    ] = None,
) -> None:
    """Build the FMU of a damper and validate it, or test one.

    Without a damper it is that of SA8; fmpy validates it. Gas that cavitation frees dissolves again, unless --as-published
    asks for the paper's equations alone or the parameter set says what freed gas does.

    The first build for Windows compiles the runtime too and takes a minute or two; later ones take seconds.
    """
    from twintube.dampers import load
    from twintube.dampers.freed_gas import acting
    from twintube.fmu import BuildError, build_fmu
    from twintube.fmu.archive import start_values
    from twintube.fmu.assemble import file_name, target_file
    from twintube.fmu.description import model_name
    from twintube.fmu.table import variables

    if test is not None:
        sources = {name: ctx.get_parameter_source(name) for name in ctx.params if name != "test"}
        others = [name for name, source in sources.items() if source is not None and source.name == "COMMANDLINE"]
        if others:
            raise BuildError(f"--test {test}: a test builds nothing, leave out {', '.join(others)}")
        tested(test)
        return
    began = time.monotonic()

    def progress(text: str) -> None:
        typer.echo(f"{time.monotonic() - began:4.0f} s  {text}", err=True)

    if damper is not None and parameters is not None:
        raise BuildError(f"damper = {damper} and --parameters {parameters}: give one of them")
    if platform and kind == "python":
        raise BuildError(f"--platform {platform[0]}: only for the native kind; the Python kind runs on linux64 and win64")
    chosen = in_state(load(parameters or damper or "SA8", as_published=published), oil_level, gas_lost)
    target = target_file(output, file_name(model_name(chosen), fmi))
    if target != output:
        refuse_other(target, same=start_values(target) == {v.name: v.start for v in variables(chosen)})
    built = build_fmu(chosen, target, kind, platform, progress=progress, fmi=fmi)
    typer.echo(
        f"{built}: {printable(chosen.name)}, {printable(chosen.title)}; valid {kind} FMI {fmi}.0 co-simulation FMU, "
        f"{built.stat().st_size // 1024} kB\n"
        f"start values: {in_words(chosen)}; freed gas: {acting(chosen)}"
    )


@app.command(rich_help_panel=MODEL, epilog="Example: twintube ssv SA8 --oil-level 0.6 --gas-lost --output worn.ssv")
def ssv(
    damper: DAMPER,
    oil_level: OIL_LEVEL = None,
    gas_lost: GAS_LOST = None,
    published: AS_PUBLISHED = False,
    version: SSP = 1,
    output: Annotated[Path, typer.Option(metavar="FILE", help="SSV file for the parameters.")] = Path("parameters.ssv"),
) -> None:
    """Write the parameters of a damper for the FMU's importer.

    The file holds System Structure Parameter Values (SSV) of SSP.
    """
    from twintube.dampers import load
    from twintube.fmu.ssv import to_ssv

    chosen = in_state(load(damper, as_published=published), oil_level, gas_lost)
    text = to_ssv(chosen, ssp=version)
    keep_other(output, text.encode())
    write_text(output, text)
    typer.echo(f"{output}: parameters of {printable(chosen.name)}, {printable(chosen.title)}; {in_words(chosen)}")
