"""Any sequence of communication steps gives the force and the work of the motion: zero, short, long, mixed, cut, noisy."""

from dataclasses import asdict, astuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.eight import EIGHT
from twintube.common.arrays import Array
from twintube.core.agreement import PLAY
from twintube.core.instance import Instance
from twintube.dampers import load

FINE = 2.5e-4  # [s] of the run that the others are compared with
NOISE = 20e-6  # [m] of a stroke signal
STATES = {"intact": (1.0, 1), "70 %": (0.7, 0), "56 %": (0.56, 0), "40 %": (0.4, 0)}
EFFECTS = {
    "none": {},
    "build-up": {"build_up": 5e-3, "early_share": 0.3, "carry_over": 0.5},
    "columns": {"C_fluid": 1.9e-7, "C_fluid_co": 7.7e-6, "V_air": 2e-7},
    "late valves": {"tau_fluid": 3e-3, "closing_stroke": 2e-3},
    "mount": {"C_mount": 1e-6},
    "heat, leak, foam": {"fade_heat": 2e-5, "leak_film": 1e-6, "foam_decay_rate": 0.1},
    "side load": {"side_load": 3.0},
}
Segments = list[tuple[float, float, float]]  # stroke [m] and velocity [m/s] that are set, length of the step [s]
# A few lengths that solvers take, and anything up to 10 ms.
LENGTHS = st.one_of(st.sampled_from([0.0, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 2e-3]), st.floats(0.0, 1e-2))


def damper(name: str, state: str = "intact", **effect: float) -> Instance:
    """At rest no longer: it starts at the velocity of the sine, so that no force has to build up first."""
    unit = Instance(asdict(load(name).parameters))
    unit.inputs.velocity = 0.04 * 2 * np.pi * 1.5
    level, preload = STATES[state]
    for parameter, value in ({"oil_level": level, "gas_preload": preload} | effect).items():
        unit.set_parameter(parameter, -1, value)
    assert unit.begin() == ""
    return unit


def sine(times: Array, amplitude: float = 0.04, frequency: float = 1.5) -> Array:
    return amplitude * np.sin(2 * np.pi * frequency * times)


def segments(lengths: list[float], *, of_the_moment: bool = False) -> Segments:
    """The sine in steps: each goes in a line to the place of the next, or as the velocity at its start says."""
    h = np.array(lengths)
    times = np.concatenate([[0.0], np.cumsum(h)])
    z = sine(times)
    moment = 0.04 * 2 * np.pi * 1.5 * np.cos(2 * np.pi * 1.5 * times[:-1])
    mean = np.diff(z) / np.where(h > 1e-12, h, 1.0)
    v = moment if of_the_moment else np.where(h > 1e-12, mean, moment)
    return list(zip(z[:-1].tolist(), v.tolist(), lengths, strict=True))


def moved(unit: Instance, path: Segments, noise: float = 0.0, seed: int = 1) -> Array:
    """The forces [N] at the ends of the steps."""
    random = np.random.default_rng(seed)
    forces = []
    for z, v, h in path:
        unit.inputs.stroke, unit.inputs.velocity = z + noise * random.standard_normal(), v
        assert unit.move(0.0, h) == ""
        forces.append(unit.o.force)
    return np.array(forces)


def cut(path: Segments, cuts: tuple[int, ...] = (0, 0, 1, 2, 7)) -> Segments:
    """The same lines, each cut at one of these numbers of random places, some steps of length 0 among them."""
    random = np.random.default_rng(4)
    pieces = []
    for z, v, h in path:
        ends = np.sort(np.concatenate([[0.0, 1.0], random.random(int(random.choice(cuts)))]))
        if random.random() < 0.3:
            pieces.append((z, v, 0.0))
        pieces += [(z + v * h * float(a), v, h * float(b - a)) for a, b in zip(ends[:-1], ends[1:], strict=True)]
    return pieces


