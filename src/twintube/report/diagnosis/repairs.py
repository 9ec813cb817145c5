"""Badges of the verdicts, and how a fault of the bench is put right."""

from twintube.diagnosis.channels import TARED
from twintube.diagnosis.measurement.faults import BOTH_SIGNS

BADGES = {  # verdict -> badge, class of the style sheet
    "cause": ("cause named", "found"),
    "none": ("nothing missing", "yes"),
    "tolerance": ("within tolerance", "yes"),
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
    "dropouts": "look at cable and plug of the load cell, and at the records where it happens",
    "force_offset": "read the load cell with the damper taken out, and set its zero",
    TARED: "read the load cell with the damper taken out, and take what it reads then off every force",
    "force_gain": "check the load cell with a known weight, and correct its scale",
    "channel_delay": "record force and stroke at the same time, with equal filters",
    "stroke_gain": "check the stroke channel with a gauge block, and correct its scale",
    "time_base": "time an oscillation of the rig, and correct the sampling rate or the times in the files",
    "zero_drift": "read the load cell before and after each record; let it warm up",
    "clamp_inertia": "repeat the motion without the damper, and take the force it reads off the records",
    "clock_error": "record both channels with a single clock",
}
