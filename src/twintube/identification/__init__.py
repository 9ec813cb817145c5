"""Identification: parameters of the degradation model from measured records (Section 3.2, equations 42 and 43).

    identify            a dataset folder in, the four steps, validation on all records
    identify_dataset    the steps on a dataset that is read already
    identify_damper     the steps on records
    Objective, minimise equations 42 and 43 for whole swarms, and the optimisers

First step: intact.py, sines.py, pressure.py; third and fourth: objective.py, optimise.py, together.py (the default); what is
known of the result: uncertainty.py, intact_intervals.py, validation.py, remarks.py, figures.py, judgement.py. What diagnosis
needs as well is in twintube.fitting.
"""

from twintube.fitting.harmonic import Harmonic
from twintube.fitting.oscillations import harmonic
from twintube.identification.dataset import Result, identify, identify_dataset, require_known
from twintube.identification.figures import headline, summary, table
from twintube.identification.judgement import judgement, next_step
from twintube.identification.objective import Objective
from twintube.identification.optimise import DEFAULT, METHODS, Best, minimise
from twintube.identification.workflow import PAPER, QUICK, Budget, Identification, identify_damper

__all__ = [
    "DEFAULT",
    "METHODS",
    "PAPER",
    "QUICK",
    "Best",
    "Budget",
    "Harmonic",
    "Identification",
    "Objective",
    "Result",
    "harmonic",
    "headline",
    "identify",
    "identify_damper",
    "identify_dataset",
    "judgement",
    "minimise",
    "next_step",
    "require_known",
    "summary",
    "table",
]
