"""The claims are computed, complete and honest about what they rest on."""

import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

import pytest

from twintube.claims import EVALUATORS, Claim, evaluate
from twintube.claims.claim import ASSUMPTION, CONSTRUCTION, EXPECTATION, FRONT, PAPER, READING, STAND_IN, works
from twintube.claims.fast import SIGNIFICANTLY_LOWER
from twintube.dampers import load
from twintube.rig.signals import BLOCKS

ROOT = Path(__file__).parents[2]
WORDS = ("none one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen "
         "seventeen").split()  # fmt: skip
IDS = [f"C{i}" for i in range(1, 18)]


@pytest.fixture(scope="module")
def claims() -> dict[str, Claim]:
    return {c.id: c for c in evaluate()}


def test_all_seventeen_are_there(claims: dict[str, Claim]) -> None:
    assert list(claims) == IDS
    assert [e.__name__ for e in EVALUATORS] == [i.lower() for i in IDS]
    for claim in claims.values():
        assert claim.figures and claim.needs and claim.statement and claim.source
        assert len(claim.quote) > 40 and len(claim.tested) > 40
        assert {"id", "holds", "figures", "needs"} <= set(json.loads(json.dumps(asdict(claim))))


def test_one_that_does_not_hold_says_why(claims: dict[str, Claim]) -> None:
    for claim in claims.values():
        assert bool(claim.reason) != claim.holds, claim.id
        assert claim.because in (("",) if claim.holds else (PAPER, READING, STAND_IN)), claim.id
        assert claim.holds or any(c.isdigit() for c in claim.reason), f"{claim.id}: an experiment has a figure"


def test_calibrated_claims_are_no_evidence(claims: dict[str, Claim]) -> None:
    assert [c.id for c in claims.values() if c.calibrated] == ["C1", "C2", "C3", "C4", "C5", "C7", "C9", "C15", "C16"]
    assert claims["C4"].calibrated == FRONT and claims["C15"].calibrated == ("SA1", "SA7")
    assert claims["C5"].calibrated == claims["C7"].calibrated == claims["C9"].calibrated == ("SA8",)
    others = {kind: [c.id for c in claims.values() if c.kind == kind] for kind in (ASSUMPTION, CONSTRUCTION, EXPECTATION)}
    assert others == {ASSUMPTION: ["C11", "C12"], CONSTRUCTION: ["C10"], EXPECTATION: ["C17"]}
    assert [c.id for c in claims.values() if c.evidence] == ["C6", "C8", "C13", "C14"]


def test_docs_agree(claims: dict[str, Claim]) -> None:
    """The page names the verdict of every claim."""
    page = (ROOT / "docs" / "claims.md").read_text(encoding="utf-8")
    for claim in claims.values():
        row = next(line for line in page.splitlines() if line.startswith(f"| {claim.id} |"))
        verdict = "yes" if claim.holds else f"**no**, {claim.because}"
        assert [cell.strip() for cell in row.split("|")[2:4]] == [verdict, claim.kind], claim.id


def by_kind(claims: list[Claim], held: bool) -> Iterator[tuple[str, list[Claim]]]:
    """The claims of each kind and `all` of them, with `held` only those that hold."""
    for kind in ("all", "evidence", "calibrated", ASSUMPTION):
        yield kind, [c for c in claims if kind in ("all", c.kind) and (c.holds or not held)]


def test_the_pages_count_the_evidence(claims: dict[str, Claim]) -> None:
    """Counts in README and on the page are those of the claims themselves."""
    count, holding = (
        {kind: WORDS[len(some)] for kind, some in by_kind(list(claims.values()), held)} for held in (False, True)
    )
    readme, page = ((ROOT / name).read_text(encoding="utf-8").replace("\n", " ") for name in ("README.md", "docs/claims.md"))
    assert f"paper's {count['all']} statements**, as written: {holding['all']} hold." in readme
    assert f"Only {count['evidence']} of them are evidence about the model; {holding['evidence']} of these hold" in readme
    assert f"Of {count['evidence']} claims that are evidence {holding['evidence']} hold, of {count['calibrated']} " in page
    assert f"calibrated ones {holding['calibrated']}, of {count[ASSUMPTION]} by assumption" in page


def test_figures_of_c4_are_those_of_the_works(claims: dict[str, Claim]) -> None:
    ratio = claims["C4"].figures["work_at_1.572_over_largest_up_to_0.786"]
    assert isinstance(ratio, dict)
    for name in FRONT:
        damper = load(name)
        last = {v: works(damper, damper.measured_levels[-1], v)[-1] for v in BLOCKS}
        lower = max(w for v, w in last.items() if v <= SIGNIFICANTLY_LOWER)
        assert ratio[name] == pytest.approx(last[BLOCKS[-1]] / lower, abs=1e-3)


def test_drives_cover_table_3(claims: dict[str, Claim]) -> None:
    table = claims["C13"].figures["fluid_work_relative_to_intact_at_60_40"]
    assert isinstance(table, dict)
    assert {name: len(rows) for name, rows in table.items()} == {"SA7": 10, "SA8": 10}
