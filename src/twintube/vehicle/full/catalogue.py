"""All manoeuvres of the whole car: how each is driven, which figures it has, and which of them is compared."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from twintube.dampers.freed_gas import DEFAULT
from twintube.vehicle import maneuvers as table3
from twintube.vehicle.full import figures as shown
from twintube.vehicle.full import maneuvers as driven
from twintube.vehicle.full import standard_figures as judged
from twintube.vehicle.full import standards
from twintube.vehicle.full.lane_change import lane_change
from twintube.vehicle.full.maneuvers import SMOOTH, Road
from twintube.vehicle.full.run import CarRun, FullCar

RIDE_SECONDS = 30.0
TABLE_3 = {drive.name: drive for drive in table3.MANEUVERS}


@dataclass(frozen=True)
class Case:
    """A drive: what is driven, on which road, and how worn the dampers are."""

    maneuver: str
    speed_kmh: float
    road: str  # of the drives of Table 3 their name
    seed: int
    oil_level: float = 1.0
    model: str = DEFAULT  # a way, or SCALAR
    grips: tuple[float, float] = (1.0, 1.0)  # of the left and the right track
    gas_preload: float = 1.0  # share [1] of the worn dampers

    @property
    def intact(self) -> bool:
        """Whether nothing is worn."""
        return self.oil_level == 1.0 and self.gas_preload == 1.0

    @property
    def ground(self) -> Road:
        """The road; raises InputError for an unknown class."""
        return Road(self.road, self.seed, grips=self.grips)


@dataclass(frozen=True)
class Maneuver:
    """A manoeuvre: `headline` and `beside` are name, title and unit of the figure compared and of those shown with it."""

    title: str
    headline: tuple[str, str, str]
    drive: Callable[[FullCar, Case], CarRun]
    figures: Callable[[FullCar, Case, CarRun], dict[str, Any]]
    beside: tuple[tuple[str, str, str], ...] = ()
    speeds: tuple[float, ...] = (80.0,)  # [km/h] where none are given
    standard: str = ""
    smooth: bool = True  # whether it is driven on smooth roads
    uneven: bool = True  # and on uneven ones
    without: str = "not driven"  # what no figure means, where it was driven
    seeded: bool = False  # whether seeds differ on a smooth road, by the slip control


# Endings of the figures that a few seconds of an uneven road do not give: gradients, responses, steady values.
OF_SMOOTH_ROADS = ("per_g", "t90_s", "peak_ratio", "peak_time_s", "gain_1_s")


def readable(figures: dict[str, Any], case: Case) -> dict[str, Any]:
    """The figures that the road allows."""
    if case.road == SMOOTH:
        return figures
    return {name: value for name, value in figures.items() if not name.endswith(OF_SMOOTH_ROADS)}


DLC = ("dlc_worst", "largest DLC of a wheel", "1")
SLIP = ("side_slip_max_deg", "largest side slip angle", "deg")
ROLL = ("roll_max_deg", "largest roll angle", "deg")
YAW = ("yaw_rate_max_deg_s", "largest yaw rate", "deg/s")
STOP = ("stopping_distance_m", "stopping distance", "m")
MANEUVERS: Final = {
    "ride": Maneuver(
        "Ride", DLC,
        lambda car, case: driven.ride(car, case.speed_kmh, RIDE_SECONDS, case.ground),
        lambda car, case, run: shown.ride_figures(car, run), speeds=(50.0, 80.0), smooth=False,
    ),
    "braking": Maneuver(
        "Braking", STOP,
        lambda car, case: driven.braking(car, case.speed_kmh, case.ground),
        lambda car, case, run: shown.braking_figures(car, run),
        (YAW, ("heading_max_deg", "largest heading", "deg"), ("side_offset_max_m", "largest side offset", "m")),
        speeds=(50.0, 80.0), seeded=True,
    ),
    "cornering": Maneuver(
        "Cornering", ("lateral_acceleration_max_m_s2", "largest lateral acceleration", "m/s2"),
        lambda car, case: driven.cornering(car, case.speed_kmh, case.ground),
        lambda car, case, run: readable(shown.cornering_figures(car, run), case), speeds=(50.0, 80.0),
    ),
    "step_steer": Maneuver(
        "Step steer", ROLL,
        lambda car, case: standards.step_steer(car, case.speed_kmh, case.ground),
        lambda car, case, run: readable(judged.step_figures(car, run), case),
        (
            ("yaw_rate_t90_s", "response time of the yaw rate", "s"),
            ("yaw_rate_peak_ratio", "peak of the yaw rate over steady", "1"),
            ("roll_peak_ratio", "peak of the roll angle over steady", "1"),
            ("yaw_rate_gain_1_s", "yaw rate gain", "1/s"),
        ),
        standard="ISO 7401:2011, clause 10: step to a steady 4 m/s2",
    ),
    "sine_with_dwell": Maneuver(
        "Sine with dwell", ("amplitude_passed_A", "largest steering passed", "A"),
        lambda car, case: standards.sine_with_dwell(car, case.speed_kmh, case.ground),
        lambda car, case, run: judged.sine_figures(car, run, case.speed_kmh, case.ground),
        (
            ("yaw_ratio_1_s", "yaw rate 1 s after the steering over its peak", "1"),
            ("yaw_ratio_1.75_s", "1.75 s after it", "1"),
            ("displacement_1.07_s_m", "displacement after 1.07 s", "m"), SLIP,
        ),
        standard="49 CFR 571.126 (FMVSS 126) S5.2, S7.9, by steps of 0.5 A, figures beside it at 5 A; without the stability "
        "control that it asks for",
        without="no steering passed",
    ),
    "lane_change": Maneuver(
        "Obstacle avoidance", ("entry_speed_max_kmh", "highest entry speed passed", "km/h"),
        lambda car, case: lane_change(car, case.speed_kmh, case.ground),
        lambda car, case, run: judged.lane_figures(car, run, case.speed_kmh, case.ground),
        (
            ("out_of_lane_m", "out of the lanes, below 0 the room left", "m"),
            ("steer_rate_rms_deg_s", "steering work: rate, rms", "deg/s"), SLIP,
        ),
        speeds=(60.0,), standard="ISO 3888-2:2011, Table 1", without="no entry passed",
    ),
    "circle": Maneuver(
        "Steady circle", ("understeer_deg_per_g", "understeer gradient", "deg/g"),
        lambda car, case: standards.circle(car, case.speed_kmh, case.ground),
        lambda car, case, run: judged.circle_figures(car, run),
        (
            ("roll_deg_per_g", "roll gradient", "deg/g"),
            ("lateral_acceleration_max_m_s2", "largest lateral acceleration", "m/s2"),
        ),
        speeds=(120.0,), standard="ISO 4138:2021, constant radius of 100 m, faster and faster", uneven=False,
    ),
    "braking_in_turn": Maneuver(
        "Braking in a turn", STOP,
        lambda car, case: standards.braking_in_turn(car, case.speed_kmh, case.ground),
        lambda car, case, run: judged.turn_figures(car, run),
        (
            ("yaw_ratio_braked", "yaw rate 1 s after the brakes over that of the circle", "1"), YAW,
            ("side_slip_change_deg", "change of the side slip angle", "deg"),
            ("off_circle_m", "off the circle, outside positive", "m"),
        ),
        standard="ISO 7975:2019: circle of 100 m, steering held, here an emergency stop", seeded=True,
    ),
    "table3": Maneuver(
        "Drives of Table 3", DLC,
        lambda car, case: driven.table3_drive(car, TABLE_3[case.road], case.seed, case.grips),
        lambda car, case, run: shown.ride_figures(car, run, settled=0.0),
    ),
}  # fmt: skip
STANDARDS = tuple(name for name, each in MANEUVERS.items() if each.standard)
