"""Claims about the gas preload: C11 and C12."""

import numpy as np

from twintube.claims.claim import Claim, Dampers, Keyed, cached_works, rounded, works
from twintube.parameters import Damper
from twintube.rig import BLOCKS
from twintube.simulate import simulate


def slope(damper: Damper) -> float:
    """Slope [N/m] of the quasi-static force over the middle of the stroke, mean of both directions, at 1 mm/s."""
    amplitude = 0.9 * damper.parameters.stroke_max
    ramp = np.linspace(-amplitude, amplitude, 2000)
    z = np.concatenate([ramp, ramp[::-1], ramp, ramp[::-1]])
    v = np.where(np.arange(len(z)) // 2000 % 2 == 0, 1e-3, -1e-3)
    force = simulate(damper, z, v).force
    middle = slice(200, 1800)
    up, down = force[4000:6000], force[6000:][::-1]
    return float(np.mean([np.polyfit(ramp[middle], branch[middle], 1)[0] for branch in (up, down)]))


def c11(dampers: Dampers) -> Claim:
    """The quasi-static slope tells the preload."""
    table = {
        name: [
            rounded(slope(d.with_(gas_preload=1)), 0),
            rounded(slope(d.with_(oil_level=d.measured_levels[0], gas_preload=0)), 0),
        ]
        for name, d in dampers.items()
    }
    return Claim(
        id="C11",
        statement="quasi-static slope: clearly rising with gas preload, near zero without",
        source="Figure 7",
        holds=all(with_ > 0 and abs(without) < 0.2 * with_ for with_, without in table.values()),
        figures={"slope_N_per_m_with_and_without_preload": table},
        needs="gas stiffness (assumed from rod area, reserve volume and 5 bar)",
        assumed=True,
    )


def c12(dampers: Dampers) -> Claim:
    """The loss of the preload alone."""
    loss = {}
    for name, damper in dampers.items():
        lost = Keyed(damper.with_(oil_level=1.0, gas_preload=0))
        loss[name] = rounded(max(1 - cached_works((lost,), v)[-1] / works(damper, 1.0, v)[-1] for v in BLOCKS))
    return Claim(
        id="C12",
        statement="the loss of the whole gas preload alone costs at most 10 % of the work",
        source="Section 1 (Zwosta, another damper)",
        holds=max(loss.values()) <= 0.10,
        figures={"largest_loss_of_work_19th_oscillation": loss},
        needs="nothing; the reading `cavitation_needs` decides it (docs/open_choices.md)",
        reason="" if max(loss.values()) <= 0.10 else "the full damper cavitates in this reading",
        assumed=True,
    )
