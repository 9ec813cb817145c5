"""Courses of the standards' manoeuvres and of a stop, as pictures: intact, worn, and a scalar factor in its place."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from twintube.common.arrays import Array
from twintube.dampers import Damper
from twintube.dampers.freed_gas import DEFAULT, SCALAR
from twintube.engine.simulate import InputError
from twintube.report.car.figures import road_of
from twintube.report.common.html_page import Picture
from twintube.report.common.style import BLUE, GREY, INK, ORANGE, RED, grid, legend_above, title
from twintube.vehicle.cars import CarSet
from twintube.vehicle.full import standards
from twintube.vehicle.full.catalogue import MANEUVERS, Case
from twintube.vehicle.full.lane_change import entry_of, lanes, width_of
from twintube.vehicle.full.maneuvers import APPROACH
from twintube.vehicle.full.run import CarRun, full_car
from twintube.vehicle.full.standard_figures import side_slip
from twintube.vehicle.full.study import dampers_of, run_of

Read = Callable[[CarRun], Array]


def degrees(name: str) -> Read:
    """A record of the drive in degrees."""
    return lambda run: np.asarray(np.degrees(getattr(run, name)))


def since(begin: float) -> Read:
    """Time [s] since `begin`."""
    return lambda run: run.time - begin


SLIP = ("side slip angle [deg]", lambda run: np.degrees(side_slip(run)))
STEER = ("steer angle [deg]", degrees("steer"))
YAW, ROLL = ("yaw rate [deg/s]", degrees("yaw_rate")), ("roll angle [deg]", degrees("roll"))
SPEED, ASIDE = ("speed [km/h]", lambda run: 3.6 * run.v_x), ("aside [m]", lambda run: run.y)
LATERAL = ("lateral acceleration [m/s2]", lambda run: run.a_y)
# What is drawn of each: what the x axis is, from where to where, and the panels.
COURSES: Mapping[str, tuple[str, Read, tuple[float, float], tuple[tuple[str, Read], ...]]] = {
    "braking": ("time since the brakes [s]", since(APPROACH), (-0.2, 4.0), (SPEED, YAW, ASIDE)),
    "step_steer": ("time since the step [s]", since(APPROACH), (-0.2, 3.0), (YAW, LATERAL, ROLL)),
    "sine_with_dwell": ("time since the steer [s]", since(APPROACH), (-0.2, 4.5), (STEER, YAW, SLIP)),
    "lane_change": ("way [m]", lambda run: run.x, (-15.0, 85.0), (ASIDE, STEER, SLIP)),
    "circle": ("lateral acceleration [m/s2]", lambda run: run.a_y, (0.0, 9.5), (STEER, ROLL, SLIP)),
    "braking_in_turn": ("time since the brakes [s]", since(standards.TURN_APPROACH), (-0.5, 3.5), (YAW, SLIP, ROLL)),
}


@dataclass(frozen=True)
class Course:
    """A drive to its end, with what it is called and its colour."""

    case: Case
    run: CarRun
    width: float  # [m] of the car
    words: str
    colour: str


def pictures(car: CarSet, dampers: tuple[Damper, Damper], worn: str, cases: Sequence[Case], name: str) -> list[Picture]:
    """Those of a manoeuvre, one for each speed with a row for each road: first seed, intact and at the lowest oil level."""
    own = [case for case in cases if case.maneuver == name and case.seed == 1]
    if name not in COURSES or not own:
        return []
    level = min(case.oil_level for case in own)
    found = []
    for speed in dict.fromkeys(case.speed_kmh for case in own):
        bases: dict[str, Case] = {}  # the first of each road
        for case in own:
            if case.speed_kmh == speed:
                bases.setdefault(case.road, case)
        driven = {road: courses(car, dampers, worn, base, level) for road, base in bases.items()}
        caption = f"{MANEUVERS[name].title}, {speed:g} km/h, first seed."
        found.append(Picture.drawn(partial(drawn, driven), caption))
    return found


def courses(car: CarSet, dampers: tuple[Damper, Damper], worn: str, base: Case, level: float) -> list[Course]:
    """Intact and, below a full damper, worn and by a scalar factor; without those that could not be driven to the end."""
    states = [(1.0, DEFAULT, "intact", INK)]
    if level < 1.0:
        states += [(level, DEFAULT, f"{level:.0%} oil", RED), (level, SCALAR, f"{level:.0%}, scalar factor", BLUE)]
    found = []
    for oil, model, words, colour in states:
        case = replace(base, oil_level=oil, model=model)
        full = full_car(car, dampers_of(*dampers, worn, case))
        with suppress(InputError):
            found.append(Course(case, run_of(full, case), width_of(full), words, colour))
    return found


def drawn(driven: Mapping[str, Sequence[Course]], narrow: bool = False) -> Figure:
    """The panels of every road."""
    figure, axes = grid(3 * len(driven), (3.7, 2.5), narrow)
    rows = axes.reshape(len(driven), 3)
    for row, (road, several) in zip(rows, driven.items(), strict=True):
        for course in several:
            draw(row, course)
        title(row[0], road_of(road))
    legend_above(figure, *axes.flat)
    return figure


def draw(row: Sequence[Any], course: Course) -> None:
    """A drive's lines."""
    case, run = course.case, course.run
    across, at, limits, panels = COURSES[case.maneuver]
    moved = entry_of(case.speed_kmh / 3.6) if case.maneuver == "lane_change" else 0.0
    x = at(run) - moved
    keep = (x >= limits[0]) & (x <= limits[1])
    if case.maneuver == "circle":
        keep &= run.time > standards.TURN_APPROACH
    for ax, (name, read) in zip(row, panels, strict=True):
        ax.plot(x[keep][::5], read(run)[keep][::5], color=course.colour, lw=1.2, label=course.words, alpha=0.9)
        ax.set(xlabel=across, ylabel=name)
    if case.maneuver == "lane_change":
        for lane in lanes(course.width):
            for side in (lane.left, lane.right):
                row[0].plot([lane.begin, lane.end], [side, side], color=ORANGE, lw=2.0, ls=":", label="cones")
    if case.maneuver == "braking_in_turn" and case.intact:
        row[0].plot(x[keep], np.degrees(run.v_x[keep] / standards.RADIUS), color=GREY, lw=1.0, ls="--",
                    label="yaw rate of the circle at the intact car's speed")  # fmt: skip
