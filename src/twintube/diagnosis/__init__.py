"""Diagnosis: where the simulation differs from measured data, why, and what the extended model gains.

prepare.py (records), faults.py (sign, unit, smoothing), signature.py and line.py (causes outside the catalogue), fit.py
(least squares), candidates.py (effects and faults), select.py (which of them), answer.py (verdict, gain), where.py (maps),
result.py, engine.py (all of it).
"""

from twintube.diagnosis.engine import diagnose
from twintube.diagnosis.result import Diagnosis, as_json

__all__ = ["Diagnosis", "as_json", "diagnose"]
