"""All thresholds of the diagnosis: value, unit, reason, and on what they were tuned.

The table in docs/diagnosis_rules.md is generated from this file (rules_table.py). Datasets that a value was tuned on do not
confirm it.
"""

from dataclasses import dataclass

from twintube.fitting.rule import (
    DEVELOPMENT,
    JUDGEMENT,
    LIKELIHOOD,
    METHOD,
    NOT_RECORDED,
    NUMERICS,
    STATISTICS,
    TRIALS,
    Section,
)

records = Section("Records")
measurement = Section("What every measurement has")
fitting = Section("Fit")
starts = Section("Starts of a candidate")
selection = Section("Selection")
verdict = Section("Verdict and values")
confidence = Section("Probabilities (logits)")
units = Section("Wrong units")
line = Section("Signature: line of fixed frequency")
ringing = Section("Signature: resonance")
backlash = Section("Signature: play")
maps = Section("Maps and structure of the residual")


@dataclass(frozen=True)
class Rules:
    """The thresholds; read `RULES`."""

    intervals_fast: int = records(48, "", "intervals per oscillation of the main block", NUMERICS)
    intervals_slow: int = records(24, "", "intervals of slower oscillations, which are not what is looked at", JUDGEMENT)
    intervals_most: int = records(5000, "", "intervals of a record, beyond which an oscillation has ...", DEVELOPMENT)
    intervals_endurance: int = records(16, "", "... so many: an endurance run of hundreds", DEVELOPMENT)
    intervals_ramp: int = records(240, "", "of a quasi-static record: friction reverses within tenths of a mm", JUDGEMENT)
    interval_drive: float = records(5e-3, "s", "interval of harmonic records without a full oscillation", JUDGEMENT)
    reversal: float = records(0.005, "1", "of the range of the stroke, by which a random motion must turn", DEVELOPMENT)
    intervals_least: int = records(3, "", "intervals between two reversals of a random motion", JUDGEMENT)
    followed: float = records(0.005, "1", "of the top speed, to which a motion is followed between two samples", DEVELOPMENT)
    noise_followed: float = records(
        3.0, "1", "standard deviations of the stroke's noise, which is not followed", DEVELOPMENT
    )
    halvings: int = records(8, "", "most halvings of its intervals for that", NUMERICS)
    block_factor: float = records(
        1.5, "1", "oscillations longer than this times the shortest are not the main block", JUDGEMENT
    )
    peak_quantile: float = records(0.999, "1", "of the measured force: its peak without outliers", JUDGEMENT)
    speed_quantile: float = records(0.99, "1", "of the speed: the top speed of a record without outliers", JUDGEMENT)
    repeats: int = records(3, "", "oscillations from which noise is what does not repeat: second differences", METHOD)
    calm_edges: float = records(
        1.0, "1", "of the noise, that the model's own steps leave open where noise is read", JUDGEMENT
    )
    calm_share: float = records(0.25, "1", "of a record that must be so calm, or all of it counts", JUDGEMENT)
    jitter_tried: float = records(0.005, "1", "of a sample period: jitter of the samples that is tried", NUMERICS)
    jitter_draws: int = records(3, "", "draws of it", NUMERICS)
    jitters: int = records(81, "", "sizes of jitter that are compared", NUMERICS)
    jitter_least: int = records(30, "", "intervals that must show it", JUDGEMENT)
    most_jitter: float = records(0.01, "1", "of a sample period: what asks for more is no jitter", DEVELOPMENT)
    coloured_least: int = records(200, "", "intervals from which the colour of noise is seen", JUDGEMENT)
    coloured_repeated: tuple[int, int] = records(
        (2, 3), "", "intervals apart, that show with neighbours what colour it is, and that check it", DEVELOPMENT
    )
    coloured_alone: tuple[int, int] = records((4, 12), "", "the like where no oscillation repeats", DEVELOPMENT)
    few_samples: int = records(8, "", "samples of an interval, up to which its ends that are shared count", NUMERICS)
    most_alike: float = records(0.9, "1", "correlation of samples an interval apart that noise has at most", JUDGEMENT)
    smooth: float = records(1.15, "1", "times what noise gains from neighbours to intervals far apart: an error", JUDGEMENT)
    alike_turns: float = records(
        1.1, "1", "oscillations whose durations and ranges are within this factor share noise", JUDGEMENT
    )
    motion_apart: int = records(30, "", "intervals between two of the same motion: noise has no memory then", JUDGEMENT)
    motion_near: float = records(0.3, "1", "of the usual stroke, speed and acceleration: the same motion", JUDGEMENT)
    still: float = records(1e-3, "1", "of the range of the stroke: an interval of less is at rest ...", JUDGEMENT)
    outlier: float = records(8.0, "1", "usual residuals of a record: an interval beyond is an outlier ...", DEVELOPMENT)
    outliers: float = records(0.01, "1", "... where no more of its intervals are than this share", DEVELOPMENT)
    outlier_records: int = records(
        2, "", "records with outliers at most, of more it is asked what they would name", DEVELOPMENT
    )
    outlier_phase: float = records(0.02, "1", "of an oscillation, within which outliers of several are one", JUDGEMENT)
    kick: float = records(
        0.3, "1", "of the top speed: a larger change from interval to interval is a kick of the rig", DEVELOPMENT
    )
    kick_usual: float = records(
        2.0, "1", "times the change that nine of ten intervals do not reach: the least of a kick", DEVELOPMENT
    )
    kicked_most: float = records(
        0.3, "1", "of the intervals that must be left after kicks, else none is taken for a kick", DEVELOPMENT
    )
    still_run: int = records(3, "", "... where so many follow each other", JUDGEMENT)
    least_noise: float = records(1e-4, "1", "of the peak: without noise every difference would be significant", JUDGEMENT)
    quieter: float = records(
        0.75, "1", "of a record's noise, at which a better model's errors show it to be less", JUDGEMENT
    )
    noise_rounds: int = records(2, "", "most times that noise is read anew from the errors of better models", JUDGEMENT)
    equal_speeds: float = records(
        1.05, "1", "top speeds within this factor are held out together: they hold noise", JUDGEMENT
    )
    parts: int = records(
        10, "", "parts of a record, every second of which is held out where its velocity is not held out", JUDGEMENT
    )
    part_least: int = records(5, "", "intervals of a part at least", JUDGEMENT)
    most_tolerance: float = records(0.2, "1", "of the largest force: more than a good damper can be off", JUDGEMENT)
    history_gain: float = records(
        0.1, "1", "log-misfit per sample by which slow strokes before a record must explain it better", DEVELOPMENT
    )
    history_least: int = records(
        2, "", "slow strokes that may have been before a record instead of the plan's six", JUDGEMENT
    )
    history_rest: float = records(5.0, "s", "rest after them", JUDGEMENT)
    slow_share: float = records(0.2, "1", "of the top speed: slower is preconditioning", JUDGEMENT)
    slow_random: float = records(
        2.0, "1", "times the velocity of preconditioning, up to which a random motion is slow all along", DEVELOPMENT
    )
    slow_way: float = records(2.0, "1", "of the range of the stroke that preconditioning goes at least ...", JUDGEMENT)
    slow_reach: float = records(0.8, "1", "... over so much of it", JUDGEMENT)
    odd: float = records(4.0, "1", "times the largest misfit of all others, at which a record does not belong", DEVELOPMENT)
    odd_unit: float = records(25.0, "1", "the like where only another unit of these records is looked for", JUDGEMENT)
    odd_far: float = records(200.0, "1", "the like where the others are not explained within noise", DEVELOPMENT)
    odd_apart: float = records(8.0, "1", "the like for errors over peak forces", DEVELOPMENT)
    odd_share: float = records(1 / 3, "1", "of the records that may contradict the others", JUDGEMENT)
    odd_force: float = records(
        0.03, "1", "of the largest force by which a record of something else differs at least", DEVELOPMENT
    )
    odd_little: float = records(0.02, "1", "the like of a record whose misfit is far beyond all others ...", DEVELOPMENT)
    odd_clear: float = records(50.0, "1", "... so many times", DEVELOPMENT)
    odd_intact: float = records(0.005, "1", "the like of records of the intact damper, which have no fill", DEVELOPMENT)
    odd_spread: float = records(
        0.3, "1", "of its intervals in which a record of something else is off: a moved step is not one", DEVELOPMENT
    )
    odd_zero: float = records(
        0.2, "1", "of the zeros' scatter, that is left without a single record: it is its own", JUDGEMENT
    )
    odd_fills: tuple[float, float, float] = records(
        (0.25, 0.98, 0.002), "1", "fills at which a single record may have been taken: from, to, step", JUDGEMENT
    )
    odd_fill: float = records(0.05, "1", "of the oil: another fill than the recorded one, of a record by mistake", JUDGEMENT)
    odd_left: float = records(0.05, "1", "of its misfit that such a fill leaves", JUDGEMENT)
    odd_off: float = records(3.0, "1", "times its uncertainty, at which an interval is off", JUDGEMENT)
    few_intervals: int = records(2, "", "of a record, that make it no record with a cause of its own", JUDGEMENT)
    odd_right: float = records(2.0, "1", "misfit up to which a fault of their own explains such records", JUDGEMENT)

    limit_least: int = records(8, "", "intervals beyond the largest measured force, for a limit of the channel", JUDGEMENT)
    limit_follows: float = records(0.1, "1", "of the model's rise beyond a limit, that the force follows at most", JUDGEMENT)
    limit_flat: float = records(3.0, "1", "times its noise, that the force scatters on a limit at most", JUDGEMENT)
    limit_far: float = records(0.02, "1", "of the peak, by which the model is beyond a limit on average", JUDGEMENT)
    limit_share: float = records(0.9, "1", "of a record's squared error that lies beyond its limit", JUDGEMENT)
    limit_alike: float = records(0.02, "1", "of a limit, within which those of several records are equal", JUDGEMENT)

    small_zero: float = measurement(0.005, "1", "of the largest force: zero of a good load cell", JUDGEMENT)
    least_zero: float = measurement(5e-4, "1", "of the largest force: zeros are not known to less", DEVELOPMENT)
    small_delay: float = measurement(3e-4, "s", "delay that sampling leaves open; a shorter lag is not a cause", JUDGEMENT)
    small_gain: float = measurement(0.003, "1", "error of a calibrated channel's gain", DEVELOPMENT)
    small_decay: float = measurement(0.05, "1", "of foam or gas: less of it lost in the longest record is none", JUDGEMENT)
    small_force: float = measurement(1e-3, "1", "of the largest force: less of a force is not a cause", JUDGEMENT)
    open_samples: float = measurement(
        0.6,
        "1",
        "samples of delay that sampling leaves open: 0.5 of a mean, 0.56 of a filter of order 2 at 0.4 of its rate",
        DEVELOPMENT,
    )
    open_filtered: float = measurement(1.1, "1", "where a filter shows: 1.04 of order 4 at 0.4 of its rate", DEVELOPMENT)
    bent: float = measurement(0.03, "1", "of a bend of the force, which a filter takes from a sample at least", DEVELOPMENT)
    open_step: float = measurement(0.05, "1", "of a sample, by which a step of the force is known no better", DEVELOPMENT)
    warm: float = measurement(3.0, "K", "change of temperature along a record that shows in its forces", JUDGEMENT)
    begun: float = measurement(
        0.25, "1", "of its range: standard deviation of what records begin with, from one to another", JUDGEMENT
    )
    begun_step: float = measurement(0.1, "1", "of it, for the slope of the force", NUMERICS)
    begun_warm: float = measurement(
        0.3, "K", "the like from where a record begins to another: a thermometer tells a tenth", DEVELOPMENT
    )
    open_level: float = measurement(2e-4, "1", "of the oil: error of every fill", DEVELOPMENT)
    open_stroke: float = measurement(5e-4, "1", "of stroke and velocity: error of every channel", DEVELOPMENT)
    open_speed: float = measurement(
        0.05,
        "1",
        "of the threshold of cavitation, by which noise may lift a speed: 0.045 at sharp turns",
        DEVELOPMENT,
    )
    delay_step: float = measurement(
        0.02, "1", "of the range of a delay, over which the force's slope in it is taken", JUDGEMENT
    )
    delays_tried: int = measurement(9, "", "delays up to that at which the search for the sampling begins", JUDGEMENT)
    bends: float = measurement(
        0.5, "1", "of a bend of the force that a sample of a filtered force holds at most", DEVELOPMENT
    )
    sampling_known: float = measurement(0.02, "1", "of that delay, to which it is sought", JUDGEMENT)
    sampling_rounds: int = measurement(4, "", "rounds in which records that differ lose weight", NUMERICS)
    motion_gain: float = measurement(
        0.1, "1", "of log-likelihood per interval, from which another motion between samples is taken", DEVELOPMENT
    )
    sharp: float = measurement(
        0.5, "1", "of the speed around, before and after a turn that a sample or two hold: it is sharp", JUDGEMENT
    )
    turn_reach: int = measurement(5, "", "samples around a sharp turn in which its motion is another", JUDGEMENT)
    open_motion: float = measurement(
        2.0, "1", "of what another spline through the stroke changes in the force: error between samples", DEVELOPMENT
    )
    stroke_draws: int = measurement(2, "", "draws of the noise of strokes, for what it leaves open in the force", NUMERICS)
    open_filter: float = measurement(0.05, "1", "of a bend of the force, to which a filter is known", DEVELOPMENT)
    usual_zeros: float = measurement(3.0, "1", "standard deviations up to which a mean error counts as a zero", JUDGEMENT)
    order_least: int = measurement(5, "", "records in which a zero is seen to move evenly; one more for a step", DEVELOPMENT)
    order_side: int = measurement(2, "", "records before and after a step of the zero at least", DEVELOPMENT)
    order_left: float = measurement(
        0.15, "1", "of the squared means of the records that a moving zero leaves at most", DEVELOPMENT
    )
    order_state: float = measurement(0.5, "1", "the like in each state of filling, and in both directions", DEVELOPMENT)
    order_intact: float = measurement(
        0.2, "1", "of a zero that moved with the loss of oil: zero of the intact records at most", JUDGEMENT
    )
    least_bends: int = measurement(3, "", "triples of neighbouring velocities that give the scatter of zeros", JUDGEMENT)

    model_error: float = fitting(1e-4, "1", "of the peak: error of sampling and time step, tests/diagnosis", DEVELOPMENT)
    steps_per_interval: int = fitting(
        4, "", "steps of the model, as effects of short memory need; equal in all models", JUDGEMENT
    )
    steps_sketched: int = fitting(
        2, "", "the like in the records that a search for a start looks at: it only ranks starts", JUDGEMENT
    )
    pull: float = fitting(
        0.5, "1", "of the range: standard deviation of a weak pull that keeps idle parameters in place", JUDGEMENT
    )
    free_pull: float = fitting(1e-6, "1", "of that pull acts on zero, gain and delay: next to none", JUDGEMENT)
    inside: float = fitting(1e-9, "1", "of the range by which a fit begins inside it", NUMERICS)
    failed_force: float = fitting(
        1e9, "N", "force where a step of the model fails: finite, as least squares needs", NUMERICS
    )
    evaluations: int = fitting(10, "", "most evaluations of a fit", NOT_RECORDED)
    fit_ends: float = fitting(
        1e-4, "1", "relative change of cost or parameters; a cause changes the cost by percents", JUDGEMENT
    )

    factors_tried: tuple[float, ...] = fitting(
        (0.1, 0.3, 0.6, 0.85, 0.96, 1.04, 1.2, 1.6, 2.5),
        "1",
        "of a parameter, to which an optimum is moved for a better",
        DEVELOPMENT,
    )
    moves: int = fitting(4, "", "most such moves", DEVELOPMENT)

    start_records: int = starts(6, "", "records to fit that a search looks at, of all states and velocities", JUDGEMENT)
    start_moving: int = starts(20, "", "the like for what moves steps of the force", DEVELOPMENT)
    joins: float = starts(0.02, "1", "of the squared error that a further strength of a cause must take away", DEVELOPMENT)
    shapes: int = starts(3, "", "lengths, powers and shares that are sought, the first in the effect's file", JUDGEMENT)
    shapes_kept: int = starts(4, "", "combinations of these that are tried at all strengths", JUDGEMENT)
    shapes_coarse: int = starts(6, "", "of so many strengths one says which", JUDGEMENT)
    shares: tuple[float, ...] = starts(
        (0.0007, 0.003, 0.01, 0.03, 0.1, 0.3), "1", "of a strength's range, at which a search begins", DEVELOPMENT
    )
    shares_calibration: tuple[float, ...] = starts(
        (0.01, 0.05, 0.2, 0.5, 1.0), "1", "the like of the degradation parameters", JUDGEMENT
    )
    generations: int = starts(40, "", "of differential evolution, in the search for degradation parameters", NUMERICS)
    population: int = starts(4, "", "of it, per parameter", NUMERICS)
    most_changed: int = starts(5, "", "parameters that differ at most where it begins", DEVELOPMENT)
    shares_moving: tuple[float, float, int] = starts(
        (2e-4, 0.8, 36), "1", "the like of what moves steps of the force: from, to, number", DEVELOPMENT
    )
    place: float = starts(0.9, "1", "of the largest stroke, at which the search for a place begins", JUDGEMENT)
    places: int = starts(7, "", "places on either side of the middle of the stroke, at which a search begins", JUDGEMENT)
    zero_range: float = starts(0.5, "1", "of the largest force: range of a zero that is a fault", JUDGEMENT)
    settling: tuple[float, float, float] = starts(
        (0.1, 0.0, 0.3), "1/s", "rate at which a moving zero settles: usual, least, most (a load cell warms up)", DEVELOPMENT
    )
    gain_range: tuple[float, float] = starts(
        (0.5, 2.0), "1", "range of a gain that is a fault; beyond it is a wrong unit", JUDGEMENT
    )
    delay_range: float = starts(0.06, "s", "range of a delay that is a fault, to both sides", JUDGEMENT)
    delay_samples: float = starts(3.0, "1", "samples that this range holds at least", JUDGEMENT)
    stroke_range: tuple[float, float] = starts((0.8, 1.25), "1", "range of a gain of the stroke that is a fault", JUDGEMENT)
    clamp_mass: float = starts(20.0, "kg", "most mass between load cell and damper", JUDGEMENT)
    time_range: tuple[float, float] = starts((0.9, 1.1), "1", "range of a time base that is a fault", JUDGEMENT)
    fills_tried: tuple[float, float, float] = starts(
        (0.004, 0.02, 0.16),
        "1",
        "of the oil: steps of a fill's error that is sought, near, far, and where far begins",
        DEVELOPMENT,
    )
    clock_range: float = starts(0.01, "1", "range of a clock's error, to both sides", JUDGEMENT)
    clocks: int = starts(401, "1", "errors of a clock within this range that are looked at by moving forces", JUDGEMENT)
    clock_starts: int = starts(3, "1", "best of these from which a fit may begin", JUDGEMENT)

    alarm: float = selection(0.01, "1", "datasets without a cause in which noise makes any; gives the limit c", STATISTICS)
    least_misfit: float = selection(0.5, "1", "mean squared weighted error below which nothing is gained", JUDGEMENT)
    worth: float = selection(
        0.005, "1", "least gain in log-likelihood per held-out sample: below it numerics decide", DEVELOPMENT
    )
    least_share: float = selection(
        0.01, "1", "of the squared error of the held-out records, noise included, that a cause must take away", DEVELOPMENT
    )
    clear_share: float = selection(0.02, "1", "the like where the base model is right within noise", DEVELOPMENT)
    loose_share: float = selection(
        0.1,
        "1",
        "the like for other degradation parameters and for what is late: edges and sampling ask for a bit",
        DEVELOPMENT,
    )
    idle: float = selection(
        0.05, "1", "of the largest: records that hold less of the error stay in every resample", DEVELOPMENT
    )
    sure: float = selection(
        0.9, "1", "interval by resampling the held-out records, in which the squared error must fall", STATISTICS
    )
    next_share: float = selection(
        1 / 3, "1", "of the squared error left, or of the step between the zeros, for a further cause", TRIALS
    )
    half: float = selection(
        0.5,
        "1",
        "of the misfit left, for a further cause that does not raise the squared error; of a cause, where noise is left",
        TRIALS,
    )
    second_share: float = selection(
        0.1, "1", "of the whole squared error beyond noise, which a further cause must explain", DEVELOPMENT
    )
    little_share: float = selection(0.005, "1", "of it, below which no further cause is sought ...", DEVELOPMENT)
    rest_share: float = selection(
        0.75, "1", "... and of what is left, which a smaller further cause must explain", DEVELOPMENT
    )
    near_best: float = selection(
        0.75, "1", "of the best gain, where a third less squared error decides; of any, for a cause within noise", TRIALS
    )
    near_sampling: float = selection(
        0.85, "1", "of the gain of a cause, that what every measurement has reaches, too", DEVELOPMENT
    )
    promise: float = selection(
        0.005, "1", "of the squared error that the start of a candidate takes away, for it to be fitted", DEVELOPMENT
    )
    first_fits: int = selection(7, "", "candidates fitted in the first round: those with the best starts", JUDGEMENT)
    further_fits: int = selection(4, "", "candidates fitted in further rounds", JUDGEMENT)
    explains_more: float = selection(
        0.2, "1", "of the squared error: an answer within the records that leaves less replaces another", DEVELOPMENT
    )
    rounds: int = selection(2, "", "most causes: what two leave is mostly their formulation", DEVELOPMENT)
    few_records: int = selection(2, "", "held-out records up to which a single record may decide", JUDGEMENT)
    unknown_history: float = selection(
        0.05, "1", "of the error that other degradation parameters leave at most, or noise, where it is unknown", DEVELOPMENT
    )
    late_records: int = selection(2, "", "wrong records in which what makes the force late is seen at least", JUDGEMENT)
    calibrated_records: int = selection(2, "", "records that must ask for other degradation parameters", JUDGEMENT)
    acts: float = selection(1e-3, "1", "of its range: a strength below it is neutral", JUDGEMENT)

    right: float = verdict(0.1, "1", "log-misfit per sample up to which nothing is missing: 5 % above the noise", JUDGEMENT)
    quiet: float = verdict(
        1.1, "1", "error of the base model over the noise floor, up to which nothing is missing", DEVELOPMENT
    )
    quiet_late: float = verdict(
        1.15, "1", "the like up to which nothing makes the force late: sampling moves its steps, too", DEVELOPMENT
    )
    explained: float = verdict(0.6, "1", "of the explainable squared error that named causes must explain", DEVELOPMENT)
    explained_most: float = verdict(0.8, "1", "the like of other parameters, where far more than noise is left", DEVELOPMENT)
    explained_late: float = verdict(0.9, "1", "the like there of what makes the force late", DEVELOPMENT)
    stiffer: float = verdict(
        0.4, "1", "factor of the force above 1, beyond which it is another damper or setting", JUDGEMENT
    )
    close: float = verdict(0.03, "1", "of the explainable misfit: candidates that differ by less are ambiguous", DEVELOPMENT)
    contents_apart: float = verdict(0.4, "1", "the like of what becomes of oil, freed gas and foam", DEVELOPMENT)
    law_apart: float = verdict(
        0.25, "1", "the like of the misfit that a single cause leaves, where it leaves more than noise", DEVELOPMENT
    )
    alternatives: int = verdict(3, "", "most alternatives of an ambiguous verdict", JUDGEMENT)
    shows: float = verdict(0.3, "1", "of the base model's error: a signature of less is only mentioned", JUDGEMENT)
    at_bound: float = verdict(1e-3, "1", "of the range: nearer to its end the range decides, not the records", JUDGEMENT)
    wide: float = verdict(0.5, "1", "of the range: a wider interval says nothing about the value", JUDGEMENT)
    interval: float = verdict(1.645, "1", "standard deviations of a 90 % interval", STATISTICS)
    law_width: float = verdict(
        0.2,
        "1",
        "of its distance from doing nothing, to either side: least interval of an effect's strength",
        DEVELOPMENT,
    )
    channel_width: float = verdict(0.05, "1", "the like of a fault of a channel, whose law is known", DEVELOPMENT)
    interval_level: float = verdict(0.9, "1", "of the intervals of gains", STATISTICS)
    resamples: int = verdict(2000, "", "of the records, for the intervals of gains", JUDGEMENT)
    worst_share: float = verdict(0.01, "1", "of the explainable error that a record must hold to be the worst", JUDGEMENT)

    logit_share: float = confidence(2.6, "1", "per share of the error that a candidate removes", LIKELIHOOD)
    logit_named: float = confidence(4.1, "1", "of what the verdict names", LIKELIHOOD)
    logit_rival: float = confidence(2.3, "1", "of each of several that an ambiguous verdict does not tell apart", LIKELIHOOD)
    logit_near: float = confidence(3.3, "1", "of what explains most, but too little to be named", LIKELIHOOD)
    logit_none: float = confidence(1.9, "1", "of `none`", LIKELIHOOD)
    logit_none_said: float = confidence(1.9, "1", "of `none` where that is the verdict", LIKELIHOOD)
    logit_unknown: float = confidence(1.45, "1", "of a cause outside the catalogue", LIKELIHOOD)
    logit_left: float = confidence(0.8, "1", "per share of the error that the best candidate leaves", LIKELIHOOD)
    logit_unexplained: float = confidence(0.9, "1", "of `unknown` where the verdict is `unexplained`", LIKELIHOOD)

    followed_force: float = units(-1.4, "1", "log of the squared error over the squared force: half of it", JUDGEMENT)
    unit_gain: float = units(1.5, "1", "log-misfit per sample: an error twice as small is not a calibration", JUDGEMENT)
    unit_clear: float = units(
        3.0, "1", "the like of single records: no cause makes a force of the same shape so much smaller", JUDGEMENT
    )

    line_alarm: float = line(1e-4, "1", "chance that white noise makes a line in a record", STATISTICS)
    line_records: int = line(3, "", "records that must show a line", JUDGEMENT)
    line_share: float = line(1 / 3, "1", "of the records that can show a line, that must show it", JUDGEMENT)
    line_periods: float = line(1.2, "1", "factor between periods of the excitation that makes them different", JUDGEMENT)
    line_side: float = line(0.1, "1", "of the frequency, within which other lines are side lobes", JUDGEMENT)
    line_padding: int = line(4, "", "bins of the spectrum per independent frequency", NUMERICS)
    line_background: int = line(64, "", "independent frequencies over which the background is taken", JUDGEMENT)
    line_slack: float = line(2.0, "1", "above the threshold of a known background, which scatters", NOT_RECORDED)
    line_strong: float = line(0.02, "1", "of a record's strongest line: weaker ones may be its side lobes", JUDGEMENT)
    line_width: float = line(2e-3, "1", "relative: lines within it are equal; mains keep 50 Hz within 0.1 Hz", JUDGEMENT)
    line_slowest: float = line(3.0, "1", "times the frequency of the excitation, from which lines are sought", JUDGEMENT)
    line_gap: float = line(10.0, "1", "sampling intervals, from which a gap is filled with zeros", JUDGEMENT)
    line_phases: int = line(64, "", "parts of an oscillation with a scatter of their own: force jumps wander", JUDGEMENT)
    line_outlier: float = line(4.0, "1", "scatters at which a sample is cut", JUDGEMENT)
    line_least_scatter: float = line(0.5, "1", "of the median scatter: the least at any phase", JUDGEMENT)
    line_turns: int = line(5, "", "oscillations of equal period that a record needs", JUDGEMENT)
    line_fade: float = line(3.0, "1", "oscillations in which a force fades", JUDGEMENT)
    lines_named: int = line(4, "", "most lines that are named", JUDGEMENT)
    mains: tuple[int, ...] = line((50, 60), "Hz", "frequencies of the mains", JUDGEMENT)

    speeds_apart: float = ringing(1.2, "1", "factor between velocities that makes them different", JUDGEMENT)
    ring_step: float = ringing(1.03, "1", "from a frequency that is tried to the next", NUMERICS)
    ring_inside: float = ringing(1.05, "1", "its band reaches to these factors of the frequency", NOT_RECORDED)
    ring_outside: tuple[float, float] = ringing(
        (1.5, 2.2), "1", "the bands to both sides lie between these factors", JUDGEMENT
    )
    ring_seen: float = ringing(4.0, "1", "power of a band relative to noise", NOT_RECORDED)
    ring_power: float = ringing(
        10**0.6, "1", "power of the band relative to the stronger side band (6 dB), median record", NOT_RECORDED
    )
    ring_lowest: float = ringing(5.0, "Hz", "lowest frequency that is tried", JUDGEMENT)
    ring_harmonic: float = ringing(3.0, "1", "least number of the harmonic", JUDGEMENT)
    ring_records: int = ringing(5, "", "records that must be able to show a resonance", NOT_RECORDED)
    ring_middle: float = ringing(0.2, "1", "of the frequency, in which the middle of the resonance is sought", JUDGEMENT)

    play_records: int = backlash(3, "", "records that must show a play", JUDGEMENT)
    play_share: float = backlash(0.6, "1", "of the intact records that must show it", JUDGEMENT)
    plays: tuple[float, float, int] = backlash(
        (1e-3, 2e-2, 40), "1", "lengths tried, of the range of the stroke: from, to, number", JUDGEMENT
    )
    play_inside: tuple[float, float, int] = backlash(
        (0.2, 0.9, 4), "1", "of the play, where the force is steady: from, to, edges", JUDGEMENT
    )
    play_after: tuple[float, float] = backlash((1.25, 1.6), "1", "stretch behind the play, of its length", JUDGEMENT)
    play_later: tuple[float, float] = backlash((2.0, 2.5), "1", "stretch further behind, of its length", JUDGEMENT)
    play_at_once: float = backlash(
        0.6, "1", "least force of the first stretch relative to the second: a spring has less", NOT_RECORDED
    )
    play_even: float = backlash(1e-3, "1", "of the largest force: the least that a force is taken to vary", JUDGEMENT)
    play_jump: float = backlash(
        20.0, "1", "force behind relative to its variation: 15 at most by chance, 30 of a play", NOT_RECORDED
    )
    play_alike: float = backlash(1.25, "1", "plays within this factor are equal", JUDGEMENT)
    play_samples: int = backlash(3, "", "samples of a mean", JUDGEMENT)

    bins: int = maps(16, "", "of a map; quantities of fewer values show each value", JUDGEMENT)
    bin_samples: int = maps(10, "", "that a bin must hold", JUDGEMENT)
    striking: float = maps(1.5, "1", "times the usual error, from which a bin stands out", JUDGEMENT)
    constant: float = maps(0.9, "1", "of the error that its mean is at least, where it is the same everywhere", JUDGEMENT)
    regions: int = maps(3, "", "most regions that are named", JUDGEMENT)
    structure_alarm: float = maps(0.01, "1", "chance that white noise in all records shows structure in any", STATISTICS)


RULES = Rules()
