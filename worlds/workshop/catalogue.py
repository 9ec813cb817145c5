"""The sixty cases, and which seed has which of them."""

from dataclasses import dataclass, field

import numpy as np

from worlds.workshop.plan import STYLES, Wish
from worlds.workshop.sizes import SIZES


@dataclass(frozen=True)
class Case:
    """What is hidden: keys of SIZES, none or two at once."""

    kind: str
    keys: tuple[str, ...] = ()
    wish: Wish = field(default_factory=Wish)

    @property
    def causes(self) -> tuple[str, ...]:
        """Their names."""
        return tuple(SIZES[key].name for key in self.keys) or ("none",)


DEGRADED, LOW, RUBBERY, WIDE = Wish(states=2), Wish(states=2, low=True), Wish(speed=1.05), Wish(wide=True)
FOAMY = Wish(dampers=("SA2", "SA3", "SA5", "SA6", "SA8"), states=2, low=True, speed=0.786,
             styles=("velocities", "frequencies", "mixed"))  # fmt: skip
CAVITATING = Wish(dampers=("SA8", "SA8", "SA7", "SA5"), states=2, speed=1.31, styles=("recovery",))
LEAKING = Wish(states=2, styles=("velocities", "frequencies", "mixed", "triangles"))
HEATING = Wish(speed=1.05, styles=("velocities", "frequencies", "triangles", "road"))
OUTSIDE = Wish(rates=(500.0, 1000.0, 2000.0))
QUIET = ("frequencies", "triangles", "sweep", "road", "recovery", "velocities")
WISHES = {
    "heating": HEATING, "linear_mount": RUBBERY, "hard_mount": RUBBERY, "oil_column": RUBBERY, "mixing": LOW, "tilted": LOW,
    "foam_rate": FOAMY, "foam_front": FOAMY, "dissolving": CAVITATING, "pressed": CAVITATING, "residual": Wish(states=1),
    "film": LEAKING, "orifice": LEAKING, "rubber_stop": WIDE, "foam_bump": WIDE, "all_levels": DEGRADED, "one_level": LOW,
    "laws": DEGRADED,
}  # fmt: skip
FAULTS = ("offset", "gain", "flip", "delay", "unit", "stroke", "drift", "clock", "odd")
STRANGE = ("clipping", "play", "resonance", "hum", "dropouts", "inertia", "play")
PAIRS = (("warm_oil", "side_load", Wish()), ("linear_mount", "preload", RUBBERY), ("scale", "all_levels", DEGRADED),
         ("rubber_stop", "worn_out", WIDE), ("oil_column", "bent_rod", RUBBERY))  # fmt: skip
CASES = (
    *(Case("none", (), Wish(styles=(style,))) for style in (*STYLES, *QUIET)),
    *(Case("fault" if key in FAULTS else "effect", (key,), WISHES.get(key, Wish()))
      for key in SIZES if key not in (*STRANGE, "worn_out")),
    *(Case("effect", (a, b), wish) for a, b, wish in PAIRS),
    *(Case("fault" if key == "inertia" else "outside", (key,), OUTSIDE) for key in STRANGE),
)  # fmt: skip


def case_of(seed: int) -> Case:
    """The case of a seed from 1 on: of each sixty seeds every case is hidden in one, in an order of their own."""
    block, place = divmod(seed - 1, len(CASES))
    order = np.random.default_rng((20261126, block) if block else 20261126).permutation(len(CASES))
    return CASES[int(order[place])]
