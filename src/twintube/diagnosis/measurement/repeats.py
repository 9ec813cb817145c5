"""Whether an error comes again in every oscillation: what does not is noise, however little of it was read.

Few oscillations of noise with memory tell its size badly; products of the errors of different oscillations do not need it.
"""

import numpy as np

from twintube.arrays import Array
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.records.noise import likes
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES


def only_noise(problem: Problem) -> bool:
    """Whether errors of the model as given, little more than noise, do not repeat in the records with like oscillations.

    These must be half of all.
    """
    errors = problem.residual({})
    if float(errors @ errors) > RULES.odd_right * problem.counts.sum():
        return False
    pairs = zip(problem.records, np.split(errors, problem.starts[1:-1]), strict=True)
    shares = np.array([repeating(record, error) for record, error in pairs])
    known = np.isfinite(shares)
    counts = problem.counts[known]
    if counts.sum() < RULES.half * problem.counts.sum():
        return False
    return bool(shares[known] @ counts <= (RULES.quiet**2 - 1.0) * counts.sum())


def repeating(record: PreparedRecord, error: Array) -> float:
    """Mean product of weighted errors (n,) of different oscillations at the same phase; not a number where none is alike."""
    products = []
    for numbers in likes(record):
        cycles = [np.flatnonzero(record.cycle == i) for i in numbers]
        usual = int(np.median([len(own) for own in cycles]))
        same = np.array([error[own] for own in cycles if len(own) == usual and record.judged[own].all()])
        if len(same) > 1:
            products += ((same.sum(axis=0) ** 2 - (same**2).sum(axis=0)) / (len(same) * (len(same) - 1))).tolist()
    return float(np.mean(products)) if products else np.nan
