"""A world on disk: `dataset/` as a bench leaves it, and `truth.json` beside it."""

import json
from pathlib import Path
from typing import Final

from worlds.imperfect.world import Recording, World

# Delimiter, decimal sign, names of time, stroke, force and temperature, and lines of the recorder above them.
STYLES: Final = (
    (",", ".", ("time [s]", "stroke [mm]", "force [N]", "temperature [degC]"), 0),
    (";", ",", ("time [s]", "stroke [mm]", "force [N]", "temperature [degC]"), 0),
    ("\t", ".", ("Time (s)", "Displacement (mm)", "Load (N)", "Temp (degC)"), 4),
)
QUANTITIES: Final = ("time [s]", "stroke [mm]", "force [N]", "temperature [degC]")


def table(record: Recording, style: int) -> str:
    """One record as text."""
    delimiter, decimal, names, lines = STYLES[style]
    columns = [record.time, 1e3 * record.stroke, record.force]
    formats = ["%.4f", "%.3f", "%.2f"]
    if record.temperature is not None:
        columns, formats = [*columns, record.temperature], [*formats, "%.1f"]
    head = [f"Damper test bench\t{record.name}", "Test type\tcyclic", f"Samples\t{len(record.time)}", ""][:lines]
    rows = [delimiter.join(formats) % row for row in zip(*columns, strict=True)]
    text = "\n".join([*head, delimiter.join(names[: len(columns)]), *(row.replace(".", decimal) for row in rows)])
    return text + "\n"


def manifest(world: World) -> str:
    """The text of dataset.toml."""
    delimiter, decimal, names, lines = STYLES[world.bench.style]
    with_temperature = world.bench.temperature == "column"
    text = ['title = "Damper bench"', f'damper = "{world.damper}"']
    if delimiter != ",":
        text.append(f'delimiter = "{delimiter}"'.replace("\t", "\\t"))
    if decimal != ".":
        text.append(f'decimal = "{decimal}"')
    if lines:
        pairs = list(zip(QUANTITIES, names, strict=True))[: 4 if with_temperature else 3]
        text += [f"skip_rows = {lines}", "columns = {" + ", ".join(f'"{key}" = "{name}"' for key, name in pairs) + "}"]
    for record in world.recordings:
        full = world.stated[0 if record.reference else 1]
        text += ["", "[[record]]", f'file = "{record.name}.csv"', f'measurement = "{record.measurement}"']
        text += ["oil_level = 1.0", "gas_preload = true"] if full else ['oil_level = "unknown"', 'gas_preload = "unknown"']
        text += ["reference = true"] * record.reference
        text += [f"start_temperature_degC = {record.start_temperature}"] * (world.bench.temperature == "start")
    return "\n".join(text) + "\n"


def write(world: World, output: Path) -> None:
    """Write a world into the folder; raises FileExistsError where that holds a dataset."""
    dataset = output / "dataset"
    dataset.mkdir(parents=True)
    for record in world.recordings:
        (dataset / f"{record.name}.csv").write_text(table(record, world.bench.style), encoding="utf-8")
    (dataset / "dataset.toml").write_text(manifest(world), encoding="utf-8")
    rounded = json.loads(json.dumps(world.truth), parse_float=lambda text: float(f"{float(text):.6g}"))
    (output / "truth.json").write_text(json.dumps(rounded, indent=1) + "\n", encoding="utf-8")
