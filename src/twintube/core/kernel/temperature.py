"""What a temperature does to oil, friction and gas: beyond the paper, which leaves it out.

The fluid force is 1 at T_curve, where the F-v curve holds, and goes through a colder and a hotter point of a bench. With
x = T - T_curve, x over the logarithm of the factor is a straight line: the law of Vogel, Fulcher and Tammann for a
viscosity, flat in the warm and steep in the cold. Seals run on a film of that oil: friction goes with a power of the factor.
The gas is enclosed, its absolute pressure goes with T.
"""

import math

from twintube.core.variables import Parameters, State

ROUNDING = 1e-6  # [K] of degrees Celsius as kelvins


def thickness(p: Parameters, T: float) -> float:
    """Logarithm of the fluid force at the temperature `T` [K] over that at T_curve; beyond the two points as at them."""
    x = max(p.T_cold, min(p.T_hot, T)) - p.T_curve
    cold = p.T_cold - p.T_curve
    hot = p.T_hot - p.T_curve
    thick = math.log(p.k_cold)
    thin = math.log(p.k_hot)
    # The straight line of x over the logarithm, free of 0/0: a point with the factor 1 says that there is no law.
    line = cold * thin * (hot - x) + hot * thick * (x - cold)
    return x * thick * thin * (hot - cold) / line if line > 0.0 else 0.0


def temper(p: Parameters, s: State, T: float) -> None:
    """Put the temperature `T` [K] of oil, seals and gas in force."""
    law = thickness(p, T)
    s.T = T
    s.k_T = math.exp(law)
    s.k_T_Fr = math.exp(p.friction_power * law)
    s.k_T_gas = T / p.T_curve


def within_law(p: Parameters, T: float) -> int:
    """1 where a temperature [K] lies between the points of the law, else 0."""
    return 1 if p.T_cold - ROUNDING <= T and p.T_hot + ROUNDING >= T else 0
