"""Horizontal tyre force: TMeasy (G. Rill), steady force over the combined slip and a first-order deflection.

The tyre is described at its nominal load and at twice that load: rise at no slip, largest force and its slip, sliding
force and its slip, for each direction. Source of the equations: G. Rill, "TMeasy - A Handling Tire Model based on a
three-dimensional slip approach", Proc. XXIII IAVSD (2013), and their form in Project Chrono's ChTMeasyTire.

In the kernel's own subset of Python: compiled with the damper.
"""

import math

from twintube.vehicle.full.car import Wheel, WheelMotion

LARGEST_LOAD = 3.5  # nominal loads, beyond which the load makes no further force
ROLLING = 0.1  # [m/s] below which slip relates to this speed in place of the wheel's


def over_load(nominal: float, twice: float, load: float) -> float:
    """A force [N] or rise at a `load` [nominal loads] from those at one and two nominal loads: a parabola through 0."""
    return load * (2.0 * nominal - 0.5 * twice - (nominal - 0.5 * twice) * load)


def between_loads(nominal: float, twice: float, load: float) -> float:
    """A slip at a `load` [nominal loads] from those at one and two nominal loads: a line."""
    return nominal + (twice - nominal) * (load - 1.0)


def combined(along: float, across: float) -> float:
    """Length of a vector; `math.hypot` rounds otherwise in Python than in C."""
    return math.sqrt(along * along + across * across)


def force_over_slip(slip: float, rise: float, s_most: float, most: float, s_slide: float, slide: float) -> float:
    """Force over slip [N] at a `slip` >= 0: the secant of the curve through its rise, largest force and sliding force."""
    rise = max(rise, 2.0 * most / s_most)  # else the curve would bend the wrong way
    if slip > s_slide:
        return slide / slip
    if slip < s_most:
        bend = rise * s_most / most - 2.0
        share = slip / s_most
        return rise / (1.0 + (share + bend) * share)
    # From the largest force on: a parabola, then another to the sliding force.
    curvature = (most / s_most) * (most / s_most) / (rise * s_most)
    change = s_most + (most - slide) / (curvature * (s_slide - s_most))
    if change <= s_slide:
        if slip <= change:
            force = most - curvature * (slip - s_most) * (slip - s_most)
        else:
            end = curvature * (change - s_most) / (s_slide - change)
            force = slide + end * (s_slide - slip) * (s_slide - slip)
        return force / slip
    share = (slip - s_most) / (s_slide - s_most)
    return (most - (most - slide) * share * share * (3.0 - 2.0 * share)) / slip


def roll_tyre(k: Wheel, w: WheelMotion, v_x: float, v_y: float, dt: float) -> None:
    """One step of `dt` [s] of the deflections; writes the forces `F_x`, `F_y` [N] and slips at the start of the step.

    `v_x`, `v_y` [m/s] are the speeds of the contact over the ground in the wheel's directions, rolling not counted; `w.load`
    is the vertical load [N] and `w.grip` the road's factor of all forces.
    """
    rolling = k.radius * (w.spin + 0.5 * w.d_spin)
    slide_x, slide_y, grip = v_x - rolling, v_y, w.grip
    speed = max(abs(rolling), ROLLING)
    load = min(w.load / k.F_nominal, LARGEST_LOAD)
    secant_x, secant_y = 0.0, 0.0
    w.slip_x = -slide_x / speed
    w.slip_y = -slide_y / speed
    if load > 0.0:
        rise_x = over_load(k.rise_x, k.rise_x2, load)
        rise_y = over_load(k.rise_y, k.rise_y2, load)
        most_x = over_load(k.most_x, k.most_x2, load)
        most_y = over_load(k.most_y, k.most_y2, load)
        s_x = between_loads(k.s_most_x, k.s_most_x2, load)
        s_y = between_loads(k.s_most_y, k.s_most_y2, load)
        # Slips that make equal shares of the largest forces, in both directions.
        unit_x = s_x / (s_x + s_y) + (most_x / rise_x) / (most_x / rise_x + most_y / rise_y)
        unit_y = s_y / (s_x + s_y) + (most_y / rise_y) / (most_x / rise_x + most_y / rise_y)
        n_x, n_y = w.slip_x / unit_x, w.slip_y / unit_y
        slip = combined(n_x, n_y)
        along, across = math.sqrt(0.5), math.sqrt(0.5)
        if slip > 1e-9:
            along, across = n_x / slip, n_y / slip
        rise = combined(rise_x * unit_x * along, rise_y * unit_y * across)
        s_most = combined(s_x / unit_x * along, s_y / unit_y * across)
        most = combined(most_x * along, most_y * across)
        s_slide = combined(
            between_loads(k.s_slide_x, k.s_slide_x2, load) / unit_x * along,
            between_loads(k.s_slide_y, k.s_slide_y2, load) / unit_y * across,
        )
        slide = combined(over_load(k.slide_x, k.slide_x2, load) * along, over_load(k.slide_y, k.slide_y2, load) * across)
        # Grip scales forces and slips, not the rise.
        secant = force_over_slip(slip, rise, grip * s_most, grip * most, grip * s_slide, grip * slide)
        secant_x, secant_y = secant / unit_x, secant / unit_y
    w.F_x = deflect(k.c_x, k.d_x, secant_x, slide_x, speed, w.e_x)
    w.F_y = deflect(k.c_y, k.d_y, secant_y, slide_y, speed, w.e_y)
    w.de_x = (w.F_x - k.c_x * w.e_x) / k.d_x
    w.de_y = (w.F_y - k.c_y * w.e_y) / k.d_y
    # Implicit midpoint of a linear relaxation.
    w.e_x += dt * w.de_x / (1.0 + 0.5 * dt * speed * k.c_x / (speed * k.d_x + secant_x))
    w.e_y += dt * w.de_y / (1.0 + 0.5 * dt * speed * k.c_y / (speed * k.d_y + secant_y))


def deflect(c: float, d: float, secant: float, slide: float, speed: float, e: float) -> float:
    """Force [N] of a tyre deflected by `e` [m], whose contact slides at `slide` [m/s]; at rest the secant's times the slip.

    The force of the deflection, c e + d de/dt, is that of the slip with the deflection's own speed in it.
    """
    rate = -(speed * c * e + secant * slide) / (speed * d + secant)
    return c * e + d * rate
