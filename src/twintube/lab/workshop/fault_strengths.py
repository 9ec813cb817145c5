"""How large faults of the measurement and what is outside are in practice: each draws one, in SI units."""

from twintube.dampers import names
from twintube.lab.workshop.cause import Cause
from twintube.lab.workshop.faults import Clipped, Drift, Hum, Inertia, Late, Lost, Play, Resonance, Scaled, Stranger
from twintube.lab.workshop.plan import Day
from twintube.lab.workshop.strengths import Draw, between, sign


def offset(draw: Draw, day: Day) -> list[Cause]:
    """10 to 80 N."""
    zero = sign(draw) * between(draw, 10.0, 80.0)
    return [Scaled("force_offset", "zero of the load cell", {"zero": zero}, force_zero=zero)]


def gain(draw: Draw, day: Day) -> list[Cause]:
    """1 to 8 %."""
    g = 1.0 + sign(draw) * between(draw, 0.01, 0.08)
    return [Scaled("force_gain", "gain of the load cell", {"gain": g}, force_gain=g)]


def flip(draw: Draw, day: Day) -> list[Cause]:
    """The force channel's sign."""
    return [Scaled("sign_flip", "force negative in rebound", {}, force_gain=-1.0)]


def delay(draw: Draw, day: Day) -> list[Cause]:
    """1.2 to 10 samples, at least 1 ms."""
    time = max(1e-3, float(draw.uniform(1.2, 6.0)) / day.recorder.fs)
    return [Late("channel_delay", "force late", {"delay": time}, delay=time)]


def unit(draw: Draw, day: Day) -> list[Cause]:
    """Pounds (lbf) or kgf written as N."""
    name, factor = [("lbf", 1 / 4.4482216), ("kgf", 1 / 9.80665)][int(draw.integers(2))]
    return [Scaled("unit_error", f"{name} written as N", {"factor": factor}, force_gain=factor)]


def stroke(draw: Draw, day: Day) -> list[Cause]:
    """2 to 8 %."""
    g = 1.0 + sign(draw) * between(draw, 0.02, 0.08)
    return [Scaled("stroke_gain", "gain of the stroke sensor", {"gain": g}, stroke_gain=g)]


def drift(draw: Draw, day: Day) -> list[Cause]:
    """20 to 90 N over the run."""
    size, last = sign(draw) * between(draw, 20.0, 90.0), day.trials[-1]
    tau = last.begin + len(last.x) / last.rate
    return [Drift("zero_drift", "linear over the run", {"size": size, "tau": tau}, size=size, tau=tau)]


def clock(draw: Draw, day: Day) -> list[Cause]:
    """2 to 8 %: another rate than the one in the header."""
    factor = 1.0 + sign(draw) * between(draw, 0.02, 0.08)
    return [Scaled("time_base", "times scaled", {"factor": factor}, clock=factor)]


def odd(draw: Draw, day: Day) -> list[Cause]:
    """A record of another damper, or with another range of the amplifier."""
    only = int(draw.integers(1, len(day.trials)))
    if draw.random() < 0.5:
        return [
            Scaled(
                "odd_record",
                "one record, range of the amplifier",
                {"record": only + 1, "gain": 0.5},
                force_gain=0.5,
                only=only,
            )
        ]
    other = str(draw.choice([x for x in names() if x != day.name and (int(x[2]) + int(day.name[2])) % 2 == 1]))
    return [
        Stranger("odd_record", "one record of another damper", {"record": only + 1, "damper": other}, only=only, other=other)
    ]


def clipping(draw: Draw, day: Day) -> list[Cause]:
    """At 300 to 1000 N."""
    limit = float(draw.uniform(300.0, 1000.0))
    return [Clipped("clipping", "limit", {"limit": limit}, limit=limit)]


def play(draw: Draw, day: Day) -> list[Cause]:
    """0.3 to 1.5 mm."""
    size = between(draw, 3e-4, 1.5e-3)
    return [Play("backlash", "play operator", {"play": size}, play=size)]


def resonance(draw: Draw, day: Day) -> list[Cause]:
    """40 to 120 Hz, damping 0.02 to 0.06."""
    f, d = float(draw.uniform(40.0, 120.0)), float(draw.uniform(0.02, 0.06))
    return [Resonance("rig_resonance", "second order", {"frequency": f, "damping": d}, frequency=f, damping=d)]


def hum(draw: Draw, day: Day) -> list[Cause]:
    """10 to 60 N."""
    size = between(draw, 10.0, 60.0)
    return [Hum("mains_hum", "50 and 150 Hz", {"amplitude": size}, amplitude=size)]


def dropouts(draw: Draw, day: Day) -> list[Cause]:
    """3 to 12 per record, up to 30 ms."""
    count = int(draw.integers(3, 13))
    return [Lost("dropouts", "zeros", {"count": count}, count=count, longest=0.03, seed=int(draw.integers(1 << 20)))]


def inertia(draw: Draw, day: Day) -> list[Cause]:
    """2 to 6 kg."""
    mass = float(draw.uniform(2.0, 6.0))
    return [Inertia("clamp_inertia", "mass times acceleration", {"mass": mass}, mass=mass)]
