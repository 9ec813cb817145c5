"""All figures of the drives as tables: intact and worn, each with its range over seeds and ways of the freed gas."""

from collections.abc import Mapping, Sequence
from typing import Any

from twintube.dampers.freed_gas import DEFAULT, SCALAR
from twintube.report.common.html_page import Table
from twintube.vehicle.full.car import WHEELS

# Figures of a drive: name, title, unit, decimals; those of the wheels have a line for each wheel.
FIGURES = (
    ("stopping_distance_m", "stopping distance", "m", 1),
    ("stopping_time_s", "stopping time", "s", 2),
    ("deceleration_m_s2", "mean deceleration", "m/s2", 2),
    ("lateral_acceleration_max_m_s2", "largest lateral acceleration", "m/s2", 2),
    ("understeer_deg_per_g", "understeer gradient", "deg/g", 2),
    ("roll_deg_per_g", "roll gradient", "deg/g", 2),
    ("side_slip_deg_per_g", "side slip gradient", "deg/g", 2),
    ("entry_speed_max_kmh", "highest entry speed passed", "km/h", 0),
    ("exit_speed_kmh", "speed after the lanes", "km/h", 1),
    ("out_of_lane_m", "out of the lanes, below 0 the room left", "m", 2),
    ("steer_rate_rms_deg_s", "steer rate, rms", "deg/s", 1),
    ("steer_max_deg", "largest steer angle", "deg", 1),
    ("yaw_rate_gain_1_s", "yaw rate gain", "1/s", 2),
    ("steady_lateral_acceleration_m_s2", "steady lateral acceleration", "m/s2", 2),
    ("yaw_rate_t90_s", "response time of the yaw rate, to 90 %", "s", 3),
    ("lateral_acceleration_t90_s", "response time of the lateral acceleration, to 90 %", "s", 3),
    ("roll_t90_s", "response time of the roll angle, to 90 %", "s", 3),
    ("yaw_rate_peak_time_s", "time to the peak of the yaw rate", "s", 2),
    ("yaw_rate_peak_ratio", "peak of the yaw rate over steady", "1", 3),
    ("lateral_acceleration_peak_ratio", "peak of the lateral acceleration over steady", "1", 3),
    ("roll_peak_ratio", "peak of the roll angle over steady", "1", 3),
    ("amplitude_passed_A", "largest steering passed", "A", 1),
    ("yaw_ratio_1_s", "yaw rate 1 s after the steering over its peak", "1", 3),
    ("yaw_ratio_1.75_s", "yaw rate 1.75 s after the steering over its peak", "1", 3),
    ("displacement_1.07_s_m", "displacement 1.07 s after the steering begins", "m", 2),
    ("yaw_ratio_braked", "yaw rate 1 s after the brakes over that of the circle", "1", 3),
    ("yaw_rate_max_deg_s", "largest yaw rate", "deg/s", 2),
    ("heading_deg", "largest heading, with its sign", "deg", 2),
    ("side_offset_m", "largest side offset, to the left", "m", 3),
    ("side_slip_max_deg", "largest side slip angle", "deg", 2),
    ("side_slip_change_deg", "largest change of the side slip angle", "deg", 2),
    ("off_circle_m", "furthest off the circle, outside positive", "m", 2),
    ("dlc", "DLC", "1", 3),
    ("min_load_share", "smallest wheel load over that at rest", "1", 2),
    ("contact_loss_share", "share of the time without contact", "1", 4),
    ("comfort_m_s2", "vertical acceleration, ISO 2631 W_k", "m/s2", 2),
    ("roll_rms_deg", "roll angle, rms", "deg", 2),
    ("roll_max_deg", "largest roll angle", "deg", 2),
    ("pitch_rms_deg", "pitch angle, rms", "deg", 2),
    ("pitch_max_deg", "largest pitch angle, nose down", "deg", 2),
    ("damping_work_J", "work of the damper", "J", 0),
)


def tables(entries: Sequence[Mapping[str, Any]]) -> list[Table]:
    """One table for each drive: a line per figure, a column per oil level and model."""
    drives: dict[tuple[Any, ...], list[Mapping[str, Any]]] = {}
    for row in entries:
        drives.setdefault((row["maneuver"], row["speed_kmh"], row["road"]), []).append(row)
    return [table(drive, rows) for drive, rows in drives.items()]


def table(drive: tuple[Any, ...], rows: Sequence[Mapping[str, Any]]) -> Table:
    """The figures of one drive; each cell is the mean over the seeds, with the range over seeds and ways."""
    maneuver, speed, road = drive
    states: dict[str, list[Mapping[str, Any]]] = {}
    for row in rows:
        states.setdefault(state_of(row), []).append(row)
    cells = []
    for name, title, unit, decimals in FIGURES:
        for wheel in WHEELS if any(isinstance(row.get(name), Mapping) for row in rows) else (None,):
            line = [cell(several, name, wheel, decimals) for several in states.values()]
            if any(line):
                place = f", {wheel.replace('_', ' ')}" if wheel else ""
                cells.append([f"{title}{place}{f' [{unit}]' if unit != '1' else ''}", *line])
    seeds = len({row["seed"] for row in rows})
    where = road if maneuver == "table3" else f"{speed:.0f} km/h, {'smooth road' if road == 'smooth' else f'class {road}'}"
    over = f"range over {seeds} seeds" if seeds > 1 else "1 seed; range over"
    caption = f"{where}: mean ({over}{' and' if seeds > 1 else ''} the ways of the freed gas)"
    return Table(["figure", *states], cells, caption, numeric=range(1, len(states) + 1))


def state_of(row: Mapping[str, Any]) -> str:
    """The column of a drive."""
    if row["oil_level"] == 1.0:
        return "intact"
    return f"{row['oil_level']:.0%}{', scalar' if row['model'] == SCALAR else ''}"


def cell(rows: Sequence[Mapping[str, Any]], name: str, wheel: str | None, decimals: int) -> str:
    """Mean over the seeds, of the full model with the default way of the freed gas, and the range over all rows."""

    def value(row: Mapping[str, Any]) -> float | None:
        found = row.get(name)
        return found[wheel] if wheel is not None and found is not None else found

    values = [x for x in map(value, rows) if x is not None]
    usual = [x for x in map(value, (row for row in rows if row["model"] in (DEFAULT, SCALAR))) if x is not None]
    if not usual:
        return "not driven" if values == [] and any("failed" in row for row in rows) else ""
    low, mean, high = (f"{x:.{decimals}f}" for x in (min(values), sum(usual) / len(usual), max(values)))
    return f"{mean} ({low} to {high})"
