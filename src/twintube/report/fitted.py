"""The damper identified from records as by `twintube identify`, stored as a parameter file in the report's folder."""

from collections.abc import Callable, Sequence
from pathlib import Path

from twintube import dampers
from twintube.arrays import Array
from twintube.dampers import Damper
from twintube.files import write_text
from twintube.identification import Harmonic
from twintube.identification.workflow import PAPER, Budget, identify_damper

HOW = "identified from the virtual rig's records in the paper's four steps and two searches over all parameters together"
# Small swarms: eight dampers in minutes. The walkers compute intervals, which this report does not show.
QUICK = Budget(table_6=(32, 60), tables_7_8=(64, 120), together=(24, 100), intervals=(32, 2))


def fit(
    damper: Damper,
    slow: tuple[Array, Array] | None,
    intact: Sequence[Harmonic],
    degraded: Sequence[Harmonic],
    *,
    file: Path,
    quick: bool,
    progress: Callable[[str, float], None] | None = None,
) -> Damper:
    """The identified damper, read from `file` if an earlier run wrote it.

    `slow` is stroke [m] and force [N] of the quasi-static record. An interrupted run continues from its journal.
    """
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        journal = file.with_suffix("")
        journal.mkdir(exist_ok=True)
        budget = QUICK if quick else PAPER
        result = identify_damper(damper, slow, intact, degraded, budget=budget, journal=journal, progress=progress)
        write_text(file, dampers.to_toml(result.damper.with_(oil_level=1.0, gas_preload=1)))
    return dampers.load(file, as_published=True)


def generations(quick: bool) -> int:
    """Largest number of calls of `progress`."""
    return (QUICK if quick else PAPER).generations
