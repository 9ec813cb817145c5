"""Checks of a parameter set: bounds from the table, and what must hold between the parameters.

Standard library only: the FMU makes the same checks. Every message names the quantity, its value and the allowed range.
"""

import math
from dataclasses import fields

from twintube.core.effects import Parameters
from twintube.core.kernel import prepare
from twintube.core.variables import FV_POINTS, Derived, Inputs, blank, fmi_name

# The piston may come this close [m] to the ends of its chambers.
CLEARANCE = 1e-6
VELOCITY = {item.name: item.metadata for item in fields(Inputs)}["velocity"]


def outside(name: str, value: float, lower: float | None, upper: float | None, unit: str) -> str:
    """A message if `value` is not finite or not within [lower, upper], else an empty string."""
    low = -math.inf if lower is None else lower
    high = math.inf if upper is None else upper
    if math.isfinite(value) and low <= value <= high:
        return ""
    return f"{name} = {value:g} {unit}: must be a number from {low:g} to {high:g} {unit}"


def out_of_bounds(p: Parameters) -> list[str]:
    """Messages for every parameter beyond its bounds in the table."""
    found = []
    for item in fields(p):
        value = getattr(p, item.name)
        meta = item.metadata
        values = value if meta["size"] > 1 else [value]
        for number in values:
            message = outside(fmi_name(item), number, meta["lower"], meta["upper"], meta["unit"])
            if message:
                found.append(message)
                break
    return found


def not_monotone(p: Parameters) -> list[str]:
    """Messages where a branch of the F-v curve does not rise with the velocity."""
    found = []
    for branch, v, F in (("rebound", p.v_re, p.F_re), ("compression", p.v_co, p.F_co)):
        if v[0] <= 0.0:
            found.append(f"fv.{branch}: velocity 1 = {v[0]:g} m/s must be above 0")
        for i in range(1, FV_POINTS):
            if v[i] <= v[i - 1]:
                found.append(f"fv.{branch}: velocity {i + 1} = {v[i]:g} m/s must be above velocity {i} = {v[i - 1]:g} m/s")
                break
            if F[i] < F[i - 1]:
                found.append(
                    f"fv.{branch}: not monotone, force {i + 1} = {F[i]:g} N must be at least force {i} = {F[i - 1]:g} N"
                )
                break
    return found


def inconsistent(p: Parameters) -> list[str]:
    """Messages where the dimensions do not fit into each other or the oil does not fit into the damper."""
    found = []
    for thin, wide in (("D_PR", "D_li"), ("D_li", "D_la"), ("D_la", "D_a")):
        a, b = getattr(p, thin), getattr(p, wide)
        if a >= b:
            found.append(f"geometry.{thin} = {a:g} m: must be below geometry.{wide} = {b:g} m")
    if p.dead_length >= p.h_l:
        found.append(f"geometry.dead_length = {p.dead_length:g} m: must be below geometry.h_l = {p.h_l:g} m")
    if found:
        return found
    d = blank(Derived)
    prepare(p, d)
    if p.stroke_max >= d.half_length:
        found.append(
            f"geometry.stroke_max = {p.stroke_max:g} m: must be below {d.half_length:g} m, half of h_l - dead_length"
        )
        return found
    stretched = d.A_1 * (d.half_length - p.stroke_max) + d.A_2 * (d.half_length + p.stroke_max)
    if p.V_oil < stretched:
        found.append(
            f"geometry.V_oil = {p.V_oil:g} m3: must be at least {stretched:g} m3, or the intact damper draws gas in rebound"
        )
    pushed = d.A_1 * (d.half_length + p.stroke_max) + d.A_2 * (d.half_length - p.stroke_max) + d.V_reserve
    if p.V_oil > pushed:
        found.append(f"geometry.V_oil = {p.V_oil:g} m3: must be at most {pushed:g} m3, the room at full compression")
    return found


def problems(p: Parameters) -> list[str]:
    """All messages about a parameter set; an empty list if it is admissible."""
    return not_monotone(p) + out_of_bounds(p) or inconsistent(p)


def stroke_limit(d: Derived) -> float:
    """Largest stroke [m] to each side that keeps the piston inside the tube."""
    return d.half_length - CLEARANCE


def tube_limit(p: Parameters) -> float:
    """The stroke limit [m] of a parameter set."""
    d = blank(Derived)
    prepare(p, d)
    return stroke_limit(d)


def bad_input(stroke: float, velocity: float, limit: float) -> str:
    """A message if the piston would leave the tube or an input is no number in its range, else an empty string."""
    return outside("stroke", stroke, -limit, limit, "m") or outside(
        "velocity", velocity, VELOCITY["lower"], VELOCITY["upper"], "m/s"
    )
