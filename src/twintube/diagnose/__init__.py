"""Diagnosis: where the simulation differs from measured data, why, and what the extended model gains.

prepare.py (records), fit.py (least squares), candidates.py (effects and faults), select.py (which of them), result.py.
"""

from twintube.diagnose.engine import diagnose
from twintube.diagnose.result import Diagnosis, as_json

__all__ = ["Diagnosis", "as_json", "diagnose"]
