"""Units of mass on a force: scales and many load cells show kg. They are a force only where the user says so."""

import math

from twintube.dampers.quantity import parsed, quantity
from twintube.data.convert.units import unit_of

G = 9.80665  # standard gravity [m/s2]
WEIGHTS = {"kg": "kgf", "g": "gf"}  # `lb` is read as lbf, see units.py


def is_mass(unit: str) -> bool:
    """Whether a text is a unit of mass, and not the usual short form of one of force."""
    if unit_of(unit):
        return False
    try:
        return dict(parsed(unit).dimensionality) == {"[mass]": 1}
    except ValueError:
        return False


def is_weight_of(force: str, mass: str) -> bool:
    """Whether a unit of force is the weight of a unit of mass: kgf of kg."""
    try:
        newtons, kilograms = quantity(f"1 {unit_of(force) or force}", "N"), quantity(f"1 {mass}", "kg")
    except ValueError:
        return False
    return math.isclose(newtons, G * kilograms, rel_tol=1e-6)


def weight_advice(mass: str, column: str) -> str:
    """What to write where a mass stands for its weight; `column` is its name in the file, as TOML."""
    if mass in WEIGHTS:
        return f'if its weight is meant, write "force [{WEIGHTS[mass]}]" = {column}'
    scale = f"{G * quantity(f'1 {mass}', 'kg'):g} N/{mass}"
    return f'if its weight is meant, set channels = {{force = {{column = {column}, scale = "{scale}"}}}}'
