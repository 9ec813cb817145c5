"""Functions and constants of `math` in C."""

# Functions of `math` that CPython takes from the C library as they are, by their number of arguments.
ONE = ("acos", "asin", "atan", "cos", "cosh", "exp", "expm1", "log", "log1p", "sin", "sinh", "tan", "tanh")
INEXACT = {name: 1 for name in ONE} | {"atan2": 2, "pow": 2}
MATH = INEXACT | {"fabs": 1, "sqrt": 1, "copysign": 2, "fmod": 2}
ROUNDED = ("ceil", "floor")
MATH_CONSTANTS = {"pi": "M_PI", "inf": "INFINITY", "nan": "NAN"}
