"""A public quarter car on a suspension tester, reproduced with its own parameters and its own sweep: figure against figure.

github.com/0wojtaszek0/Modele-inzynieryjne, a program after EGEA SPECSUS2018 whose documents state parameters and results of
its linear quarter car and of a single mass. It is no paper. Its force has the other sign and its tyre pulls; its phase is the
angle by which that force lags behind the height, 180 degrees less the lead of the force used here for the quarter car, and
that lead itself for the single mass.

Its first phase of the quarter car, 88.9 degrees, is not compared: the middle between two crossings of the static force is
the largest or the smallest force according to which crossing comes first, and it says itself that the figure stays near 90
whatever the damping.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from tests.inspection.linear import linear_car, linear_damper
from twintube.common.arrays import Array
from twintube.inspection.benches import DT as BENCH_DT
from twintube.inspection.benches import on_plate, plate_motion
from twintube.inspection.figures import measured_cycles
from twintube.inspection.plate import Plate
from twintube.vehicle.drive import drive
from twintube.vehicle.quarter_car import static_load

CAR = replace(
    linear_car(), m_body=346.0, m_wheel=36.0, c_body=25570.0, c_tyre=253161.0, d_tyre=150.0, d_links=0.0, ratio=1.0
)
DAMPING, AMPLITUDE, DT = 1474.0, 3e-3, 5e-4  # [N.s/m], [m], [s]
STATIC, EUSAMA, LARGEST = 3747.0, 57.0, 43.0  # [N], [%], [%] as stated there
MEASURED = (6.0, 18.0)  # [Hz]
WEAK_AND_STRONG = {100.0: 3.0, 3000.0: 97.0}  # [N.s/m]: [deg], as stated there
SINGLE_MASS = {400.0: 6.05, 800.0: 12.05, 1200.0: 17.97, 1474.0: 21.95, 2000.0: 29.38, 3000.0: 42.54}  # as stated there


def sweep(amplitude: float = AMPLITUDE) -> tuple[Array, Array, Array]:
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
        heights[i:end], rates[i:end] = amplitude * np.cos(angle), -amplitude * 2 * np.pi * f * np.sin(angle)
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


@pytest.mark.parametrize(("damping", "stated"), WEAK_AND_STRONG.items())
def test_its_smallest_phase_is_reproduced_within_the_digits_that_it_states(damping: float, stated: float) -> None:
    heights, rates, frequency = sweep(amplitude=3e-5)  # the wheel stays on the plate, as its linear tyre does
    force = drive(linear_damper(damping), CAR, heights, DT, rates=rates).wheel_load - static_load(CAR)
    begins = np.flatnonzero(np.diff(frequency) != 0.0) + 1
    begins = begins[begins > np.flatnonzero(frequency == 25.0)[-1]]  # the measured way down
    phases = []
    for i, j in pairwise(begins):
        if MEASURED[0] <= frequency[i] <= MEASURED[1]:
            turn = np.exp(1j * 2 * np.pi * frequency[i] * DT * np.arange(j - i))
            lead = np.angle(np.mean(force[i:j] * turn.conj()) / np.mean(heights[i:j] * turn.conj()), deg=True)
            phases.append((180.0 - lead) % 360.0)
    assert min(phases) == pytest.approx(stated, abs=0.5)


@pytest.mark.parametrize(("damping", "stated"), SINGLE_MASS.items())
def test_the_phase_of_its_single_mass_is_reproduced(damping: float, stated: float) -> None:
    """382 kg on the tyre: the suspension is locked, and the tyre has the damping."""
    car = replace(CAR, d_tyre=damping)
    car.c_body = 5e7
    run = plate_motion(Plate(amplitude=1e-4, coast=600.0, hold=0.0), BENCH_DT)
    found = measured_cycles(run, on_plate(linear_damper(DAMPING), car, run).wheel_load)
    used = (found.frequency >= MEASURED[0]) & (found.frequency <= MEASURED[1])
    assert found.phase[used].min() == pytest.approx(stated, rel=0.01), "as the benches agree with transfer functions"
