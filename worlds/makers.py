"""Every world by its name: a seed's dataset in FOLDER/dataset and its truth in FOLDER/truth.json."""

import json
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final

from twintube.files import write_text
from twintube.lab import challenge, workshop
from twintube.lab.blind_trials import trials
from worlds.adapters import of_collection, of_generator, of_trial
from worlds.identified import identify_first
from worlds.imperfect import World, before_after, make, write
from worlds.other_physics import virtual_rig
from worlds.scoring.truth import TruthError

PAIRS: Final = (
    "valve_wear+gas_spring",
    "oil_temperature+end_stop",
    "oil_level_error+valve_wear",
    "side_load_friction+fluid_lag",
)
TRIALS: Final = (*trials.EFFECTS, *trials.FAULTS, "recalibrate", "none", *PAIRS, *trials.OUTSIDE)
FIRST_TRIAL: Final = 100  # seed of the first of each kind: fewer were for development


@dataclass(frozen=True)
class Job:
    """A dataset to be made: its name, and what makes it in a folder."""

    name: str
    make: Callable[[Path], None]


def write_truth(folder: Path, truth: dict[str, Any]) -> None:
    """Write truth.json, the last file of a dataset that is being made."""
    write_text(folder / "truth.json", json.dumps(truth, indent=1) + "\n")


def imperfect(world: str, seed: int, folder: Path) -> None:
    """A damper that differs from its parameter set."""
    write(make(seed, world), folder)


def identified(world: str, make_world: Callable[[int], World], seed: int, folder: Path) -> None:
    """Before and after, where the damper was identified from its reference records first."""
    making = folder / "making"
    write(make_world(seed), making)
    failure = identify_first(making / "dataset")
    truth = json.loads((making / "truth.json").read_text(encoding="utf-8"))
    (making / "dataset").rename(folder / "dataset")
    shutil.rmtree(making)
    write_truth(folder, truth | {"world": world, "not_identified": failure})


def of_challenge(seed: int, folder: Path, cause: str | None = None) -> None:
    """A seed of the challenge, with a cause of its own or a chosen one."""
    truth = challenge.write(seed, folder / "dataset", cause)
    (folder / "dataset.truth.json").unlink()
    write_truth(folder, of_generator("challenge", truth))


def of_workshop(seed: int, folder: Path) -> None:
    """A seed of the workshop, from 1 on."""
    write_truth(folder, of_generator("workshop", workshop.write(seed, folder / "dataset")))


def of_trials(kind: str, seed: int, strength: float | None, folder: Path) -> None:
    """A blind trial of a kind."""
    trial = trials.trial(kind, seed, strength=strength)
    trials.write(trial, folder / "dataset")
    write_truth(folder, of_trial(trial))


def blind_trials(seed: int, folder: Path) -> None:
    """Every kind in turn."""
    block, place = divmod(seed, len(TRIALS))
    of_trials(TRIALS[place], FIRST_TRIAL + block, None, folder)


WORLDS: Final[dict[str, Callable[[int, Path], None]]] = {
    "unknown_fill": partial(imperfect, "unknown_fill"),
    "before_after": partial(imperfect, "before_after"),
    "before_after_identified": partial(identified, "before_after_identified", before_after),
    "virtual_rig": partial(identified, "virtual_rig", virtual_rig),
    "challenge": of_challenge,
    "workshop": of_workshop,
    "blind_trials": blind_trials,
}
FIRST_SEED: Final = {"workshop": 1}  # of the others 0


def jobs(world: str, first: int, last: int) -> list[Job]:
    """The datasets of seeds `first` to `last`."""
    return [Job(f"{world}_{seed}", partial(WORLDS[world], seed)) for seed in range(first, last + 1)]


def copied(source: Path, truth: dict[str, Any], folder: Path) -> None:
    """A dataset of a collection."""
    shutil.copytree(source, folder / "dataset")
    write_truth(folder, truth)


def collected(collection: Path) -> list[Job]:
    """The datasets of a folder with a truth.json that is a table by their names; raises TruthError."""
    path = collection / "truth.json"
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise TruthError(f"{path}: {error}") from error
    found = []
    for name, told in table.items():
        if not (collection / name / "dataset.toml").is_file():
            raise TruthError(f"{path}: {name}: no dataset of that name beside it")
        truth = told if "kind" in told else of_collection(collection.resolve().name, told)
        found.append(Job(name, partial(copied, collection / name, truth)))
    return found
