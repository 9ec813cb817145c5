"""Small strokes, which the paper expects to matter more and did not measure: fluid work over intact by amplitude."""

from twintube.claims.small import SMALL, by_amplitude
from twintube.dampers import load, names
from twintube.rig.plan import amplitude

LEVELS = (0.9, 0.5)  # beside the two that the paper measured of each damper


def bench_small_strokes() -> dict[str, dict[str, dict[str, float]]]:
    """Mean of 19 oscillations about the middle at 0.131 m/s, by damper, oil level and amplitude."""
    found = {}
    for name in names():
        damper = load(name)
        heads = [f"{1e3 * a:g} mm" for a in (amplitude(damper), *SMALL)]
        levels = sorted({*LEVELS, *damper.measured_levels}, reverse=True)
        found[name] = {f"{level:.0%} oil": dict(zip(heads, by_amplitude(damper, level), strict=True)) for level in levels}
    return found
