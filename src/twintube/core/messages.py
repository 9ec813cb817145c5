"""What the checks say: the one table of texts, for the interpreter, the Python FMU and the native FMU.

A text is a template of C's printf, of which only %s, %d, %g are used: Python's `%` reads it alike. `fmu/sources.py` writes
the texts as macros of C.
"""

# Arguments: name, value, unit, lower bound, upper bound, unit; the units come from `suffix`.
OUTSIDE = "%s = %g%s: must be a number from %g to %g%s"

# By the numbers of `consistency.py`. Arguments: value, limit; before them the number of the point in the F-v curve.
RULES = {
    1: "fv.rebound: velocity %d = %g m/s must be above %g m/s",
    2: "fv.rebound: velocity %d = %g m/s must be above the velocity before it, %g m/s",
    3: "fv.rebound: not monotone, force %d = %g N must be at least the force before it, %g N",
    4: "fv.compression: velocity %d = %g m/s must be above %g m/s",
    5: "fv.compression: velocity %d = %g m/s must be above the velocity before it, %g m/s",
    6: "fv.compression: not monotone, force %d = %g N must be at least the force before it, %g N",
    7: "geometry.D_PR = %g m: must be below geometry.D_li = %g m",
    8: "geometry.D_li = %g m: must be below geometry.D_la = %g m",
    9: "geometry.D_la = %g m: must be below geometry.D_a = %g m",
    10: "geometry.dead_length = %g m: must be below geometry.h_l = %g m",
    11: "geometry.stroke_max = %g m: must be below %g m, half of h_l - dead_length",
    12: "geometry.V_oil = %g m3: must be at least %g m3, or the intact damper draws gas in rebound",
    13: "geometry.V_oil = %g m3: must be at most %g m3, the room at full compression",
    14: "gas_spring.c_gas = %g N/m: must be below %g N/m, or a polytropic gas has no room left at full compression",
    15: "gas_spring.c_gas_lost = %g N/m: must be below %g N/m, or a polytropic gas has no room left at full compression",
    16: "temperature.T_cold = %g K: must be below temperature.T_curve = %g K",
    17: "temperature.T_hot = %g K: must be above temperature.T_curve = %g K",
}

# What both kinds of FMU say.
NO_VARIABLE = "%s: no %s variable has the value reference %d"
NOT_SETTABLE = "%s: an output cannot be set"
FIXED = "%s: fixed, cannot change after the initialization"
NOT_NOW = "%s: not allowed %s"
MISTIMED = "communication point = %.10g s: the last step ended at %.10g s"
BEYOND_STOP = "communication step = %g s at %.10g s: beyond the stop time %.10g s"
NO_START = "the start could not be computed; please report this parameter set"
NO_STEP = "time %g s: the step could not be computed; please report this parameter set"
# Arguments: time, stroke and its way, velocity and the way that it led, the way of their difference, velocity.
PARTED = (
    "time %g s: %s went %g m, %s led %g m in the same time, and the two parted by %g m; "
    "check sign, unit and connection of %s"
)
# Arguments: temperature, ends of the law; before it stands where.
BEYOND_LAW = (
    "temperature = %g K: the law of this damper holds from %g to %g K; "
    "beyond it fluid force and friction are those of its end"
)
# Arguments: time, step, longest safe step.
LONG_STEP = (
    "time %g s: communication step = %g s: with a wheel in the loop at most %g s are safe; in longer steps the force comes "
    "late and an intact damper looks worn. A motion that does not answer to the force, as one from a record, may have them"
)
NO_STATE = "%s: the bytes are not an FMU state"
OTHER_STATE = "%s: the state belongs to another FMU"
DAMAGED_STATE = "%s: the state is damaged"

# Where an instance stands, by the number of its mode.
MODES = ("before the initialization", "in the initialization mode", "between the steps", "after the end")


def suffix(unit: str) -> str:
    """The unit as it follows a number: nothing where there is none."""
    return "" if unit in ("", "1") else f" {unit}"


def outside(name: str, value: float, lower: float, upper: float, unit: str) -> str:
    """The text for a value beyond its bounds."""
    return OUTSIDE % (name, value, suffix(unit), lower, upper, suffix(unit))


def parted(time: float, way_stroke: float, way_led: float, way_apart: float) -> str:
    """The text for a velocity that does not belong to its stroke, by the ways of `agreement.py`."""
    return PARTED % (time, "stroke", way_stroke, "velocity", way_led, way_apart, "velocity")


def broken_rule(rule: int, point: int, value: float, limit: float) -> str:
    """The text for a rule of `consistency.py`; `point` is 0 for those that are not about the F-v curve."""
    text = RULES[rule]
    return text % (point, value, limit) if point > 0 else text % (value, limit)
