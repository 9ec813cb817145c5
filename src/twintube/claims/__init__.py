"""The paper's statements about results, C1 to C14, evaluated with its published parameters.

`evaluate` returns one `Claim` per statement. A claim that took part in the calibration of the dead lengths is marked
`calibrated`, one that follows from an assumed value alone `assumed`; only the others are evidence.
"""

from collections.abc import Callable, Iterator

from twintube.claims import drives, harmonic, intact
from twintube.claims.claim import Claim
from twintube.parameters import load, names

EVALUATORS: tuple[Callable[..., Claim], ...] = (
    harmonic.c1,
    harmonic.c2,
    harmonic.c3,
    harmonic.c4,
    harmonic.c5,
    harmonic.c6,
    harmonic.c7,
    harmonic.c8,
    harmonic.c9,
    harmonic.c10,
    intact.c11,
    intact.c12,
    drives.c13,
    harmonic.c14,
)


def evaluate(readings: dict[str, int] | None = None) -> Iterator[Claim]:
    """All claims in order; `readings` sets parameters of the group `reading` for every damper."""
    dampers = {name: load(name).with_(**(readings or {})) for name in names()}
    for evaluator in EVALUATORS:
        yield evaluator(dampers)


__all__ = ["EVALUATORS", "Claim", "evaluate"]
