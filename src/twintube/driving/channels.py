"""The channels of a signals file: names with units, meanings, and the values that they can have."""

from dataclasses import dataclass
from typing import Final

PLACES: Final = ("fl", "fr", "rl", "rr")  # front left, front right, rear left, rear right: the order of the car's wheels
NAMES: Final = dict(
    zip(PLACES, ("front left wheel", "front right wheel", "rear left wheel", "rear right wheel"), strict=True)
)
TIME: Final = "time_s"


@dataclass(frozen=True)
class Channel:
    """A column of a signals file: `lower` and `upper` are the values that a car can show, in `unit`."""

    name: str
    unit: str
    meaning: str
    lower: float
    upper: float
    required: bool = True


# Bounds: a wheel of 0.2 m at 80 m/s; ranges of inertial sensors (5 g, 300 deg/s); a wheel at full lock; a burst hose.
CHANNELS: Final = {
    channel.name: channel
    for channel in (
        *(
            Channel(f"wheel_speed_{place}_rad_per_s", "rad/s", f"rotation of the {name}", 0.0, 400.0)
            for place, name in NAMES.items()
        ),
        Channel("accel_x_m_per_s2", "m/s2", "acceleration along the car, forward positive", -50.0, 50.0),
        Channel("accel_y_m_per_s2", "m/s2", "lateral acceleration, to the left positive", -50.0, 50.0),
        Channel("yaw_rate_rad_per_s", "rad/s", "yaw rate, turning left positive", -5.3, 5.3),
        Channel("steering_angle_rad", "rad", "steer angle at the road wheels, to the left positive", -1.0, 1.0, False),
        Channel("brake_pressure_pa", "Pa", "brake pressure over ambient", -1e6, 3e7, False),
        *(
            Channel(f"wheel_accel_{place}_m_per_s2", "m/s2", f"vertical acceleration of the {name}", -1000.0, 1000.0, False)
            for place, name in NAMES.items()
        ),
        Channel(
            "body_accel_z_m_per_s2",
            "m/s2",
            "vertical acceleration of the body, centre of gravity",
            -100.0,
            100.0,
            False,
        ),
        Channel("ambient_temperature_degC", "degC", "temperature of the air outside", -60.0, 70.0, False),
    )
}
# What the data sheet of a car says: unit, lower and upper bound.
SHEET: Final = {
    "wheelbase_m": (0.5, 10.0),
    "track_front_m": (0.5, 3.0),
    "track_rear_m": (0.5, 3.0),
    "wheel_radius_m": (0.1, 1.0),
}


def channel_name(sensor: str, place: str) -> str:
    """The channel of a wheel's sensor: `speed` or `accel`."""
    return f"wheel_{sensor}_{place}_{'rad_per_s' if sensor == 'speed' else 'm_per_s2'}"
