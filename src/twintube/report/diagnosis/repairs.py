"""Badges of the verdicts, and how a fault of the bench is put right."""

from twintube.diagnosis.channels import FAULTS
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
REPAIRS = {name: fault.repair for name, fault in FAULTS.items()} | {
    BOTH_SIGNS: "set force_sign = -1 and stroke_sign = -1 in dataset.toml, or leave both out where they stand there"
}
