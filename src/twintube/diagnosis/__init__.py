"""Diagnosis: where the simulation differs from measured data, why, and what the extended model gains.

In the order of a diagnosis: `records` (what is compared), `measurement` (what belongs to it and not to the damper), `fits`
(the model and its candidates against the records), `selection` (which of them), `verdict` (what is said). engine.py runs all
of it, result.py is the answer, rules.py holds every threshold with its reason. What identification needs as well is in
twintube.fitting.
"""

from twintube.diagnosis.engine import diagnose
from twintube.diagnosis.result import Diagnosis, as_json

__all__ = ["Diagnosis", "as_json", "diagnose"]
