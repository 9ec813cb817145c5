"""Claims about the gas preload: C11 and C12."""

import numpy as np

from twintube.claims.claim import ASSUMPTION, BENCH, READING, STAND_IN, Bench, Claim, Dampers, condition, rounded, run
from twintube.dampers import Damper
from twintube.engine.simulate import simulate
from twintube.rig.plan import V_QUASI_STATIC, amplitude, oil_levels
from twintube.rig.signals import BLOCKS

CLOSE_TO_ZERO = 0.1  # of the intact slope: an order of magnitude
ZWOSTA = 0.10  # largest loss of force and of work by the loss of the preload


def slope(damper: Damper) -> float:
    """Slope [N/m] of the quasi-static force over the middle of the stroke, mean of both directions, at 1 mm/s."""
    reach = amplitude(damper)
    ramp = np.linspace(-reach, reach, 2000)
    z = np.concatenate([ramp, ramp[::-1], ramp, ramp[::-1]])
    v = np.where(np.arange(len(z)) // 2000 % 2 == 0, V_QUASI_STATIC, -V_QUASI_STATIC)
    force = simulate(damper, z, v, np.arange(len(z)) * (ramp[1] - ramp[0]) / V_QUASI_STATIC).force
    middle = slice(200, 1800)
    up, down = force[4000:6000], force[6000:][::-1]
    return float(np.mean([np.polyfit(ramp[middle], branch[middle], 1)[0] for branch in (up, down)]))


def c11(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """The quasi-static slope shows the preload."""
    table = {name: [rounded(slope(condition(d, level, bench)), 0) for level in oil_levels(d)] for name, d in dampers.items()}
    intact, *lost = table["SA7"]
    holds = intact > 0 and max(map(abs, lost)) <= CLOSE_TO_ZERO * intact
    return Claim(
        id="C11",
        quote="The figure shows that the rate of increase in the curves for the intact configuration with gas preload is "
        "significantly higher than the rate of increase in the degraded states without gas preload, which is close to zero.",
        statement="quasi-static slope: clearly rising with gas preload, near zero without",
        source="Section 3.1, Figure 7 (SA7)",
        tested="slope of the force over the middle 80 % of slow ramps, SA7 as in the figure: without preload at most "
        f"{CLOSE_TO_ZERO:.0%} of the intact slope, at both measured levels",
        holds=holds,
        figures={"slope_N_per_m_with_and_without_preload": table},
        needs="gas stiffness (assumed from rod area, reserve volume and 5 bar)",
        because="" if holds else STAND_IN,
        reason="" if holds else "the assumed stiffness without preload is too high",
        no_evidence=ASSUMPTION,
    )


def losses(damper: Damper, velocity: float, bench: Bench) -> tuple[float, float]:
    """Largest loss of force and of work [1] by the loss of the preload alone, over all oscillations and directions."""
    peaks = []
    for preload in (1, 0):
        signal, result = run(damper, 1.0, velocity, bench, preload=preload)
        first, count = int(signal.marks[0]), len(signal.marks) - 1
        loops = (result.force - result.F_gas)[first : int(signal.marks[-1])].reshape(count, -1)
        peaks.append((loops.max(axis=1), -loops.min(axis=1), np.diff(result.work[signal.marks])))
    rebound, compression, work = (1 - after / before for before, after in zip(*peaks, strict=True))
    return float(max(rebound.max(), compression.max())), float(work.max())


def c12(dampers: Dampers, bench: Bench = BENCH) -> Claim:
    """The loss of the preload alone."""
    table = {n: [losses(d, v, bench) for v in BLOCKS] for n, d in dampers.items()}
    force, work = ({n: rounded(max(pair[i] for pair in rows)) for n, rows in table.items()} for i in (0, 1))
    holds = max(*force.values(), *work.values()) <= ZWOSTA
    reason = ""
    if not holds:
        worst = max(work, key=work.__getitem__)
        reason = f"the damper full of oil needs the preload in this reading: {worst} loses {work[worst]:.0%} of its work"
    return Claim(
        id="C12",
        quote="Although the loss of the entire gas preload reduces the maximum damping force and damping work to a "
        "maximum of 10%.",
        statement="the loss of the whole gas preload alone costs at most 10 % of damping force and work",
        source="Section 1 (Zwosta, another damper)",
        tested="highest damping force (without the gas force) of both directions and work of each of the 19 "
        f"oscillations, every velocity and damper, full of oil with and without preload: at most {ZWOSTA:.0%} less",
        holds=holds,
        figures={"largest_loss_of_force": force, "largest_loss_of_work": work},
        needs="nothing; the reading `cavitation_loss` determines it (docs/open_choices.md)",
        because="" if holds else READING,
        reason=reason,
        no_evidence=ASSUMPTION,
    )
