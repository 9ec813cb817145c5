"""The example dataset of the package: seven records of SA8 on a simulated bench, in which one effect is hidden.

    python -m worlds.example FOLDER

writes it again. The bench is that of `blind_trials`, sampled so that the files are small.
"""

import math
import sys
from dataclasses import replace
from pathlib import Path
from zlib import crc32

import numpy as np
import tomlkit
from scipy.io import savemat

from twintube.common.files import replacing, write_text
from twintube.dampers import load
from twintube.rig.signals import AMPLITUDE
from worlds.blind_trials.hidden import secret
from worlds.blind_trials.trials import WARM, Trial, TrialRecord, measured, plans, take

NAME = "bench_SA8"
DAMPER, KIND, SEED = "SA8", "oil_temperature", 5
RATES = {0.131: 100.0, 0.524: 200.0, 0.786: 250.0}  # [Hz] by the blocks' velocity [m/s]
LOWEST = 0.5  # [1] of the oil: the states that the example has
THINNED = {0.0: 5, 0.131: 2}  # by the velocity [m/s], 0 is quasi-static: one of so many samples is stored
NOISE = 0.02  # of the largest force of each record
TITLE = "Example: damper SA8 on a simulated bench"


def example() -> Trial:
    """The records and their hidden effect; the numbers are reproducible."""
    damper = load(DAMPER, as_published=True)
    hidden, strength = secret(KIND, SEED, damper.parameters, 1.0)
    rng = np.random.default_rng([SEED, crc32(KIND.encode())])
    planned = [plan for plan in plans(damper, tuple(RATES)) if plan.level > LOWEST]
    channels = []
    for plan in planned:
        samples = RATES.get(plan.velocity, 1.0) * 2 * math.pi * AMPLITUDE / max(plan.velocity, 1e-3)
        channels.append(
            take(plan, damper, hidden, start=WARM + rng.uniform(-0.5, 0.5), samples=samples, jitter=0.0, rng=rng)
        )
    forces = [float(np.abs(t.force).max()) for t in channels]
    degraded = max(f for f, t in zip(forces, channels, strict=True) if not t.plan.preload)
    records = [
        measured(t, hidden, (0.0, max(forces), degraded), noise=NOISE * f, speed=False, phase=0.0, rng=rng)
        for f, t in zip(forces, channels, strict=True)
    ]
    stored = [thinned(record, plan.velocity) for record, plan in zip(records, planned, strict=True)]
    return Trial(KIND, SEED, strength, hidden.truth, DAMPER, stored)


def thinned(record: TrialRecord, velocity: float) -> TrialRecord:
    """The samples of a record that the example keeps: about 90 to 110 per oscillation."""
    every = THINNED.get(velocity, 1)
    return replace(record, time=record.time[::every], stroke=record.stroke[::every], force=record.force[::every])


def write(folder: Path) -> None:
    """Write the dataset: time in whole milliseconds, stroke to 0.01 mm, force to 1 N.

    MATLAB files of version 5 are small and are read without an extra of the package.
    """
    trial = example()
    document = tomlkit.document()
    document["title"] = TITLE
    document["damper"] = trial.damper
    columns = tomlkit.inline_table()
    columns.update({"time [ms]": "time", "stroke [mm]": "stroke", "force [N]": "force"})
    document["columns"] = columns
    tables = tomlkit.aot()
    folder.mkdir(parents=True, exist_ok=True)
    for record in trial.records:
        table = tomlkit.table()
        file = Path(record.file).with_suffix(".mat").name
        table["file"] = file
        for name in ("measurement", "oil_level", "gas_preload", "start_temperature_degC"):
            table[name] = getattr(record, name)
        tables.append(table)
        values = {
            "time": np.round(record.time * 1e3).astype(np.int32),
            "stroke": np.round(record.stroke * 1e3, 2).astype(np.float32),
            "force": np.round(record.force).astype(np.int16),
        }
        with replacing(folder / file) as temporary:
            savemat(temporary, values, do_compression=True)
    document["record"] = tables
    write_text(folder / "dataset.toml", tomlkit.dumps(document))


if __name__ == "__main__":
    write(Path(sys.argv[1]))
