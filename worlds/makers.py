"""Every world by its name: a seed's dataset in FOLDER/dataset and its truth in FOLDER/truth.json."""

import json
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Final

from worlds import challenge
from worlds.bench.files import write_truth
from worlds.identified import identify_first
from worlds.imperfect import World, before_after, tared_cell, unknown_fill, write
from worlds.other_physics import virtual_rig
from worlds.scoring.truth import TruthError, truth_of


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


WORLDS: Final[dict[str, Callable[[int, Path], object]]] = {
    "unknown_fill": partial(made, unknown_fill),
    "tared_cell": partial(made, tared_cell),
    "before_after": partial(made, before_after),
    "before_after_identified": partial(identified, "before_after_identified", before_after),
    "virtual_rig": partial(identified, "virtual_rig", virtual_rig),
    "challenge": challenge.write,
    "workshop": challenge.workshop,
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
