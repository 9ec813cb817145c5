"""The F-v curve in a parameter file: pairs of velocity and force in units of their own."""

from typing import Any

from twintube.common.words import shown
from twintube.core import messages
from twintube.core.checks import VELOCITY
from twintube.core.variables import FV_POINTS
from twintube.dampers.quantity import quantity

BRANCHES = {"rebound": ("v_re", "F_re"), "compression": ("v_co", "F_co")}
CURVE_UNITS = {"velocity": "m/s", "force": "N"}
Point = tuple[float, float]  # velocity [m/s], force [N]


def read_curve(table: dict[str, Any], values: dict[str, Any]) -> list[str]:
    """Put the F-v curve into `values`; messages about what is wrong with it."""
    texts: list[str] = []
    try:
        v_unit, F_unit = (scale(table.get(f"{name}_unit", unit), unit) for name, unit in CURVE_UNITS.items())
    except ValueError as error:
        return [f"fv: {error}"]
    for branch, (v_name, F_name) in BRANCHES.items():
        rows = table.get(branch)
        if rows is None:
            texts.append(f"fv.{branch} is missing")
            continue
        if not isinstance(rows, list) or not all(is_pair(row) for row in rows):
            texts.append(f"fv.{branch}: must be a list of [velocity, force] pairs of numbers")
            continue
        points = [(v * v_unit, F * F_unit) for v, F in rows]
        origin = points[:1] == [(0.0, 0.0)]  # the curve passes through it in any case
        if not 2 <= len(points) <= FV_POINTS + origin:
            texts.append(f"fv.{branch}: {len(points)} points, must be from 2 to {FV_POINTS}")
            continue
        texts += misplaced(branch, points, table.get("velocity_unit", CURVE_UNITS["velocity"]))
        points = continued(points[1:] if origin else points)
        values[v_name] = [v for v, _ in points]
        values[F_name] = [F for _, F in points]
    return texts


def is_pair(row: Any) -> bool:
    """Whether a row is a list of two numbers."""
    return isinstance(row, list) and len(row) == 2 and all(type(x) in (int, float) for x in row)


def misplaced(branch: str, points: list[Point], unit: str) -> list[str]:
    """Messages about a force at rest, a sign, and the first velocity that no simulation reaches, which its unit explains."""
    texts = []
    v, F = points[0]
    if v == 0.0 and F != 0.0:
        texts.append(
            f"fv.{branch}: point 1 = [0, {F:g} N]: at velocity 0 the force must be 0 N; such a point may be left out"
        )
    signed = next((number for number, (v, F) in enumerate(points, start=1) if v < 0.0 or F < 0.0), None)
    if signed is not None:
        v, F = points[signed - 1]
        texts.append(
            f"fv.{branch}: point {signed} = [{v:g} m/s, {F:g} N]: must not be negative, give both branches without sign"
        )
    for number, (v, _) in enumerate(points, start=1):
        if v > VELOCITY["upper"]:
            text = messages.outside(f"velocity {number}", v, 0.0, VELOCITY["upper"], CURVE_UNITS["velocity"])
            texts.append(
                f"fv.{branch}: {text}; check velocity_unit = {shown(unit)}, and that the pairs are [velocity, force]"
            )
            break
    return texts


def as_listed(text: str, table: dict[str, Any]) -> str:
    """A message about a point of the kernel's curve, which lacks a point [0, 0] of the file."""
    branch = text.removeprefix("fv.").partition(":")[0]
    rows = table.get(branch) if branch in BRANCHES else None
    return f"{text} (counted without [0, 0])" if rows and not any(rows[0]) else text


def scale(unit: Any, si: str) -> float:
    """What one `unit` is in the SI unit `si`; raises ValueError."""
    if not isinstance(unit, str):
        raise ValueError(f"{shown(unit)} is not a unit like {si!r}")
    return quantity(f"1 {unit}", si)


def continued(points: list[Point]) -> list[Point]:
    """The points of a branch, filled up to FV_POINTS along its last segment, from zero if it is one: the same curve."""
    points = list(points)
    before = points[-2] if len(points) > 1 else (0.0, 0.0)
    step = (points[-1][0] - before[0], points[-1][1] - before[1])
    while len(points) < FV_POINTS:
        points.append((points[-1][0] + step[0], points[-1][1] + step[1]))
    return points


def given(points: list[Point]) -> list[Point]:
    """The fewest first points of a branch of which the others are the continuation."""
    return next((points[:n] for n in range(2, len(points)) if continued(points[:n]) == points), points)
