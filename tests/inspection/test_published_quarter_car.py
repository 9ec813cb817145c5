"""A public quarter car on a EUSAMA plate, reproduced with its own parameters and its own sweep: figure against figure.

github.com/0wojtaszek0/Modele-inzynieryjne, a program after EGEA SPECSUS2018 whose page states parameters and results of its
linear quarter car: static force about 3747 N, EUSAMA about 57 %, largest relative force amplitude (RFAmax) about 43 %. It is
no paper. Its phase shift of about 88 degrees is not compared: the program takes the middle between two crossings of the
static force, which is the largest or the smallest force according to which crossing comes first.
"""

from dataclasses import replace

import numpy as np
import pytest

from tests.inspection.linear import linear_car, linear_damper
from twintube.arrays import Array
from twintube.vehicle.drive import drive
from twintube.vehicle.quarter_car import static_load

CAR = replace(
    linear_car(), m_body=346.0, m_wheel=36.0, c_body=25570.0, c_tyre=253161.0, d_tyre=150.0, d_links=0.0, ratio=1.0
)
DAMPING, AMPLITUDE, DT = 1474.0, 3e-3, 5e-4  # [N.s/m], [m], [s]
STATIC, EUSAMA, LARGEST = 3747.0, 57.0, 43.0  # [N], [%], [%] as stated there
MEASURED = (6.0, 18.0)  # [Hz]


def sweep() -> tuple[Array, Array, Array]:
    """Heights [m], rates [m/s] and frequency [Hz] (n,) of its plate: whole cycles of constant frequency from the top."""
    held = (static_load(CAR) * 0.16 + 1200.0) / 1000.0
    corners = np.cumsum([0.0, 2.0, held, 2.0, 7.5, 3.0])
    time = np.arange(0.0, corners[-1] - 0.3, DT)
    heights, rates, frequency = (np.zeros_like(time) for _ in range(3))
    begin, i = 0.0, 0
    while i < len(time):
        f = float(np.interp(begin, corners, [2.0, 25.0, 25.0, 18.0, 6.0, 0.0]))
        end = int(np.searchsorted(time, begin + 1.0 / f))
        angle = 2 * np.pi * f * (time[i:end] - begin)
        heights[i:end], rates[i:end] = AMPLITUDE * np.cos(angle), -AMPLITUDE * 2 * np.pi * f * np.sin(angle)
        frequency[i:end] = f
        begin, i = begin + 1.0 / f, end
    return heights, rates, frequency


def test_its_figures_are_reproduced_within_the_digits_that_it_states() -> None:
    heights, rates, frequency = sweep()
    load = drive(linear_damper(DAMPING), CAR, heights, DT, rates=rates).wheel_load
    on = (frequency >= MEASURED[0]) & (frequency <= MEASURED[1])
    assert static_load(CAR) == pytest.approx(STATIC, abs=1.5), "its g is 9.81 m/s2"
    assert 100 * load[on].min() / static_load(CAR) == pytest.approx(EUSAMA, abs=0.5)
    assert 100 * (static_load(CAR) - load[on].min()) / static_load(CAR) == pytest.approx(LARGEST, abs=0.5)
