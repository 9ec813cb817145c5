"""Truth and answer of each dataset in some folders."""

import json
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from worlds.scoring.answer import Answer, read_answer
from worlds.scoring.truth import Truth, TruthError, read_truths

RUN = "run.json"  # beside diagnosis.json, or in its place: how the diagnosis ended
REFUSABLE = ("sign_flip", "unit_error")  # faults that the reader of datasets may refuse to read: it names them so


@dataclass(frozen=True)
class Pair:
    """A dataset's truth and answer."""

    name: str
    truth: Truth
    answer: Answer


def holding(folders: Iterable[Path]) -> list[Path]:
    """The folders that hold a truth.json: those named, or what is in them."""
    found: list[Path] = []
    for folder in folders:
        if (folder / "truth.json").is_file():
            found.append(folder)
            continue
        inside = sorted(path.parent for path in folder.glob("*/truth.json"))
        if not inside:
            raise TruthError(f"{folder}: no truth.json in it or in its folders")
        found += inside
    return found


def answered(folder: Path, truth: Truth) -> Answer:
    """The answer, or how the run ended that gave none; a refusal of the hidden fault is an answer that names it."""
    answer, path = read_answer(folder), folder / RUN
    if path.is_file():
        run = json.loads(path.read_text(encoding="utf-8"))
        if run["outcome"] != "answered":
            answer = Answer(run["outcome"], seconds=run["seconds"], reason=run["message"])
        elif answer.seconds is None:
            answer = replace(answer, seconds=run["seconds"])
    if answer.verdict == "refused" and truth.wanted <= set(REFUSABLE):
        (name,) = truth.wanted
        return Answer("measurement_fault", truth.wanted, {name: 1.0}, (name,), seconds=answer.seconds)
    return answer


def read_pairs(folders: Iterable[Path], answers: Path | None = None) -> list[Pair]:
    """All pairs: FOLDER/truth.json with FOLDER/answer/diagnosis.json, or with answers/NAME/diagnosis.json.

    A truth.json that is a table of several datasets has their answers in folders of their names there. Raises TruthError.
    """
    pairs = []
    for folder in holding(folders):
        for name, truth in read_truths(folder / "truth.json").items():
            place = folder / "answer" / name if answers is None else answers / (name or folder.resolve().name)
            pairs.append(Pair(name or folder.resolve().name, truth, answered(place, truth)))
    return pairs
