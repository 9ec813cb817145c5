"""What the answers of the diagnosis owe to its priors: the scale of the model's own error, and those of strengths.

Each is halved and doubled, on datasets that are always the same.
"""

import json
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib import import_module
from importlib.resources import as_file, files
from pathlib import Path
from shutil import copytree
from typing import Any
from unittest.mock import patch

from benchmarks.folders import folder_of
from twintube.diagnosis import Answer, answer, changes, priors
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.contract import as_json
from twintube.diagnosis.measurement.faults import read
from twintube.diagnosis.mechanisms import Mechanism, Strength
from twintube.diagnosis.numbers import numbers
from twintube.diagnosis.put_right import Measured
from worlds.bench.files import write_truth
from worlds.makers import WORLDS, Job

answering = import_module("twintube.diagnosis.questions")
SEED = 43001  # the first of each world
EACH = {"unknown_fill": 2, "before_after": 2, "challenge": 2, "workshop": 2}
BENCH_LOOKED_AT = ("example", "challenge", "workshop")  # without a reference
ANSWERS = "answers.jsonl"
EVEN = 0.5  # probability of the one and the other


@dataclass(frozen=True)
class Variant:
    """By what the scales of the priors are multiplied."""

    name: str
    law: float = 1.0  # of the model's own error
    strengths: float = 1.0


VARIANTS = (
    Variant("as they are"),
    Variant("D halved", law=0.5),
    Variant("D doubled", law=2.0),
    Variant("strengths halved", strengths=0.5),
    Variant("strengths doubled", strengths=2.0),
)
FEW = VARIANTS[:3]  # where no strength is sought


def scaled(m: Mechanism, by: float) -> Mechanism:
    """A mechanism of which all that is known of its strengths is less or more wide."""
    return replace(m, strengths=tuple(wider(s, by) for s in m.strengths))


def wider(s: Strength, by: float) -> Strength:
    """A strength with another scale; a place has none."""
    return replace(s, scale=by * s.scale)


@contextmanager
def varied(variant: Variant, put_right: Callable[..., Measured]) -> Iterator[None]:
    """The method with other priors; what is put right before does not depend on them."""

    def several(bench: Bench, catalogue: Collection[str] | None = None) -> list[Mechanism]:
        return [scaled(m, variant.strengths) for m in usual(bench, catalogue)]

    usual, law = changes.mechanisms, numbers().law_usual
    with (
        patch.object(changes, "mechanisms", several),
        patch.object(answering, "put_right", put_right),
        priors({"law_usual": variant.law * law}),
    ):
        yield


def example(folder: Path) -> None:
    """The example of the package."""
    with as_file(files("twintube.examples") / "bench_SA8") as stored:
        copytree(stored, folder / "dataset")
    truth = {"kind": "effect", "causes": ["oil_temperature"], "also_fits": [], "effect_over_noise": 2.5}
    write_truth(folder, truth)


def datasets() -> list[Job]:
    """The datasets."""
    several = [(world, SEED + i) for world, n in EACH.items() for i in range(n)]
    return [Job("example", example), *(Job(f"{world}_{seed}", partial(WORLDS[world], seed)) for world, seed in several)]


def bench_priors(keep: Path | None = None) -> dict[str, Any]:
    """Verdicts and probabilities under each of VARIANTS."""
    with folder_of(keep) as folder:
        rows = answered(folder)
    return summary(rows)


def answered(folder: Path) -> list[dict[str, Any]]:
    """An answer of each dataset under each variant; those in `folder` are not sought again."""
    path = folder / ANSWERS
    folder.mkdir(parents=True, exist_ok=True)
    rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.is_file() else []
    known = {(row["dataset"], row["variant"]) for row in rows}
    for job in datasets():
        own = folder / job.name
        if not (own / "truth.json").is_file():
            own.mkdir(exist_ok=True)
            job.make(own)
        truth = {"truth": json.loads((own / "truth.json").read_text(encoding="utf-8"))["causes"]}
        dataset, turned = read(own / "dataset")
        once = cache(lambda given=dataset, sign=turned: answering.put_right(given, sign, answering.silent))
        for variant in FEW if job.name.startswith("unknown_fill") else VARIANTS:
            if (job.name, variant.name) in known:
                continue
            measured = once() if job.name.startswith(BENCH_LOOKED_AT) else None
            with varied(variant, lambda *_, m=measured: m):
                found = answer(dataset, None, turned)
            rows.append({"dataset": job.name, "variant": variant.name} | truth | told(found))
            with path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(rows[-1]) + "\n")
    return rows


def told(found: Answer) -> dict[str, Any]:
    """What is compared of an answer."""
    whole = as_json(found)
    keys = ("verdict", "unexplained", "state", "credible_set", "probabilities", "hypotheses", "causes", "always", "seconds")
    return {key: whole[key] for key in keys if key in whole}


def best(row: dict[str, Any]) -> str:
    """What is likeliest; of a state the preload."""
    if "probabilities" in row:
        return str(max(row["probabilities"], key=lambda name: float(row["probabilities"][name])))
    return "gas lost" if row["state"][-1]["gas_lost"] > EVEN else "gas there"


def moved(row: dict[str, Any], usual: dict[str, Any]) -> dict[str, float]:
    """How far an answer lies from that with the priors as they are."""
    out = {
        "verdict_differs": float(row["verdict"] != usual["verdict"]),
        "likeliest_differs": float(best(row) != best(usual)),
    }
    if "probabilities" in row:
        p, q = row["probabilities"], usual["probabilities"]
        return out | {"largest_move": max(abs(p.get(name, 0.0) - q.get(name, 0.0)) for name in {*p, *q})}
    a, b = (x["state"][-1] for x in (row, usual))
    ends = [abs(x - y) for x, y in zip(a["oil_level"]["interval"], b["oil_level"]["interval"], strict=True)]
    return out | {"largest_move": abs(a["gas_lost"] - b["gas_lost"]), "interval_moves": max(ends)}


def summary(rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """By dataset and variant how far the answer moves, and by variant how many verdicts differ."""
    usual = {row["dataset"]: row for row in rows if row["variant"] == VARIANTS[0].name}
    each = {f"{r['dataset']}, {r['variant']}": moved(r, usual[r["dataset"]]) for r in rows if r is not usual[r["dataset"]]}
    counts = {}
    for variant in VARIANTS[1:]:
        own = [x for name, x in each.items() if name.endswith(variant.name)]
        counts[variant.name] = {
            "datasets": float(len(own)),
            "verdict_differs": sum(x["verdict_differs"] for x in own),
            "likeliest_differs": sum(x["likeliest_differs"] for x in own),
            "largest_move": max((x["largest_move"] for x in own), default=0.0),
        }
    return {"by_dataset": each, "by_variant": counts}
