"""The answer in four lines, alike on the page and in the terminal: verdict, how sure it is, a number, the next step."""

from twintube.core.effects import EFFECTS
from twintube.data.findings import UNCONFIRMED
from twintube.data.signs import PULLS_IN
from twintube.diagnosis.fits.candidates import RECALIBRATE
from twintube.diagnosis.measurement.faults import BOTH_SIGNS, PUT_RIGHT
from twintube.diagnosis.result import Cause, Diagnosis
from twintube.diagnosis.verdict.verdict import lower, share
from twintube.readable import amount
from twintube.report.engineering import title_of

# Words for probabilities after Mastrandrea et al., Guidance note on consistent treatment of uncertainties, IPCC 2010.
WORDS = {0.99: "virtually certain", 0.9: "very likely", 0.66: "likely", 0.5: "more likely than not", 0.0: "uncertain"}
LEAST = 0.01  # probability from which another answer is mentioned
OTHERS = 2  # of them
ANSWERS = {"none": "nothing is missing", "unknown": "none of the known causes"}
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
PLACES = ("largest at", "nowhere")  # beginnings of a description of where the residual is large (diagnosis/where.py)
IDENTIFY = "identify the damper from these records (twintube identify)"


def repair(cause: Cause) -> str:
    """How to put a fault right; where one kind has several, its title tells."""
    return REPAIRS.get(cause.title, REPAIRS[cause.effect])


def put_right(cause: Cause) -> bool:
    """Whether a cause is a fault that was put right before anything was fitted: its value was read off, not sought."""
    return cause.effect in PUT_RIGHT or all(value.bounds is None for value in cause.parameters.values())


def recalibrated(d: Diagnosis) -> bool:
    """Whether other values of the known parameters are the answer, or what is left of it once a fault is put right."""
    sought = any(not put_right(cause) for cause in d.causes)
    return d.verdict == RECALIBRATE or (d.verdict == "measurement_fault" and not sought and has_extension(d))


def extends(d: Diagnosis) -> bool:
    """Whether the diagnosis names anything that makes the simulation better: an effect, a fault, other parameters."""
    return any(not put_right(cause) for cause in d.causes) or recalibrated(d)


def has_extension(d: Diagnosis) -> bool:
    """Whether the parameter set that belongs to the answer differs from the given parameter set."""
    return d.verdict not in ("none", "unexplained") and d.extended.parameters != d.base.parameters


def gain_of(d: Diagnosis) -> float:
    """Share of the explainable squared force error of the held-out records that goes away."""
    sought = [cause.gain.heldout for cause in d.causes if not put_right(cause)]
    if sought:
        return sought[0]
    base, extended, floor = (d.errors["heldout"][name].force_rmse_N for name in ("base", "extended", "noise_floor"))
    return min(1.0, (base**2 - extended**2) / (base**2 - floor**2)) if base > floor else 0.0


def number(d: Diagnosis) -> tuple[str, str]:
    """The force error on held-out records with its label; empty texts where there is none."""
    if not d.errors.get("heldout"):
        return "", ""
    base, extended, floor = (
        amount(d.errors["heldout"][name].force_rmse_N, "N") for name in ("base", "extended", "noise_floor")
    )
    repaired = ", the fault put right" if any(put_right(cause) for cause in d.causes) else ""
    noise = f"noise floor {floor}"
    if not extends(d):
        return base, f"force error of the base model on held-out records{repaired}; {noise}"
    of = "recalibrated" if recalibrated(d) else "extended"
    gain = f"{share(gain_of(d))} of the explainable squared error goes away"
    first = " with the first of them" if d.verdict == "ambiguous" else ""
    return f"{base} → {extended}", f"force error on held-out records, base → {of} model{first}{repaired}; {noise}; {gain}"


def named(d: Diagnosis) -> list[str]:
    """The names under which `probabilities` holds the verdict."""
    names = [cause.effect for cause in d.causes[: 1 if d.verdict == "ambiguous" else None]]
    names += [RECALIBRATE] if recalibrated(d) else []
    return list(dict.fromkeys(names)) or {"none": ["none"]}.get(d.verdict, ["unknown"])


def confidence(d: Diagnosis) -> str:
    """The probability of the verdict in words and percent, and the answers that come next."""
    if not d.probabilities:
        return ""
    names = named(d)
    p = sum(d.probabilities.get(name, 0.0) for name in names)
    word = next(word for least, word in WORDS.items() if p >= least)
    others = [(name, x) for name, x in d.probabilities.items() if name not in names and x >= LEAST][:OTHERS]
    listed = ", ".join(f"{ANSWERS.get(name, lower(title_of(name)))} ({chance(x)})" for name, x in others)
    first = f"{title_of(names[0])}: {word}" if d.verdict == "ambiguous" else f"{word[0].upper()}{word[1:]}"
    where = ", among datasets of which three in four hide something" if d.verdict == "none" else ""
    return f"{first} ({chance(p)}{where}); " + (f"next: {listed}" if listed else "no other answer above 1 %")


def chance(p: float) -> str:
    """A probability that is never called 0 or 100 %."""
    return "over 99 %" if p > 0.99 else "below 1 %" if p < LEAST else f"{100 * p:.0f} %"


def next_step(d: Diagnosis) -> str:
    """What to do or measure next."""
    steps = [repair(cause) for cause in d.causes if cause.effect in REPAIRS and d.verdict != "ambiguous"]
    effects = [cause.effect for cause in d.causes if cause.effect in EFFECTS]
    match d.verdict:
        case "none":
            if d.tolerance:
                return f"Nothing to do. The error is within the tolerance of {100 * d.tolerance:.3g} % of the largest force."
            return "Nothing to do. The error is that of the noise; no tolerance was set."
        case "ambiguous":
            return f"Measure what tells them apart. {'. '.join(decisive(d))}."
        case "unexplained":
            return f"Look at {what_is_left(d)}."
    if recalibrated(d):
        steps.append(IDENTIFY)
    steps += [f"confirm {lower(title_of(name))}: {EFFECTS[name].decides}" for name in effects]
    again = " Then diagnose again." if any(cause.effect in REPAIRS for cause in d.causes) else ""
    text = "; ".join(dict.fromkeys(steps))
    return f"{text[:1].upper()}{text[1:]}.{again}"


def decisive(d: Diagnosis) -> list[str]:
    """What would decide between the answers of an ambiguous verdict, each with the answer that it shows."""
    first = [f"{title_of(c.effect)}: {EFFECTS[c.effect].decides}" for c in d.causes[:1] if c.effect in EFFECTS]
    first += [f"{title_of(c.effect)}: {repair(c)}" for c in d.causes[:1] if c.effect in REPAIRS]
    return first + [a.separable_by for a in d.alternatives]


def what_is_left(d: Diagnosis) -> str:
    """Where to look where nothing known explains the records."""
    if d.signature and not d.signature.startswith(PLACES):
        return f"the rig and the records: {d.signature.rstrip('.')}"
    return f"where the base model is wrong: {d.where.partition(';')[0].rstrip('.')}"


def lines(d: Diagnosis) -> list[str]:
    """The answer for a terminal."""
    value, label = number(d)
    doubts = (f"note: {remark}" for remark in d.remarks if remark.startswith((UNCONFIRMED, PULLS_IN)))
    texts = (*doubts, d.sentence, confidence(d), f"{value}: {label}" if value else "", f"Next: {next_step(d)}")
    return [text for text in texts if text]
