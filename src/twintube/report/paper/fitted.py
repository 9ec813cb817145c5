"""The damper identified from records as by `twintube identify`, stored as a parameter file in the report's folder."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from twintube import dampers
from twintube.common.files import write_text
from twintube.dampers import Damper
from twintube.identification import Harmonic
from twintube.identification.optimise import DEFAULT
from twintube.identification.workflow import PAPER, identify_damper

HOW = "identified from the virtual rig's records as by twintube identify"
# The walkers compute intervals, which this report does not show.
BUDGET = replace(PAPER, intervals=(32, 2))
METHODS = {True: DEFAULT, False: "pso"}  # by whether it is to be quick; else the paper's swarms


def fit(
    damper: Damper,
    slow: Harmonic,
    records: Sequence[Harmonic],
    *,
    file: Path,
    quick: bool,
    progress: Callable[[str, float], None],
) -> Damper:
    """The identified damper, read from `file` if an earlier run wrote it.

    `slow` is the quasi-static record. An interrupted run continues from its journal.
    """
    if not file.exists():
        journal = file.with_suffix("")
        journal.mkdir(parents=True, exist_ok=True)
        ramps = slow.stroke, slow.force
        intact, degraded = ([r for r in records if bool(r.gas_preload) is there] for there in (True, False))
        result = identify_damper(
            damper, ramps, intact, degraded, method=METHODS[quick], budget=BUDGET, journal=journal, progress=progress
        )
        write_text(file, dampers.to_toml(result.damper.with_(oil_level=1.0, gas_preload=1)))
    return dampers.load(file, as_published=True)


def generations(quick: bool) -> int:
    """Largest number of calls of `progress`."""
    return BUDGET.generations(METHODS[quick])
