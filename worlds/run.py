"""Datasets made, diagnosed and scored, in folders that a run which was broken off goes on with.

OUTPUT/NAME/dataset       what the diagnosis sees
OUTPUT/NAME/truth.json    what is hidden
OUTPUT/NAME/answer/       what `twintube diagnose` wrote, and run.json: how it ended, written last
OUTPUT/score.json, .md    the figures
"""

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from concurrent.futures import CancelledError, ThreadPoolExecutor, as_completed
from pathlib import Path
from threading import Event
from typing import Any, Final

from twintube.common.bars import Bar
from twintube.common.files import write_text
from twintube.errors import UserError
from twintube.provenance import fingerprint
from worlds.makers import Job
from worlds.scoring import Pair, read_pairs, score, tables
from worlds.scoring.pairs import RUN

PROGRAM = [sys.executable, "-m", "twintube"]
REFUSAL: Final = 2  # exit status of `twintube` where the input cannot be used
LONGEST: Final = 1000  # characters of a message
AFTERWARDS: Final = 1.0  # [s] in which this program notes that it is interrupted, too


class RunError(UserError):
    """A folder that a run cannot go on in."""


def sources() -> str:
    """Fingerprint of all that an answer depends on."""
    return fingerprint("twintube.cli.measured")


def last_line(log: Path) -> str:
    """The last line of a program's output, as an error message is."""
    lines = log.read_text(encoding="utf-8", errors="replace").replace("\r", "\n").splitlines()
    return next((line.strip() for line in reversed(lines) if line.strip()), "")[:LONGEST]


def diagnosed(dataset: Path, answer: Path, timeout: float, stopping: Event) -> dict[str, Any]:
    """Run `twintube diagnose` in a process of its own and tell how it ended.

    Raises CancelledError where an interruption ended it, which reaches both programs of a terminal.
    """
    if answer.exists():  # of a run that was broken off
        shutil.rmtree(answer)
    log = answer.with_name("diagnose.log")
    command = [*PROGRAM, "diagnose", str(dataset), "--output", str(answer)]
    start = time.perf_counter()
    with log.open("wb") as file:  # a pipe would wait for the workers of a program that was ended
        try:
            status = subprocess.run(command, stdout=file, stderr=file, timeout=timeout, check=False).returncode
        except subprocess.TimeoutExpired:
            status = None
    seconds = time.perf_counter() - start
    if status not in (0, REFUSAL, None) and stopping.wait(AFTERWARDS):
        raise CancelledError
    message = "" if status == 0 else last_line(log)
    if status is None:
        outcome, message = "timeout", f"after {timeout:g} s"
    elif status == 0 and (answer / "diagnosis.json").is_file():
        outcome = "answered"
    else:
        outcome = "refused" if status == REFUSAL else "failed"
        message = message or f"exit status {status}"
    return {"outcome": outcome, "message": message, "seconds": round(seconds, 2)}


def work(job: Job, output: Path, timeout: float, version: str, stopping: Event) -> str:
    """Make and diagnose a dataset; returns how it ended."""
    folder = output / job.name
    if not (folder / "truth.json").is_file():
        if folder.exists():  # half made
            shutil.rmtree(folder)
        folder.mkdir(parents=True)
        job.make(folder)
    ended = diagnosed(folder / "dataset", folder / "answer", timeout, stopping)
    write_text(folder / "answer" / RUN, json.dumps({"sources": version, **ended}, indent=1) + "\n")
    return str(ended["outcome"])


def waiting(jobs: Sequence[Job], output: Path, version: str) -> list[Job]:
    """The jobs that have not ended; raises RunError where answers are of another state of the program."""
    left = []
    for job in jobs:
        path = output / job.name / "answer" / RUN
        if not path.is_file():
            left.append(job)
        elif json.loads(path.read_text(encoding="utf-8"))["sources"] != version:
            raise RunError(f"{path}: the answer of another state of the program: run into another folder")
    return left


def run(jobs: Sequence[Job], output: Path, *, workers: int = 1, timeout: float = 600.0) -> list[Pair]:
    """Make and diagnose what has not been, `workers` datasets at a time, and return truths and answers of all.

    A diagnosis that fails, or takes longer than `timeout` [s], is recorded as such. An error of a world ends the run.
    Raises RunError.
    """
    version = sources()
    left = waiting(jobs, output, version)
    counts: dict[str, int] = {}
    stopping = Event()
    with (
        Bar(total=len(jobs), initial=len(jobs) - len(left), unit="dataset") as bar,
        ThreadPoolExecutor(workers) as threads,  # they wait for programs
    ):
        try:
            for future in as_completed([threads.submit(work, job, output, timeout, version, stopping) for job in left]):
                counts[future.result()] = counts.get(future.result(), 0) + 1
                bar.set_postfix(counts)
                bar.update()
        except BaseException:
            stopping.set()
            threads.shutdown(wait=False, cancel_futures=True)
            raise
    return read_pairs(output / job.name for job in jobs)


def write_score(pairs: Sequence[Pair], output: Path) -> str:
    """Write score.json and score.md; returns the tables."""
    scored = score(pairs)
    text = tables(scored)
    write_text(output / "score.json", json.dumps(scored, indent=1) + "\n")
    write_text(output / "score.md", text)
    return text
