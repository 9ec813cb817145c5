"""What the records say of the damper's state: one probability model, the model's own error and the bench in it.

numbers        all priors, in physical units, with their sources; priors: others, as a user has them
discrepancy    D: what a damper's law is off, and what degradation is off
bench          the records under a simulation, and what the bench may add to their forces
memory, sizes  noise with memory; how large the model's own errors are
frame          the evidence of errors, all of this integrated out; heavy: under noise with heavy tails
state          probability over oil level and share of the gas; shares: all of them from a simulation with one; posterior
mechanisms     effects and faults, with what is known of their strengths
search         the evidence of a mechanism; found: what is sought and found
base           what always acts, and is no change
changes        the probability of every hypothesis about what has happened since the reference
heldout        what hypotheses are worth on records that they were not fitted to
budget         what the error consists of
predictive     whether an answer explains each record
answer         what is said of a dataset; contract: diagnosis.json
questions      from a dataset to its answer; fills: what hypotheses may take for the fill
"""

from twintube.diagnosis.answer import Answer, StateAnswer
from twintube.diagnosis.budget import Budget, Line
from twintube.diagnosis.priors import priors
from twintube.diagnosis.questions import answer, diagnose, states

__all__ = ["Answer", "Budget", "Line", "StateAnswer", "answer", "diagnose", "priors", "states"]
