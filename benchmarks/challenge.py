"""The diagnosis on datasets of the challenge or the workshop: each is generated, diagnosed and marked.

A run that was broken off goes on.
"""

import json
import math
import tempfile
from concurrent.futures import as_completed
from pathlib import Path
from typing import Any

from benchmarks.challenge_tables import tables
from twintube.diagnosis import diagnose
from twintube.diagnosis.result import as_json
from twintube.errors import UserError
from twintube.files import write_text
from twintube.lab import challenge, workshop
from twintube.lab.challenge.score import score
from twintube.processes import pool
from twintube.provenance import fingerprint

WORKSHOP = "workshop"  # in place of a cause: the generator that knows its seeds' causes alone


def outcome_of(seed: int, cause: str) -> dict[str, Any]:
    """Truth and answer of a seed; an error of the diagnosis is an answer, too."""
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / f"campaign_{seed}"
        truth = workshop.write(seed, data) if cause == WORKSHOP else challenge.write(seed, data, cause)
        try:
            answer = as_json(diagnose(data))
        except UserError as error:
            answer = {"refused": str(error)[:1000]}
        except Exception as error:  # a defect is counted, and the run goes on
            answer = {"failed": f"{type(error).__name__}: {error}"[:1000]}
    return {"seed": seed, "wanted": cause, "truth": truth, "answer": answer}


def kept_outcomes(keep: Path | None, version: str) -> list[dict[str, Any]]:
    """Outcomes of an earlier run of the same sources; what was cut off in the middle of a line is left out."""
    outcomes = []
    if keep is not None and keep.exists():
        for line in keep.read_text(encoding="utf-8").splitlines():
            try:
                entry = json.loads(line)
            except json.JSONDecodeError:
                continue
            if entry.get("version") == version:
                outcomes.append(entry)
    return outcomes


def append(keep: Path | None, entry: dict[str, Any]) -> None:
    """Add a line; where the last line was cut off, a new line is begun."""
    if keep is None:
        return
    keep.parent.mkdir(parents=True, exist_ok=True)
    cut = keep.exists() and keep.stat().st_size > 0 and not keep.read_bytes().endswith(b"\n")
    with keep.open("a", encoding="utf-8") as file:
        file.write(("\n" if cut else "") + json.dumps(entry) + "\n")


def bench_challenge(
    seeds: int,
    keep: Path | None,
    first_seed: int = 0,
    causes: str = "",
    plot: Path | None = None,
    markdown: Path | None = None,
) -> dict[str, Any]:
    """Figures of `score` over `seeds` seeds from `first_seed` on.

    `causes`, names joined by commas, hides each of them under every seed; by default the seed says what is hidden. With
    `workshop` in their place the datasets are those of that generator.
    """
    generator = "twintube.lab.workshop" if causes == WORKSHOP else "twintube.lab.challenge"
    version = "+".join(fingerprint(module) for module in (generator, "twintube.diagnosis"))
    numbers = range(first_seed, first_seed + seeds)
    jobs = [(seed, cause) for seed in numbers for cause in (causes.split(",") if causes else [challenge.cause_of(seed)])]
    done = {(entry["seed"], entry["wanted"]): entry for entry in kept_outcomes(keep, version)}
    missing = [job for job in jobs if job not in done]
    if missing:
        with pool() as workers:
            futures = [workers.submit(outcome_of, *job) for job in missing]
            for number, future in enumerate(as_completed(futures), start=1):
                entry = {"version": version, **future.result()}
                append(keep, entry)
                done[entry["seed"], entry["wanted"]] = entry
                verdict = entry["answer"].get("verdict", "refused" if "refused" in entry["answer"] else "failed")
                print(f"{number}/{len(missing)} seed {entry['seed']}: {entry['truth']['hidden']} -> {verdict}", flush=True)
    outcomes = [done[job] for job in jobs]
    figures: dict[str, Any] = finite(score(outcomes))
    if markdown is not None:
        write_text(markdown, tables(outcomes))
    if plot is not None:
        draw_reliability(figures["reliability"], plot)
    return figures


def finite(figures: Any) -> Any:
    """Figures as floats; those of nothing to count, and limits that are never reached, are left out."""
    if isinstance(figures, dict):
        values = {name: finite(value) for name, value in figures.items()}
        return {name: value for name, value in values.items() if isinstance(value, dict) or math.isfinite(value)}
    return float(figures)


def draw_reliability(table: dict[str, dict[str, float]], path: Path) -> None:
    """The share that was right over the probability that was stated, with the number of answers."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    rows = list(table.values())
    figure, axes = plt.subplots(figsize=(5, 5))
    axes.plot([0, 1], [0, 1], color="0.7", label="calibrated")
    axes.plot([row["mean"] for row in rows], [row["right"] for row in rows], "o-", label="stated")
    for row in rows:
        axes.annotate(f"{row['count']:.0f}", (row["mean"], row["right"]), textcoords="offset points", xytext=(5, -12))
    axes.set(xlabel="largest probability [1]", ylabel="share right [1]", xlim=(0, 1.02), ylim=(-0.02, 1.05))
    axes.legend()
    figure.savefig(path, dpi=150, bbox_inches="tight")
    plt.close(figure)
