"""What happens to the damper with other physics is what its cause says."""

import numpy as np
import pytest

from twintube.lab.virtual_rig import virtual_damper
from worlds.imperfect.causes import CAUSES
from worlds.imperfect.law import RATE
from worlds.other_physics import CHANNELS, INSIDE, STATES, force, virtual_rig


def loop(force_: np.ndarray, n: int) -> tuple[float, float]:
    """Height of the last cycle [N], and the middle between its largest and its least force [N]."""
    last = force_[-n:]
    return float(np.ptp(last)), float((last.max() + last.min()) / 2)


@pytest.mark.slow  # compiles the rig
def test_wear_makes_the_loop_smaller_friction_larger_and_lost_gas_lifts_it() -> None:
    omega = 0.262 / 0.03
    n = round(2 * np.pi / omega * RATE)
    z = 0.03 * np.sin(omega * np.arange(4 * n) / RATE) * np.clip(np.arange(4 * n) / n, 0.0, 1.0)
    healthy = virtual_damper("SA8")
    height, middle = loop(force(healthy, z, 1.0, preload=True, room=25.0, warmer=0.0), n)
    for key, change in INSIDE.items():
        own, centre = loop(force(change(np.random.default_rng(2), healthy), z, 1.0, preload=True, room=25.0, warmer=0.0), n)
        if key == "gas_leaked":
            assert centre > middle + 1.0
        else:
            assert (own > height + 1.0) == (key == "side_load"), key
    hot, _ = loop(force(healthy, z, 1.0, preload=True, room=25.0, warmer=30.0), n)
    assert hot < height


@pytest.mark.slow  # a minute of records
def test_the_rig_has_reference_records_and_later_ones() -> None:
    world = virtual_rig(1)
    assert world.truth["causes"] == ["channel_delay"]
    assert world.truth["effect_over_noise"] > 0.5
    assert sum(item.reference for item in world.recordings) == 6
    assert all(np.isfinite(item.force).all() for item in world.recordings)


def test_its_causes_have_the_names_and_kinds_of_the_other_worlds() -> None:
    kinds = [{CAUSES[key].kind for key in keys} for keys in (STATES, CHANNELS, INSIDE)]
    assert kinds == [{"state"}, {"fault"}, {"effect"}]
