"""Probabilities in words."""

# Words for probabilities after Mastrandrea et al., Guidance note on consistent treatment of uncertainties, IPCC 2010.
WORDS = {0.99: "virtually certain", 0.9: "very likely", 0.66: "likely", 0.5: "more likely than not", 0.0: "uncertain"}
LEAST = 0.01  # a probability is not called less than this
MOST = 0.99  # nor more


def chance(p: float) -> str:
    """A probability that is never called 0 or 100 %."""
    return "over 99 %" if p > MOST else "below 1 %" if p < LEAST else f"{100 * p:.0f} %"


def worded(p: float) -> str:
    """A probability as a word."""
    return next(word for least, word in WORDS.items() if p >= least)


def certain(p: float) -> str:
    """A probability as a sentence."""
    word = worded(p)
    return f"{word[0].upper()}{word[1:]} ({chance(p)})."
