"""How a fault of the bench is put right, and probabilities in words."""

from twintube.diagnosis.measurement.faults import BOTH_SIGNS

# Words for probabilities after Mastrandrea et al., Guidance note on consistent treatment of uncertainties, IPCC 2010.
WORDS = {0.99: "virtually certain", 0.9: "very likely", 0.66: "likely", 0.5: "more likely than not", 0.0: "uncertain"}
LEAST = 0.01  # a probability is not called less than this
BADGES = {  # verdict -> badge, class of the style sheet
    "cause": ("cause named", "found"),
    "none": ("nothing missing", "yes"),
    "state": ("another fill than stated", "warn"),
    "ambiguous": ("cannot tell apart", "warn"),
    "unexplained": ("unexplained", "open"),
    "measurement_fault": ("measurement fault", "no"),
}
REPAIRS = {
    "sign_flip": "turn the sign of this channel: force_sign or stroke_sign in dataset.toml",
    BOTH_SIGNS: "set force_sign = -1 and stroke_sign = -1 in dataset.toml, or leave both out where they stand there",
    "unit_error": "correct the unit of this channel in dataset.toml",
    "force_averaging": "record the force without this mean; here the model was seen through an equal mean",
    "odd_record": "look up damper, setting and fill of what is named, and correct dataset.toml or repeat the measurement",
    "force_offset": "read the load cell with the damper taken out, and set its zero",
    "force_gain": "check the load cell with a known weight, and correct its scale",
    "channel_delay": "record force and stroke at the same time, with equal filters",
    "stroke_gain": "check the stroke channel with a gauge block, and correct its scale",
    "time_base": "time an oscillation of the rig, and correct the sampling rate or the times in the files",
    "zero_drift": "read the load cell before and after each record; let it warm up",
    "clamp_inertia": "repeat the motion without the damper, and take the force it reads off the records",
    "clock_error": "record both channels with a single clock",
}


def chance(p: float) -> str:
    """A probability that is never called 0 or 100 %."""
    return "over 99 %" if p > 0.99 else "below 1 %" if p < LEAST else f"{100 * p:.0f} %"


def worded(p: float) -> str:
    """A probability as a word."""
    return next(word for least, word in WORDS.items() if p >= least)


def certain(p: float) -> str:
    """A probability as a sentence."""
    word = worded(p)
    return f"{word[0].upper()}{word[1:]} ({chance(p)})."
