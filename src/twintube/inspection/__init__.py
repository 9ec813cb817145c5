"""Inspection benches for one corner of a car: what plate testers, a push-down and a slow bump say about a damper.

`inspected` gives the figures over oil levels, `study` the share that is detected over the scatter of cars and testers.
"""

from twintube.inspection.benches import Setting, read
from twintube.inspection.corner import INTACT, LEVELS, Condition, Entry, conditions, inspected
from twintube.inspection.detection import Detection, first_seen, study
from twintube.inspection.methods import METHODS, USUAL, Method, method
from twintube.inspection.plate import Plate
from twintube.inspection.scatter import RANGES

__all__ = [
    "INTACT",
    "LEVELS",
    "METHODS",
    "RANGES",
    "USUAL",
    "Condition",
    "Detection",
    "Entry",
    "Method",
    "Plate",
    "Setting",
    "conditions",
    "first_seen",
    "inspected",
    "method",
    "read",
    "study",
]
