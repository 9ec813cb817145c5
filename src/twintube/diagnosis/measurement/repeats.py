"""Whether an error comes again with the motion: what does not is noise, however little of it was read.

Few oscillations of noise with memory tell its size badly; products of the errors of different oscillations do not need it.
Where no oscillation repeats, as on a road, those of moments with nearly the same stroke, speed and acceleration do the like.
"""

import numpy as np
from scipy.spatial import cKDTree

from twintube.arrays import Array
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.records.noise import likes
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.rules import RULES


def only_noise(problem: Problem) -> bool:
    """Whether errors of the model as given, little more than noise, do not come again with the motion.

    The records in which it comes again must be half of all.
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
    """Mean product of weighted errors (n,) at the same phase of different oscillations, else of the same motion."""
    products = []
    for numbers in likes(record):
        cycles = [np.flatnonzero(record.cycle == i) for i in numbers]
        usual = int(np.median([len(own) for own in cycles]))
        same = np.array([error[own] for own in cycles if len(own) == usual and record.judged[own].all()])
        if len(same) > 1:
            products += ((same.sum(axis=0) ** 2 - (same**2).sum(axis=0)) / (len(same) * (len(same) - 1))).tolist()
    return float(np.mean(products)) if products else of_same_motion(record, error)


def of_same_motion(record: PreparedRecord, error: Array) -> float:
    """Mean product of weighted errors (n,) of intervals far apart in time that move alike; not a number where few do."""
    at, least = np.flatnonzero(record.judged), RULES.motion_apart
    if len(at) < 2 * least + 2:
        return np.nan
    motion = np.column_stack([record.stroke, record.velocity, np.gradient(record.velocity, record.time)])[at]
    motion = (motion - motion.mean(axis=0)) / np.maximum(motion.std(axis=0), np.finfo(float).tiny)
    # Of so many neighbours at least two are far apart in time.
    distance, near = cKDTree(motion).query(motion, k=2 * least + 2)
    first = np.argmax(np.abs(at[near] - at[:, None]) > least, axis=1)
    rows = np.arange(len(at))
    if np.median(distance[rows, first]) > RULES.motion_near:
        return np.nan
    return float(np.mean(error[at] * error[at[near[rows, first]]]))
