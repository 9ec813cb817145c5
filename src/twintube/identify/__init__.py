"""Identification: parameters of the degradation model from harmonic records (Section 3.2, equations 42 and 43)."""

from twintube.identify.objective import Harmonic, Objective
from twintube.identify.optimise import METHODS, Best, minimise

__all__ = ["METHODS", "Best", "Harmonic", "Objective", "minimise"]
