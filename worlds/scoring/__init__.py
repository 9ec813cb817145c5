"""What answers to datasets with a known truth are worth: one form of truth, one of answers, one set of figures.

truth    what is hidden in a dataset: truth.json, the same from every world
answer   what a diagnosis says: diagnosis.json, or why there is none
pairs    the truth and the answer of each dataset in some folders
marks    one answer against its truth
figures  all of them: shares and scores with 95 % intervals
table    the figures as text
"""

from worlds.scoring.answer import Answer
from worlds.scoring.figures import score
from worlds.scoring.pairs import Pair, read_pairs
from worlds.scoring.table import tables
from worlds.scoring.truth import Truth, TruthError, read_truths

__all__ = ["Answer", "Pair", "Truth", "TruthError", "read_pairs", "read_truths", "score", "tables"]
