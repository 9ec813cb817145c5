"""Compression while cavitation brings gas into a full V1: the reading `venting`."""

import numpy as np
import pytest

from twintube.core.kernel import compression, fill, prepare
from twintube.core.kernel.compression import vented_share
from twintube.core.kernel.forces import UNREACHED
from twintube.core.variables import Derived, Flow, Parameters, State, blank
from twintube.dampers import load
from twintube.engine.simulate import simulate
from twintube.rig.signals import harmonic_block


def full(venting: int, X_Co2: float, Y_Co: float) -> tuple[Parameters, Derived, State, Flow]:
    """Both working chambers full of oil, the valve cavitating."""
    changes = {"oil_level": 1.0, "gas_preload": 0, "cavitation_loss": 0.0, "X_Co2": X_Co2, "Y_Co_cav": Y_Co}
    p = load("SA3", as_published=True).with_(venting=venting, **changes).parameters
    d, s, f = blank(Derived), blank(State), blank(Flow)
    prepare(p, d)
    fill(p, d, s, 0.0)
    return p, d, s, f


@pytest.mark.parametrize("length", [2e-6, 1e-4])
@pytest.mark.parametrize(("X_Co2", "Y_Co"), [(0.1, 0.1), (0.5, 0.02), (0.3, 0.25), (0.8, 0.1), (0.8, 0.12)])
def test_step_by_step_is_what_naive_steps_do(X_Co2: float, Y_Co: float, length: float) -> None:
    """Each step goes by what V1 holds at its start, and gas is not below 0: k_degr and oil in the mean of many steps."""
    p, d, s, f = full(1, X_Co2, Y_Co)
    compression(p, d, s, f, 0.0, 1.0, UNREACHED)
    gas, k, passed = 0.0, [], []
    for _ in range(12000):
        vents = gas > 0.0
        piston = d.A_2 - d.W_kBV_2 * d.A_2 if vents else d.A_1
        gas = max(0.0, gas + (d.A_1 - (1.0 - Y_Co) * piston) * length)
        k.append(d.k_Co2 if vents else 1.0)
        passed.append(piston)
    assert f.k_degr == pytest.approx(np.mean(k), rel=1e-3)
    assert f.cavitated == pytest.approx(Y_Co * np.mean(passed), rel=1e-3)
    # V1 stays full of oil, V2 gives what the stroke takes, and what is left is in the reserve.
    assert (f.V1_gas, f.V1_oil) == (0.0, pytest.approx(d.A_1))
    assert f.V1_oil + f.V2_oil + f.V3_oil + f.cavitated == pytest.approx(0.0, abs=1e-12 * d.A_2)


@pytest.mark.parametrize(("X_Co2", "Y_Co", "turns"), [(0.1, 0.1, 1), (0.8, 0.1, 2), (0.8, 0.12, 3)])
def test_share_of_the_two_readings(X_Co2: float, Y_Co: float, turns: int) -> None:
    """A step without venting and `turns` with it; sliding vents for a smaller share of the time, whatever gas there is."""
    shares = [vented_share(p, d, False, 0.0, 1.0) for p, d, _, _ in (full(0, X_Co2, Y_Co), full(1, X_Co2, Y_Co))]
    assert shares[1] == turns / (turns + 1)
    assert 0.0 < shares[0] < shares[1]
    p, d, _, _ = full(1, X_Co2, 0.0)
    assert vented_share(p, d, False, 0.0, 1.0) == 0.0


# By an independent program that steps naively, in steps of 2 to 500 um: first and 19th work over intact at 1.572 m/s,
# sliding and naive; its own spread over the steps is 0.003.
@pytest.mark.parametrize(
    ("name", "level", "sliding", "naive"),
    [
        ("SA3", 0.61, (0.997, 0.933), (0.955, 0.792)),
        ("SA7", 0.90, (0.996, 0.996), (0.963, 0.963)),
        ("SA5", 0.72, (0.992, 0.689), (0.955, 0.660)),
    ],
)
def test_naive_steps_of_another_program(
    name: str, level: float, sliding: tuple[float, float], naive: tuple[float, float]
) -> None:
    block = harmonic_block(1.572)
    damper = load(name, as_published=True)

    def works(**state: float) -> np.ndarray:
        return np.diff(simulate(damper.with_(**state), block.stroke, block.velocity).work[block.marks])

    intact = works()[0]
    for venting, expected in enumerate((sliding, naive)):
        found = works(oil_level=level, gas_preload=0, venting=venting) / intact
        assert (found[0], found[-1]) == pytest.approx(expected, abs=0.003)
