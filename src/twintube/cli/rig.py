"""The command that writes the paper's measurement plan."""

import json
import re
from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import PAPER
from twintube.cli.model import FOR_FMU
from twintube.cli.options import DAMPER, SEED
from twintube.cli.outputs import check_folder, mark_folder, of_options
from twintube.cli.paper import paper
from twintube.common.files import write_text


@paper.command(rich_help_panel=PAPER, epilog="Example: twintube paper rig SA8 --output excitations")
def rig(
    damper: DAMPER,
    output: Annotated[Path, typer.Option(metavar="FOLDER", help="For one CSV per measurement and plan.json.")] = Path("rig"),
    seed: SEED = 1,
    recovery: Annotated[
        bool, typer.Option("--recovery", help="The plan that decides what becomes of gas that cavitation frees.")
    ] = False,
    for_fmu: FOR_FMU = False,
) -> None:
    """Write the excitations of a bench for a damper.

    They are those of the paper's measurement plan (Table 3).
    """
    import numpy as np

    from twintube import dampers
    from twintube.common.bars import Bar
    from twintube.rig.plan import RECOVERY_LEVELS, REST, recovery_plan
    from twintube.vehicle.plan import plan

    chosen = dampers.load(damper)
    check_folder(output, ("plan.json",), of_options())
    mark_folder(output, of_options())
    listed = []
    wanted = recovery_plan(chosen) if recovery else plan(chosen, seed)
    for m in Bar(list(wanted), unit="signal", leave=False):
        name = f"{m.number:02}_{re.sub(r'[^a-z0-9.]+', '_', m.name.lower()).strip('_')}.csv"
        scale, head = (1.0, "time,stroke,velocity") if for_fmu else (1e3, "time [s],stroke [mm],velocity [mm/s]")
        table = np.column_stack([m.signal.time, m.signal.stroke * scale, m.signal.velocity * scale])
        lines = [head] + [f"{t:.9g},{z:.9g},{v:.9g}" for t, z, v in table.tolist()]
        write_text(output / name, "\n".join(lines) + "\n")
        start, end = (float(m.signal.time[m.signal.marks[i]]) for i in (0, -1))
        listed.append({"number": m.number, "name": m.name, "measurement": m.kind, "file": name,
                       "measured_from_s": start, "measured_to_s": end})  # fmt: skip
    about = {"damper": chosen.name, "seed": seed, "rest_before_each_s": REST, "signals": listed}
    about["assumed"] = "block velocities, strokes of the drives (quarter car, road, obstacles), maximum stroke"
    if recovery:
        about["oil_levels_without_preload"] = [*RECOVERY_LEVELS, *chosen.measured_levels]
        about["record_too"] = "temperature of the oil or the outer tube: a minute above v_cav heats the damper"
    write_text(output / "plan.json", json.dumps(about, indent=1) + "\n")
    typer.echo(f"{output}: {len(listed)} signals for {chosen.name}, see plan.json")
