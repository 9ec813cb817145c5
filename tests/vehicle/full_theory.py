"""Textbook models that the whole car must agree with: seven degrees of freedom in the vertical, a bicycle in the plane.

Written from Gillespie, "Fundamentals of Vehicle Dynamics" (ch. 5 and 6), as matrices, apart from the car's own equations.
"""

import numpy as np
from scipy import signal

from twintube.common.arrays import Array
from twintube.vehicle.full.run import FullCar


def vertical(car: FullCar, c_dampers: Array) -> tuple[Array, Array, Array, Array]:
    """Mass, damping and stiffness (7, 7) of heave, pitch (nose down), roll (left up) and the wheels, and input (7, 4).

    Without roll centres and support of the links; `c_dampers` (4,) [N.s/m] at the wheels.
    """
    body, wheels = car.body, car.wheels
    corner = np.array([[1.0, -w.x, w.y, *(-np.eye(4)[i])] for i, w in enumerate(wheels)])  # strokes of the wheels
    springs = np.diag([w.c_body for w in wheels])
    K = corner.T @ springs @ corner
    C = corner.T @ np.diag([w.d_links + c for w, c in zip(wheels, c_dampers, strict=True)]) @ corner
    for left, right in ((0, 1), (2, 3)):
        twist = corner[left] - corner[right]
        K += wheels[left].c_bar * np.outer(twist, twist)
    for i, w in enumerate(wheels):
        K[3 + i, 3 + i] += w.c_tyre
        C[3 + i, 3 + i] += w.d_tyre
    # The body's weight rolls out with it.
    K[2, 2] -= sum((w.weight - w.m_wheel * 9.80665) * body.height for w in wheels)
    # The wheels stay on their tracks as the body rolls and pitches above them about the common centre of gravity.
    arms = np.array([[body.height - w.radius, body.height] for w in wheels])
    masses = np.array([w.m_wheel for w in wheels])
    carried = masses @ arms**2 - (masses @ arms) ** 2 / car.mass
    M = np.diag([body.mass, body.I_pitch + carried[0], body.I_roll + carried[1], *masses])
    inputs = np.vstack([np.zeros((3, 4)), np.diag([w.c_tyre for w in wheels])])
    return M, C, K, inputs


def wheel_loads(car: FullCar, c_dampers: Array, heights: Array, rates: Array, dt: float) -> Array:
    """Dynamic wheel loads (n, 4) [N] over road `heights` and `rates` (n, 4)."""
    M, C, K, _ = vertical(car, c_dampers)
    inverse = np.linalg.inv(M)
    A = np.block([[np.zeros((7, 7)), np.eye(7)], [-inverse @ K, -inverse @ C]])
    c, d = np.diag([w.c_tyre for w in car.wheels]), np.diag([w.d_tyre for w in car.wheels])
    B = np.zeros((14, 8))
    B[10:, :4], B[10:, 4:] = inverse[3:, 3:] @ c, inverse[3:, 3:] @ d
    read = np.zeros((4, 14))
    read[:, 3:7], read[:, 10:] = -c, -d
    _, loads, _ = signal.lsim((A, B, read, np.hstack([c, d])), np.hstack([heights, rates]), np.arange(len(heights)) * dt)
    return np.asarray(loads)


def modes(car: FullCar) -> tuple[Array, Array]:
    """Undamped eigenfrequencies (7,) [Hz] and mode shapes (7, 7), in columns."""
    M, _, K, _ = vertical(car, np.zeros(4))
    squares, shapes = np.linalg.eig(np.linalg.inv(M) @ K)
    order = np.argsort(squares.real)
    return np.sqrt(squares.real[order]) / (2 * np.pi), shapes.real[:, order]


def yaw_gain(car: FullCar, stiffness: Array, speed: float) -> float:
    """Steady yaw rate per steer angle [1/s] of the bicycle with cornering `stiffness` (2,) [N/rad] of the axles."""
    mass, a, b = car.mass, *axles(car)
    gradient = mass * (b / stiffness[0] - a / stiffness[1]) / (a + b)
    return float(speed / (a + b + gradient * speed**2))


def axles(car: FullCar) -> tuple[float, float]:
    """Distances [m] of the axles from the centre of gravity of the whole car."""
    weight = [w.weight for w in car.wheels]
    base = car.body.wheelbase
    front = (weight[0] + weight[1]) / sum(weight)
    return base * (1 - front), base * front
