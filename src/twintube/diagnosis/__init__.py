"""Diagnosis: where the simulation differs from measured data, why, and what the extended model gains.

record.py and prepare.py (records), noise.py and edges.py (their errors), faults.py (sign, unit, smoothing), signature.py and
line.py (causes outside the catalogue), fit.py (least squares), zeros.py (zeros of the load cell), candidates.py (effects and
faults), select.py, choice.py and judge.py (which of them), verdict.py (the decision and its sentence), gains.py (errors and
gains), where.py (maps), answer.py, result.py (the answer), engine.py (all of it). rules.py holds every threshold with its
reason. What identification needs as well is in twintube.fitting.
"""

from twintube.diagnosis.engine import diagnose
from twintube.diagnosis.result import Diagnosis, as_json

__all__ = ["Diagnosis", "as_json", "diagnose"]
