"""A quarter car: body, wheel, spring, tyre that can leave the road, bump and rebound stop; the damper force is an input.

Heights are relative to the rest position on a flat road with an intact damper; forces are those in addition to the weight.
All values are at the wheel: the damper's stroke is `ratio` times the wheel's, and `ratio` times its force acts at the wheel.
"""

from dataclasses import dataclass

from twintube.core.variables import var

GRAVITY = 9.80665  # [m/s2]
REACH = 0.2e-3  # [m] stroke of the wheel over which friction builds up, as in the front dampers: assumed


@dataclass(slots=True)
class Car:
    """One corner of a car; values are in `cars/`."""

    m_body: float = var("car", "m_b", "kg", "sprung mass of the corner", lower=20, upper=5000)
    m_wheel: float = var("car", "m_w", "kg", "unsprung mass of the corner", lower=5, upper=1000)
    c_body: float = var("car", "c_b", "N/m", "spring rate at the wheel", lower=1e3, upper=1e6)
    d_links: float = var("car", "d_b", "N.s/m", "damping of bushings and links at the wheel", lower=0, upper=5000)
    friction: float = var("car", "F_b", "N", "friction of strut, bushings and links at the wheel", lower=0, upper=1000)
    c_tyre: float = var("car", "c_t", "N/m", "tyre stiffness", lower=1e4, upper=5e6)
    d_tyre: float = var("car", "d_t", "N.s/m", "tyre damping while the tyre touches the road", lower=0, upper=5000)
    ratio: float = var("car", "i", "1", "motion ratio, stroke of the damper per stroke of the wheel", lower=0.2, upper=1.5)
    travel: float = var(
        "car", "", "m", "stroke of the wheel to each side at which the rubber stop touches", lower=0.005, upper=1
    )
    c_stop: float = var(
        "car", "", "N/m3", "stiffness of the rubber stops, over the cube of their compression", lower=0, upper=1e13
    )
    d_stop: float = var("car", "", "s/m", "damping of the stops relative to their stiffness", lower=0, upper=100)
    F_rest: float = var("car", "", "N", "damper force at rest that the spring preload compensates", default=0.0)


@dataclass(slots=True)
class Motion:
    """Heights [m] at one time, velocities [m/s] half a step earlier (leapfrog)."""

    z_body: float = var("motion", "z_b", "m", "height of the body", default=0.0)
    z_wheel: float = var("motion", "z_w", "m", "height of the wheel", default=0.0)
    v_body: float = var("motion", "v_b", "m/s", "vertical velocity of the body", default=0.0)
    v_wheel: float = var("motion", "v_w", "m/s", "vertical velocity of the wheel", default=0.0)
    dv_body: float = var("motion", "", "m/s", "last change of the body's velocity", default=0.0)
    dv_wheel: float = var("motion", "", "m/s", "last change of the wheel's velocity", default=0.0)
    friction: float = var("motion", "", "N", "friction between body and wheel at these heights", default=0.0)


def static_load(car: Car) -> float:
    """Wheel load at rest [N]."""
    return (car.m_body + car.m_wheel) * GRAVITY


def stop_force(stiffness: float, damping: float, compression: float, velocity: float) -> float:
    """Force [N] of a rubber stop under `compression` [m] at `velocity` [m/s], never a pull (Hunt and Crossley).

    `stiffness` [N/m3] and `damping` [s/m] are `c_stop` and `d_stop` of a corner.
    """
    if compression <= 0.0:
        return 0.0
    return max(0.0, stiffness * compression * compression * compression * (1.0 + damping * velocity))


def rub(most: float, force: float, way: float) -> float:
    """Friction [N] after a `way` [m] of the stroke, from the `force` [N] before it; `most` [N] is that of sliding.

    A spring of REACH in series with a slider: Dahl's friction with the exponent 0, exact over any way.
    """
    return max(-most, min(most, force + most * way / REACH))


def leapfrog_step(car: Car, m: Motion, road: float, road_velocity: float, force: float, push: float, dt: float) -> float:
    """One leapfrog step of `dt` [s] with the damper `force` [N] at its start; returns the wheel load [N].

    `push` [N] presses the body down: the load that braking moves to the front axle. The wheel load is never negative: the
    tyre does not pull on the road (height `road` [m], rate `road_velocity` [m/s]).
    """
    # Velocities at the start of the step: half a step after the stored ones.
    v_body = m.v_body + 0.5 * m.dv_body
    v_wheel = m.v_wheel + 0.5 * m.dv_wheel
    weight = (car.m_body + car.m_wheel) * GRAVITY
    load = weight + car.c_tyre * (road - m.z_wheel)
    if load > 0.0:
        load += car.d_tyre * (road_velocity - v_wheel)
    load = max(load, 0.0)
    stroke = m.z_body - m.z_wheel
    velocity = v_body - v_wheel
    pull = car.c_body * stroke + car.d_links * velocity + m.friction + car.ratio * (force - car.F_rest)
    stiff, damped = car.c_stop, car.d_stop
    pull += stop_force(stiff, damped, stroke - car.travel, velocity) - stop_force(
        stiff, damped, -stroke - car.travel, -velocity
    )
    m.dv_body = -dt * (pull + push) / car.m_body
    m.dv_wheel = dt * (pull + load - weight) / car.m_wheel
    m.v_body += m.dv_body
    m.v_wheel += m.dv_wheel
    m.z_body += dt * m.v_body
    m.z_wheel += dt * m.v_wheel
    m.friction = rub(car.friction, m.friction, dt * (m.v_body - m.v_wheel))
    return load


def damper_stroke(car: Car, m: Motion) -> float:
    """Stroke of the damper [m], positive in rebound."""
    return car.ratio * (m.z_body - m.z_wheel)


def damper_velocity(car: Car, m: Motion) -> float:
    """Mean velocity of the damper [m/s] over the last `leapfrog_step`."""
    return car.ratio * (m.v_body - m.v_wheel)
