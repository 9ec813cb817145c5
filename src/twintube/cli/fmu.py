"""The command about the FMU: build it, test it, write its parameters."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from twintube.cli.base import MODEL, app
from twintube.cli.options import AS_PUBLISHED, DAMPER_ARGUMENT, PLATFORM
from twintube.cli.outputs import keep_other, named, refuse_other, typed
from twintube.cli.states import GAS_LOST, GAS_SHARE, OIL_LEVEL, in_state
from twintube.common.files import write_text
from twintube.common.words import printable

if TYPE_CHECKING:
    from twintube.dampers import Damper

SSV = Path("parameters.ssv")
FORMER = {"--parameters": ""}


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


def absent(damper: "Damper", fmi: Literal[2, 3]) -> None:
    """Say which platforms the FMU has no library for, as the package has none."""
    from twintube.fmu.binaries import complete
    from twintube.fmu.description import damper_model
    from twintube.fmu.sources import unit_of
    from twintube.fmu.standards import STANDARDS

    standard = STANDARDS[fmi]
    there = complete(unit_of(damper_model(damper), standard), standard)
    lacking = ", ".join(name for name in standard.platforms if name not in there)
    if lacking:
        typer.echo(f"no library for {lacking}: `pip install ziglang`, then `python -m twintube.native --all`")


@app.command(
    rich_help_panel=MODEL,
    epilog="Example: twintube fmu SA8 --oil-level 0.6 --gas-lost --output rear_60.fmu",
    former=FORMER,
)
def fmu(
    ctx: typer.Context,
    damper: Annotated[str | None, DAMPER_ARGUMENT] = None,
    oil_level: OIL_LEVEL = None,
    gas_lost: GAS_LOST = None,
    gas: GAS_SHARE = None,
    kind: Annotated[
        Literal["native", "python"],
        typer.Option(metavar="native|python", help="Compiled, or Python source that the host's Python runs."),
    ] = "native",
    fmi: Annotated[Literal[2, 3], typer.Option(metavar="2|3", help="Version of FMI, 2.0 or 3.0.")] = 2,
    platform: PLATFORM = None,
    published: AS_PUBLISHED = False,
    ssv: Annotated[
        bool,
        typer.Option("--ssv", help="Build nothing: write the parameters as SSV, of SSP 1.0 or with --fmi 3 of 2.0."),
    ] = False,
    output: Annotated[
        Path, typer.Option(metavar="FILE|FOLDER", help="An .fmu file, or a folder for it; with --ssv an .ssv file.")
    ] = Path(),
    test: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Build nothing: run this FMU against its own reference run.")
    ] = None,
) -> None:
    """Build the FMU of a damper, test one, or write parameters.

    Without a damper it is that of SA8. Gas that cavitation frees dissolves again, unless --as-published asks for the paper's
    equations alone or the parameter set says what freed gas does.
    """
    from twintube.dampers import load
    from twintube.dampers.freed_gas import acting
    from twintube.fmu import BuildError, build_fmu
    from twintube.fmu.archive import start_values
    from twintube.fmu.assemble import file_name, target_file
    from twintube.fmu.description import model_name
    from twintube.fmu.table import variables

    if test is not None:
        if others := [name for name in typed(ctx) if name != "test"]:
            raise BuildError(f"--test {test}: a test builds nothing, leave out {', '.join(others)}")
        tested(test)
        return
    if platform and kind == "python":
        raise BuildError(f"--platform {platform[0]}: only for the native kind; the Python kind runs on linux64 and win64")
    chosen = in_state(load(damper or "SA8", as_published=published), oil_level, gas_lost, gas)
    if ssv:
        if others := [name for name in typed(ctx) if name in ("kind", "platform")]:
            raise BuildError(f"--ssv: holds parameters for every library, leave out {', '.join(others)}")
        write_ssv(chosen, output if named() else SSV, 1 if fmi == 2 else 2)
        return
    target = target_file(output, file_name(model_name(chosen), fmi))
    if target != output:
        refuse_other(target, same=start_values(target) == {v.name: v.start for v in variables(chosen)})
    built = build_fmu(chosen, target, kind, platform, fmi=fmi)
    typer.echo(
        f"{built}: {printable(chosen.name)}, {printable(chosen.title)}; valid {kind} FMI {fmi}.0 co-simulation FMU, "
        f"{built.stat().st_size // 1024} kB\n"
        f"start values: {chosen.state}; freed gas: {acting(chosen)}"
    )
    if kind == "native" and platform is None:
        absent(chosen, fmi)


def write_ssv(damper: "Damper", output: Path, version: Literal[1, 2]) -> None:
    """Write the parameters of a damper as System Structure Parameter Values of a version of SSP."""
    from twintube.fmu.ssv import to_ssv

    text = to_ssv(damper, ssp=version)
    keep_other(output, text.encode())
    write_text(output, text)
    typer.echo(f"{output}: parameters of {printable(damper.name)}, {printable(damper.title)}; {damper.state}")
