"""Every hidden effect changes the force according to its physics."""

import numpy as np
import pytest

from twintube.dampers import load
from worlds.blind_trials.damper import march, tube
from worlds.blind_trials.excitation import VELOCITIES, harmonic, recovery
from worlds.blind_trials.hidden import DRAWS, EFFECTS, KINDS, secret
from worlds.blind_trials.model import COLUMNS, FOAMED, FORCE, FREED, K_DEGR, LOST, OIL, PLACE, WARM
from worlds.blind_trials.quantities import Hidden

P = load("SA8", as_published=True).parameters


class Run:
    """A record of SA8 with effects hidden in it."""

    def __init__(self, level, velocity, preload=False, pause=0.0, *, name="SA8", excitation=None, changes=None, **hidden):
        self.excitation = excitation or harmonic(velocity, pause)
        rate = max(200.0, 400 * velocity / (2 * np.pi * 0.045))
        self.time = np.arange(int(self.excitation.duration * rate)) / rate
        self.z, self.v = self.excitation.sampled(self.time)
        self.out = march(tube(name, level, preload, changes), Hidden(**hidden), self.excitation, self.time)
        self.force = self.out[:, FORCE]

    def works(self, block=0):
        begin, end = self.excitation.blocks[block]
        edges = np.searchsorted(self.time, np.linspace(begin, end, 20))
        return np.array([np.trapezoid(self.force[i:j], self.z[i:j]) for i, j in zip(edges[:-1], edges[1:], strict=True)])

    def block(self, block=0):
        begin, end = self.excitation.blocks[block]
        return (self.time >= begin) & (self.time < end)


def drawn(kind, **changes):
    return secret(kind, 3, P, 1.0)[0].always | changes


def test_every_kind_has_a_draw():
    assert set(DRAWS) == set(KINDS) and len(EFFECTS) == 15


def test_strength_zero_hides_nothing():
    plain = Run(0.56, 1.048).force
    for kind in EFFECTS:
        s = secret(kind, 3, P, 0.0)[0]
        hidden = s.always | s.moving | s.degraded
        error = np.sqrt(np.mean((Run(0.56, 1.048, **hidden).force - plain) ** 2)) / np.abs(plain).max()
        # With a mount, even a rigid one, the rod has a mass, and changes within a sample are not averaged.
        assert error < (0.03 if kind == "mount_compliance" else 1e-9), (kind, error)


def test_temperature_fades_and_recovers_at_rest():
    warm = Run(1.0, 1.048, True, 60.0, **drawn("oil_temperature", cooling=1 / 30))
    first, second = warm.works(0), warm.works(1)
    assert first[18] < 0.97 * first[1]
    assert second[1] > first[18]
    assert 5.0 < np.ptp(warm.out[:, WARM]) < 60.0
    cold = Run(1.0, 1.048, True, start=283.15, thinning=0.3)
    assert cold.works()[5] > Run(1.0, 1.048, True).works()[5]


def test_mount_takes_stroke_and_is_stable_when_stiff():
    soft = Run(1.0, 1.048, True, **drawn("mount_compliance"))
    lost = soft.z - soft.out[:, PLACE]
    inside = soft.block()
    assert 0.5e-3 < np.abs(lost[inside]).max() < 8e-3
    assert np.corrcoef(lost[inside], soft.force[inside])[0, 1] > 0.9
    stiff, plain = Run(1.0, 1.048, True, mount=1e11, rubber=500.0), Run(1.0, 1.048, True)
    assert np.sqrt(np.mean((stiff.force - plain.force) ** 2)) < 0.02 * plain.force.max()


def test_lag_makes_a_loop_about_the_curve():
    lag, plain = Run(1.0, 0.524, True, **drawn("fluid_lag")), Run(1.0, 0.524, True)
    late = (lag.v > 0.1) & (lag.z < -0.035) & lag.block()  # velocity still rising: the force is behind
    assert np.mean(lag.force[late] - plain.force[late]) < -5.0
    falling = (lag.v > 0.1) & (lag.z > 0.035) & lag.block()
    assert np.mean(lag.force[falling] - plain.force[falling]) > np.mean(lag.force[late] - plain.force[late])
    stiff = Run(1.0, 0.524, True, give=1e-15)
    assert np.abs(stiff.force - plain.force).max() < 1e-3 * plain.force.max()


def test_transition_is_gradual():
    # With a long dead length gas and oil alternate in every stroke.
    smooth, plain = (Run(0.56, 1.048, changes={"dead_length": 0.11}, blend=blend) for blend in (4e-3, 0.0))

    def between(run):
        k = run.out[run.block(), K_DEGR]
        return np.mean((k > 0.2) & (k < 0.9))

    assert between(smooth) > 3 * between(plain)


def test_foam_drains_at_rest():
    drained, plain = (Run(0.30, 1.048, pause=60.0, **h) for h in (drawn("foam_decay"), {}))
    at_rest = np.flatnonzero(
        (plain.time > plain.excitation.pieces[3, 0] + 0.1) & (plain.time < plain.excitation.pieces[3, 1])
    )
    assert np.ptp(plain.out[at_rest, FOAMED]) == 0.0
    assert drained.out[at_rest[-1], FOAMED] < 0.5 * drained.out[at_rest[0], FOAMED]


def test_dissolved_gas_brings_the_work_back():
    back, plain = (Run(0.56, 1.048, pause=60.0, **h) for h in (drawn("gas_redissolution"), {}))
    assert back.works()[18] > plain.works()[18]
    assert back.works(1)[0] > 1.5 * plain.works(1)[0]
    assert back.out[-1, FREED] < plain.out[-1, FREED]