def beyond(forces: Array, path: Segments, exact: Array) -> Array:
    """By how much [N] each force leaves the band of the forces at most 2 ms before the step or after it."""
    ends = np.cumsum([h for _, _, h in path])
    off = []
    for force, end, (_, _, h) in zip(forces, ends, path, strict=True):
        a, b = int((end - h - 2e-3) / FINE) - 1, int((end + 2e-3) / FINE) + 2
        band = exact[max(0, a) : b]
        off.append(max(band.min() - force, force - band.max(), 0.0))
    return np.array(off)


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", EIGHT)
@pytest.mark.parametrize("short", [0.0, 1e-6, 1e-5, 1e-4])
def test_a_short_step_among_usual_ones_stays_between_its_neighbours(name: str, state: str, short: float) -> None:
    """The velocity of the moment leads beyond the next place wherever the motion slows down."""
    lengths = ([1e-3] * 5 + [short]) * 150
    forces = moved(damper(name, state), segments(lengths, of_the_moment=True))
    at = np.arange(5, len(forces) - 6, 6)
    low, high = np.minimum(forces[at - 1], forces[at + 1]), np.maximum(forces[at - 1], forces[at + 1])
    # What the velocity of the moment is off the mean of a step, 2 mm/s, is worth a few newtons.
    assert np.maximum(low - forces[at], forces[at] - high).max() < 10.0


@given(lengths=st.lists(LENGTHS, min_size=60, max_size=200), state=st.sampled_from(sorted(STATES)), seed=st.integers(0, 99))
@settings(max_examples=25, deadline=None)
def test_random_steps_stay_in_the_band_of_the_smooth_motion(lengths: list[float], state: str, seed: int) -> None:
    exact = moved(damper("SA8", state), segments([FINE] * (int(sum(lengths) / FINE) + 20)))
    for noise in (0.0, NOISE):
        path = segments(lengths)
        forces = moved(damper("SA8", state), path, noise, seed)
        # Friction builds up over a tenth of a millimetre, of which noise may take a part: 0.2 of 50 N.
        assert beyond(forces, path, exact).max() < 20.0


def work(path: Segments, state: str, effect: str) -> float:
    """Work [J] of an SA8 over a path."""
    unit = damper("SA8", state, **EFFECTS[effect])
    moved(unit, path)
    return float(unit.o.work)


@pytest.mark.parametrize("effect", EFFECTS)
@pytest.mark.parametrize("state", STATES)
def test_a_drive_cut_at_random_does_the_same_work(state: str, effect: str) -> None:
    """An effect that is integrated over time has a step error of its own: up to that of the steps it is cut from."""
    path = segments(np.random.default_rng(3).choice([5e-4, 1e-3, 2e-3], size=600).tolist())
    whole, pieces = work(path, state, effect), work(cut(path), state, effect)
    own = 0.0 if effect == "none" else abs(work(cut(path, (7,)), state, effect) - whole)
    assert abs(pieces - whole) < 1e-3 * whole + own


@pytest.mark.parametrize("effect", EFFECTS)
@pytest.mark.parametrize("state", ["intact", "56 %"])
def test_noise_of_the_stroke_is_no_reversal(state: str, effect: str) -> None:
    """At 0.1 ms the noise is half the way of a step. It moves the piston by up to four times its size, of 40 mm."""
    path = segments([1e-4] * 10000)
    quiet, noisy = damper("SA8", state, **EFFECTS[effect]), damper("SA8", state, **EFFECTS[effect])
    exact, forces = moved(quiet, path), moved(noisy, path, NOISE)
    assert noisy.o.work == pytest.approx(quiet.o.work, rel=4 * NOISE / 0.04)
    # Where the force steps - three times in each of three strokes, faster than 0.1 m/s - the place is that much off.
    assert np.sum(np.abs(forces - exact) > 50.0) < 3 * 3 * 4 * NOISE / (0.1 * 1e-4)


@pytest.mark.parametrize("state", STATES)
def test_standing_still_is_no_flow(state: str) -> None:
    unit = damper("SA8", state)
    moved(unit, segments([1e-3] * 900))
    stands = unit.s.z
    before, work = astuple(unit.s), unit.o.work
    forces = moved(unit, [(stands, 0.0, h) for h in (0.0, 1e-6, 1e-3, 1e-2) * 50], NOISE)
    after = {name: value for name, value in asdict(unit.s).items() if name.startswith("V") or name == "z"}
    assert after == {name: value for name, value in zip(asdict(unit.s), before, strict=True) if name in after}
    assert unit.o.work == work
    assert np.ptp(forces) == 0.0


def test_a_stroke_without_its_velocity_still_moves_the_piston() -> None:
    """The warning says that they have parted; the piston is drawn along at the distance of the play."""
    unit = damper("SA8")
    times = np.arange(2000) * 1e-3
    for factor in (0.0, -1.0):
        places = []
        for z in sine(times).tolist():
            unit.inputs.stroke, unit.inputs.velocity = z, factor * 1e-3
            assert unit.move(0.0, 1e-3) == ""
            places.append(unit.s.z)
        assert np.abs(np.array(places) - sine(times)).max() <= PLAY + 1e-5
