"""The damper identified from records, as `twintube identify` does it; kept as a parameter file beside the report."""

from collections.abc import Callable, Sequence
from pathlib import Path

from twintube import dampers
from twintube.arrays import Array
from twintube.dampers import Damper
from twintube.files import write_text
from twintube.identification import Harmonic
from twintube.identification.workflow import PAPER, Budget, identify_damper

HOW = "identified from the virtual rig's records in the paper's four steps and two searches over all parameters together"
# Small swarms for eight dampers in minutes; the walkers make intervals, which a report of curves does not show.
QUICK = Budget(table_6=(32, 60), tables_7_8=(64, 120), together=(24, 100), intervals=(32, 2))


def fit(
    damper: Damper,
    slow: tuple[Array, Array] | None,
    intact: Sequence[Harmonic],
    degraded: Sequence[Harmonic],
    *,
    kept: Path,
    quick: bool,
    progress: Callable[[str, float], None] | None = None,
) -> Damper:
    """The identified damper, or that of the file `kept` where an earlier run left it.

    `slow` is stroke [m] and force [N] of the quasi-static record. A run that was killed goes on where it was.
    """
    if not kept.exists():
        kept.parent.mkdir(parents=True, exist_ok=True)
        journal = kept.with_suffix("")
        journal.mkdir(exist_ok=True)
        budget = QUICK if quick else PAPER
        found = identify_damper(damper, slow, intact, degraded, budget=budget, journal=journal, progress=progress).damper
        write_text(kept, dampers.to_toml(found.with_(oil_level=1.0, gas_preload=1)))
    return dampers.load(kept)


def generations(quick: bool) -> int:
    """How often `progress` is called at most."""
    return (QUICK if quick else PAPER).generations