def long_block(level=0.9, pause=10.0, slow=False, **hidden):
    """20 s at 1.08 m/s, a pause [s], slow strokes or none, and 19 oscillations."""
    return Run(level, 1.08, excitation=recovery(1.08, 20.0, pause, slow), **hidden)


def test_displaced_oil_is_in_the_damper_still():
    start = tube("SA8", 0.9, False).oil
    letter, half, all_displaced = (long_block(give_way=share) for share in (0.0, 0.5, 1.0))
    for run in (letter, half, all_displaced):
        assert run.out[:, OIL] + run.out[:, FREED] == pytest.approx(start, rel=1e-9)
    assert letter.out[-1, OIL] < 0.6 * start and half.out[-1, OIL] > letter.out[-1, OIL]
    assert all_displaced.out[:, OIL] == pytest.approx(start, rel=1e-9) and all_displaced.out[-1, FREED] == 0.0
    assert all_displaced.works(1)[18] > 2 * letter.works(1)[18]


def test_slow_strokes_bring_displaced_oil_back_and_rest_does_not():
    first, rested, slow = (
        long_block(pause=pause, slow=slow, give_way=1.0).works(1)[0]
        for pause, slow in ((10, False), (180, False), (10, True))
    )
    assert rested == pytest.approx(first, rel=1e-3) and slow > 1.3 * first


def test_oil_frees_no_more_gas_than_it_holds():
    start = tube("SA8", 0.9, False).oil
    for limit in (0.2, 0.345):
        freed = long_block(scarce=1 / limit).out[:, FREED] / start
        assert (np.diff(freed) >= 0.0).all()
        assert 0.98 * limit < freed[-1] <= limit
    assert long_block().out[-1, FREED] > 0.45 * start


def test_residual_gas_pushes_the_rod_out_more_when_it_is_in():
    more = Run(0.56, 0.131, residual=1.5e5).force - Run(0.56, 0.131).force
    z = Run(0.56, 0.131).z
    assert (more < 0).all() and more[z < -0.04].mean() < more[z > 0.04].mean()
    assert more.mean() == pytest.approx(-1.5e5 * tube("SA8", 0.56, False).A_rod, rel=0.1)


def test_leak_loses_the_stated_share_and_lowers_the_work():
    s = secret("seal_leak", 3, P, 1.0)[0]
    leak = s.always["leak"]
    slow = Run(0.56, min(VELOCITIES), leak=leak)
    assert slow.out[-1, LOST] == pytest.approx(s.truth["lost_in_longest_record_m3"], rel=0.02)
    fast, plain = Run(0.56, 0.524, leak=5 * leak), Run(0.56, 0.524)
    assert fast.works()[18] < plain.works()[18]


def test_stops_act_at_the_ends_only():
    more = Run(1.0, 0.131, True, stop_out=100.0, stop_in=50.0, stop_at=0.038, stop_scale=3e-3, stop_loss=0.2)
    plain = Run(1.0, 0.131, True)
    extra, z = more.force - plain.force, plain.z
    assert np.abs(extra[np.abs(z) < 0.038]).max() == 0.0
    assert extra[z > 0.044].min() > 300.0 and extra[z < -0.044].max() < -150.0


def test_side_load_rubs_against_the_motion():
    more = Run(1.0, 0.131, True, side=80.0, side_v=5e-3)
    extra = more.force - Run(1.0, 0.131, True).force
    assert extra[more.v > 0.05] == pytest.approx(80.0, abs=0.1)
    assert extra[more.v < -0.05] == pytest.approx(-80.0, abs=0.1)


def test_a_side_pull_rubs_more_with_the_rod_out():
    more = Run(1.0, 0.131, True, lever=1.0, span=0.09, overhang=0.05)
    plain = Run(1.0, 0.131, True)
    extra = np.sign(plain.v) * (more.force - plain.force)
    fast = np.abs(plain.v) > 0.05
    out, inside = extra[fast & (plain.z > 0.03)], extra[fast & (plain.z < -0.03)]
    assert out.min() > 8.0 and inside.max() < -4.0
    assert np.abs(extra[fast & (np.abs(plain.z) < 1e-3)]).max() < 1.0


def test_wear_changes_each_branch_by_its_own_factor():
    worn, plain = (Run(1.0, 1.048, True, **h) for h in (dict(wear_re=-0.2, wear_re_slow=-0.1, wear_co=0.15), {}))
    extra = worn.force - plain.force
    assert extra[plain.v > 0.9].max() < -200.0 and extra[plain.v < -0.9].max() < -30.0


def test_play_leaves_the_piston_behind_and_the_force_at_zero():
    loose = Run(1.0, 0.131, True, play=0.6e-3)
    assert np.abs(loose.z - loose.out[:, PLACE]).max() == pytest.approx(0.3e-3, rel=0.01)
    free = (np.abs(loose.z - loose.out[:, PLACE]) < 0.25e-3) & (loose.time > 0)
    assert free.any() and np.all(loose.force[free] == 0.0)


def test_the_rig_rings_at_its_own_frequency():
    f = 40.0
    rings, plain = (Run(0.56, 1.048, **h) for h in (dict(mode=2 * np.pi * f, mode_loss=0.03, mode_share=0.8), {}))
    step = rings.time[1]
    extra = (rings.force - plain.force)[rings.block()]
    power = np.abs(np.fft.rfft(extra * np.hanning(len(extra)))) ** 2
    assert np.fft.rfftfreq(len(extra), step)[np.argmax(power)] == pytest.approx(f, rel=0.12)
    assert rings.out.shape[1] == COLUMNS
