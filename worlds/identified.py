"""A dataset whose damper was identified from its reference records first, as a bench does that has no parameter set."""

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

import tomlkit

from twintube.common.files import write_text
from twintube.dampers import to_toml
from twintube.errors import UserError
from twintube.identification import identify

FILE = "identified.toml"


def identify_first(dataset: Path) -> str:
    """Identify the damper from the records with `reference = true` and name that set in dataset.toml.

    Returns why it could not be identified, else an empty text; dataset.toml then keeps its damper.
    """
    manifest = tomlkit.parse((dataset / "dataset.toml").read_text(encoding="utf-8"))
    with TemporaryDirectory() as name:
        folder = Path(name)
        alone = tomlkit.parse(tomlkit.dumps(manifest))
        alone["record"] = [record for record in manifest["record"] if record.get("reference")]
        for record in alone["record"]:
            shutil.copy(dataset / record["file"], folder)
        write_text(folder / "dataset.toml", tomlkit.dumps(alone))
        try:
            damper = identify(folder).identification.damper
        except UserError as error:
            return str(error)
    write_text(dataset / FILE, to_toml(damper))
    manifest["damper"] = FILE
    write_text(dataset / "dataset.toml", tomlkit.dumps(manifest))
    return ""
