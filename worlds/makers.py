"""Every world by its name: a seed's dataset in FOLDER/dataset and its truth in FOLDER/truth.json."""

import json
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final

from worlds import challenge, workshop
from worlds.bench.files import told, write_truth
from worlds.blind_trials import trials
from worlds.identified import identify_first
from worlds.imperfect import World, before_after, tared_cell, unknown_fill, write
from worlds.other_physics import virtual_rig
from worlds.scoring.truth import TruthError, truth_of

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
    make: Callable[[Path], object]


def made(make_world: Callable[[int], World], seed: int, folder: Path) -> None:
    """A damper that differs from its parameter set."""
    write(make_world(seed), folder)


def identified(world: str, make_world: Callable[[int], World], seed: int, folder: Path) -> None:
    """Before and after, where the damper was identified from its reference records first."""
    making = folder / "making"
    write(make_world(seed), making)
    failure = identify_first(making / "dataset")
    truth = json.loads((making / "truth.json").read_text(encoding="utf-8"))
    (making / "dataset").rename(folder / "dataset")
    shutil.rmtree(making)
    write_truth(folder, truth | {"world": world, "not_identified": failure})


def of_trials(kind: str, seed: int, strength: float | None, folder: Path) -> None:
    """A blind trial of a kind."""
    trial = trials.trial(kind, seed, strength=strength)
    trials.write(trial, folder / "dataset")
    causes = kind.split("+")
    of = "none" if kind == "none" else "fault" if set(causes) <= set(trials.FAULTS) else "effect"
    more = {"parameters": trial.truth, "strength": trial.strength}
    write_truth(
        folder, told("blind_trials", seed, trial.damper, causes, kind="outside" if kind in trials.OUTSIDE else of, more=more)
    )


def blind_trials(seed: int, folder: Path) -> None:
    """Every kind in turn."""
    block, place = divmod(seed, len(TRIALS))
    of_trials(TRIALS[place], FIRST_TRIAL + block, None, folder)


WORLDS: Final[dict[str, Callable[[int, Path], object]]] = {
    "unknown_fill": partial(made, unknown_fill),
    "tared_cell": partial(made, tared_cell),
    "before_after": partial(made, before_after),
    "before_after_identified": partial(identified, "before_after_identified", before_after),
    "virtual_rig": partial(identified, "virtual_rig", virtual_rig),
    "challenge": challenge.write,
    "workshop": workshop.write,
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
    for name, truth in table.items():
        if not (collection / name / "dataset.toml").is_file():
            raise TruthError(f"{path}: {name}: no dataset of that name beside it")
        truth_of(truth, f"{path}: {name}")
        found.append(Job(name, partial(copied, collection / name, truth)))
    return found
