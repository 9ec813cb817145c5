"""Speed of the kernel."""

from benchmarks.timing import best
from twintube.core import effects, model
from twintube.core.variables import Derived, Flow, blank
from twintube.dampers import load
from twintube.engine.simulate import work_between
from twintube.rig.signals import harmonic_block


def bench_kernel() -> dict[str, float]:
    """Time per step of the compiled and the interpreted kernel on one signal, SA8 at 60 % oil, 1.048 m/s."""
    damper = load("SA8", as_published=True).with_(oil_level=0.6, gas_preload=0)
    block = harmonic_block(1.048)
    n = len(block.stroke)
    work_between(damper, block.stroke, block.velocity, block.marks)
    fast = best(lambda: work_between(damper, block.stroke, block.velocity, block.marks))
    stroke, velocity = block.stroke.tolist(), block.velocity.tolist()

    def interpreted() -> None:
        p, d, s, f = damper.parameters, blank(Derived), blank(effects.State), blank(Flow)
        model.set_up(p, d)
        model.start(p, d, s, 0.0)
        before = velocity[0]
        for z, v in zip(stroke, velocity, strict=True):
            model.advance(p, d, s, f, z, before, v, 0.0)
            before = v

    slow = best(interpreted)
    return {"ns_per_step": fast / n * 1e9, "interpreted_ns_per_step": slow / n * 1e9, "speed_up": slow / fast}
