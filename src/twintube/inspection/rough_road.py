"""The figure of `tiring` without a bench: the damper's velocity in the last seconds of a rough road over the first ones."""

from twintube.dampers import Damper
from twintube.inspection.tiring import rms
from twintube.vehicle.quarter_car import Car
from twintube.vehicle.ride import Track, ride

AFTER = 2.0  # [s] in which the road has faded in and the body has swung
LASTS = 5.0  # [s] at either end: some 60 swings of the wheel; the damper is to be as new in the first of them


def road_growth(damper: Damper, car: Car, track: Track, intact: Damper | None = None) -> float:
    """Root mean square of the damper's velocity in the last LASTS seconds of a ride over that in the first, after AFTER.

    A road is not equally rough at both ends: with `intact`, the figure is over that damper's on the same track. Raises
    InputError if the piston would leave the tube.
    """
    velocity = ride(damper, car, track).velocity
    begin, length = round(AFTER / track.dt), round(LASTS / track.dt)
    growth = rms(velocity[-length:]) / rms(velocity[begin : begin + length])
    return growth / road_growth(intact, car, track) if intact else growth
