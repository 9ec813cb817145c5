"""The paper's statements about results, C1 to C17, evaluated with its published parameters.

`evaluate` returns one `Claim` per statement. A claim that was used to calibrate the dead lengths names the dampers
concerned. A claim that an assumed value or the code alone decides, or that nobody measured, says so (`Claim.kind`). Only the
others are evidence.
"""

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor

from twintube.claims import fast, intact, levels, slow, small, table3_drives, variants
from twintube.claims.claim import BENCH, Bench, Claim, Dampers, fluid_works, works
from twintube.dampers import load, names
from twintube.dampers.variants import rear_curve
from twintube.rig.plan import oil_levels, velocities

EVALUATORS: tuple[Callable[[Dampers, Bench], Claim], ...] = (
    slow.c1,
    slow.c2,
    fast.c3,
    fast.c4,
    variants.c5,
    variants.c6,
    levels.c7,
    levels.c8,
    levels.c9,
    fast.c10,
    intact.c11,
    intact.c12,
    table3_drives.c13,
    variants.c14,
    slow.c15,
    levels.c16,
    small.c17,
)


def evaluate(readings: Mapping[str, float] | None = None, bench: Bench = BENCH, *, rear: bool = False) -> Iterator[Claim]:
    """All claims in order; `readings` sets parameters of the group `reading` for every damper.

    With `rear` the rear dampers take the rear curve of the source of the F-v curves (`dampers.variants.rear_curve`).
    """
    dampers = {name: load(name).with_(**(readings or {})) for name in names()}
    if rear:
        dampers = {name: damper.with_(**rear_curve(damper)) for name, damper in dampers.items()}
    warm(dampers, bench)
    for evaluator in EVALUATORS:
        yield evaluator(dampers, bench)


def warm(dampers: Dampers, bench: Bench) -> None:
    """Simulate the runs that several claims share, on all cores: the compiled kernel releases Python's lock."""
    with ThreadPoolExecutor() as pool:
        for damper in dampers.values():
            for level in oil_levels(damper):
                for velocity in velocities(damper):
                    pool.submit(works, damper, level, velocity, bench)
                    pool.submit(fluid_works, damper, level, velocity, bench)


__all__ = ["BENCH", "EVALUATORS", "Bench", "Claim", "evaluate"]
