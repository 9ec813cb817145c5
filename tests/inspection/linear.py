"""The quarter car with a linear damper in closed form: what the benches must read where everything is linear."""

from dataclasses import replace

import numpy as np

from twintube.common.arrays import Array
from twintube.dampers import Damper, load
from twintube.dampers.curve import continued
from twintube.inspection.plate import Plate
from twintube.vehicle.cars import load_car
from twintube.vehicle.quarter_car import Car, static_load

SLOW = Plate(coast=120.0, hold=0.0)  # the frequency changes by 0.2 Hz per second


def linear_damper(c: float) -> Damper:
    """A damper without friction and gas whose F-v curve is a straight line of the slope c [N.s/m]."""
    points = continued([(0.5, 0.5 * c), (1.0, c)])
    v, F = [p[0] for p in points], [p[1] for p in points]
    return load("SA8").with_(v_re=v, F_re=F, v_co=v, F_co=F, F_FrS=0.0, F_0=0.0, c_gas=0.0)


def linear_car(**changes: float) -> Car:
    """The rear corner without friction, stops and preload."""
    return replace(load_car().corner(load("SA8"), **changes), friction=0.0, travel=10.0, F_rest=0.0)


def answer(car: Car, c: float, frequency: Array) -> Array:
    """Complex plate force per height of the plate [N/m]."""
    w = 2 * np.pi * frequency
    tyre = car.c_tyre + 1j * w * car.d_tyre
    suspension = car.c_body + 1j * w * (c * car.ratio**2 + car.d_links)
    body = suspension / (suspension - w**2 * car.m_body)  # body over wheel
    wheel = tyre / (tyre - w**2 * car.m_wheel + suspension * (1 - body))  # wheel over plate
    return np.asarray(tyre * (1 - wheel))


def phase(car: Car, c: float, frequency: Array) -> Array:
    """Degrees by which the force leads the height."""
    return np.asarray(np.degrees(np.angle(answer(car, c, frequency))))


def eusama(car: Car, c: float, plate: Plate) -> float:
    """100 times the smallest force over the static one, from the largest amplitude up to the top frequency."""
    swing = np.abs(answer(car, c, np.linspace(0.2, plate.top, 20_000))).max() * plate.amplitude
    return float(100 * max(0.0, 1 - swing / static_load(car)))


def ratios(car: Car, c: float) -> tuple[float, float]:
    """Lehr's damping ratios of body and wheel, from the eigenvalues."""
    d = c * car.ratio**2 + car.d_links
    matrix = np.array([
        [0, 0, 1, 0],
        [0, 0, 0, 1],
        [-car.c_body / car.m_body, car.c_body / car.m_body, -d / car.m_body, d / car.m_body],
        [car.c_body / car.m_wheel, -(car.c_body + car.c_tyre) / car.m_wheel, d / car.m_wheel, -(d + car.d_tyre) / car.m_wheel],
    ])  # fmt: skip
    roots = sorted((root for root in np.linalg.eigvals(matrix) if root.imag > 0), key=abs)
    return float(-roots[0].real / abs(roots[0])), float(-roots[1].real / abs(roots[1]))
