"""A quarter car: body, wheel, spring, tyre that can leave the road, bump and rebound stop; the damper comes from outside.

Heights count from the rest position on a flat road with an intact damper; forces are those beyond the weight.
"""

from dataclasses import dataclass

from twintube.variables import var

GRAVITY = 9.80665  # [m/s2]


@dataclass(slots=True)
class Car:
    """One corner of the car. The values of `PASSAT_REAR` and `PASSAT_FRONT` are assumed."""

    m_body: float = var("car", "m_b", "kg", "sprung mass of the corner")
    m_wheel: float = var("car", "m_w", "kg", "unsprung mass of the corner")
    c_body: float = var("car", "c_b", "N/m", "spring rate at the wheel")
    d_links: float = var("car", "d_b", "N.s/m", "damping of bushings and links at the wheel")
    c_tyre: float = var("car", "c_t", "N/m", "tyre stiffness")
    d_tyre: float = var("car", "d_t", "N.s/m", "tyre damping while it touches the road")
    travel: float = var("car", "", "m", "stroke to each side at which the rubber stop touches")
    c_stop: float = var("car", "", "N/m3", "stiffness of the rubber stops, over the cube of their compression")
    d_stop: float = var("car", "", "s/m", "damping of the stops relative to their stiffness")
    F_rest: float = var("car", "", "N", "damper force at rest for which the spring is set")


@dataclass(slots=True)
class Motion:
    """Heights [m] at one time, velocities [m/s] half a step earlier (leapfrog)."""

    z_body: float = var("motion", "z_b", "m", "height of the body", default=0.0)
    z_wheel: float = var("motion", "z_w", "m", "height of the wheel", default=0.0)
    v_body: float = var("motion", "v_b", "m/s", "vertical velocity of the body", default=0.0)
    v_wheel: float = var("motion", "v_w", "m/s", "vertical velocity of the wheel", default=0.0)
    dv_body: float = var("motion", "", "m/s", "last change of the body's velocity", default=0.0)
    dv_wheel: float = var("motion", "", "m/s", "last change of the wheel's velocity", default=0.0)


# Assumed: a corner of a car of the Passat B8 class with two persons (about 1650 kg, 55 % front); body near 1.3 Hz, wheel
# near 12 Hz. Dampers act at the wheel, ratio 1. Without a damper, bushings and links leave a damping ratio of 0.08.
PASSAT = {"c_tyre": 230e3, "d_tyre": 200.0, "d_links": 450.0, "travel": 0.055, "c_stop": 1e9, "d_stop": 1.0}
PASSAT_FRONT = PASSAT | {"m_body": 405.0, "m_wheel": 46.0, "c_body": 26e3}
PASSAT_REAR = PASSAT | {"m_body": 330.0, "m_wheel": 42.0, "c_body": 23e3}


def static_load(car: Car) -> float:
    """Wheel load at rest [N]."""
    return (car.m_body + car.m_wheel) * GRAVITY


def stop_force(car: Car, over: float, velocity: float) -> float:
    """Force of a rubber stop [N] pressed by `over` [m] at `velocity` [m/s]; it pushes only (Hunt and Crossley)."""
    if over <= 0.0:
        return 0.0
    return max(0.0, car.c_stop * over * over * over * (1.0 + car.d_stop * velocity))


def kick(car: Car, m: Motion, road: float, road_velocity: float, force: float, push: float, dt: float) -> float:
    """One leapfrog step of `dt` [s] with the damper `force` [N] of this moment; returns the wheel load [N].

    `push` [N] presses the body down: the load that braking moves to the front axle.

    The wheel load is never negative: the tyre does not pull on the road (`road` [m], rising at `road_velocity` [m/s]).
    """
    # Velocities of this moment: half a step on from the stored ones.
    v_body = m.v_body + 0.5 * m.dv_body
    v_wheel = m.v_wheel + 0.5 * m.dv_wheel
    weight = (car.m_body + car.m_wheel) * GRAVITY
    load = weight + car.c_tyre * (road - m.z_wheel)
    if load > 0.0:
        load += car.d_tyre * (road_velocity - v_wheel)
    load = max(load, 0.0)
    stroke = m.z_body - m.z_wheel
    velocity = v_body - v_wheel
    pull = car.c_body * stroke + car.d_links * velocity + force - car.F_rest
    pull += stop_force(car, stroke - car.travel, velocity) - stop_force(car, -stroke - car.travel, -velocity)
    m.dv_body = -dt * (pull + push) / car.m_body
    m.dv_wheel = dt * (pull + load - weight) / car.m_wheel
    m.v_body += m.dv_body
    m.v_wheel += m.dv_wheel
    m.z_body += dt * m.v_body
    m.z_wheel += dt * m.v_wheel
    return load
