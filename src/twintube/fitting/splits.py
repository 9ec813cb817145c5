"""Which velocities a set of records has.

Identification and diagnosis split records by velocity in ways of their own: a search over swarms is too long to be run
twice, so that identification holds out every third velocity; diagnosis predicts every record from those of other velocities.
"""

from collections.abc import Iterable


def distinct(speeds: Iterable[float], factor: float) -> list[float]:
    """Velocities [m/s] in rising order, without those within a `factor` above the last that is kept."""
    kept: list[float] = []
    for v in sorted(speeds):
        if not kept or v > factor * kept[-1]:
            kept.append(v)
    return kept
