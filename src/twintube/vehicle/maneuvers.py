"""The ten drives of Table 3 as road heights under a wheel. Obstacles, speed over time and braking are assumed."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from twintube.common.arrays import Array
from twintube.vehicle import road

DT = 1e-3  # [s]
BUMP_HEIGHT, BUMP_LENGTH = 0.05, 0.5  # [m]
CLEAT_HEIGHT, CLEAT_LENGTH, CLEAT_SPACING, CLEATS = 0.02, 0.05, 4.0, 5  # [m]
WASH_AMPLITUDE, WASH_LENGTH = 0.0125, 0.5  # [m]
BRAKING = 6.0  # deceleration [m/s2]
APPROACH = 3.0  # seconds at constant speed before braking
# Load that braking moves from a rear to a front corner [N]: m a h / (2 L) with 1650 kg, 0.55 m, 2.79 m.
SHIFT = 1650.0 * BRAKING * 0.55 / (2 * 2.79)


@dataclass(frozen=True)
class Maneuver:
    """One line of Table 3; `profile` gives the height [m] at positions [m]."""

    number: int
    name: str
    speed_kmh: float
    seconds: float
    profile: Callable[[Array, int], Array]
    braked: bool = False


def bump(position: Array, _: int) -> Array:
    """A speed bump, a squared sine, 1 m ahead."""
    x = np.clip((position - 1.0) / BUMP_LENGTH, 0.0, 1.0)
    height: Array = BUMP_HEIGHT * np.sin(np.pi * x) ** 2
    return height


def cleats(position: Array, _: int) -> Array:
    """Five cleats, averaged over the tyre's contact length."""
    height = np.zeros_like(position)
    reach = (CLEAT_LENGTH + road.CONTACT_LENGTH) / 2
    for i in range(CLEATS):
        distance = np.abs(position - 2.0 - i * CLEAT_SPACING)
        overlap = np.clip(reach - distance, 0.0, min(CLEAT_LENGTH, road.CONTACT_LENGTH))
        height += CLEAT_HEIGHT * overlap / road.CONTACT_LENGTH
    return height


def washboard(position: Array, _: int) -> Array:
    """Sinusoidal waves, averaged over the tyre's contact length."""
    amplitude = WASH_AMPLITUDE * np.sinc(road.CONTACT_LENGTH / WASH_LENGTH)
    height: Array = amplitude * np.sin(2 * np.pi * position / WASH_LENGTH)
    return height


def uneven(position: Array, seed: int) -> Array:
    """Class D road."""
    profile = road.generate(float(position[-1]) + 1.0, seed=seed).at(position)
    height: Array = profile - profile[0]
    return height


def travel_time(distance: float, speed_kmh: float) -> float:
    """Seconds for a distance [m]."""
    return distance / (speed_kmh / 3.6)


ALL_CLEATS = 2.0 + CLEATS * CLEAT_SPACING
MANEUVERS = (
    Maneuver(3, "speed bump 8 km/h", 8, 4.0, bump),
    Maneuver(4, "cleats 4 km/h", 4, travel_time(ALL_CLEATS, 4), cleats),
    Maneuver(5, "cleats 20 km/h", 20, travel_time(ALL_CLEATS, 20) + 1, cleats),
    Maneuver(6, "cleats 40 km/h", 40, travel_time(ALL_CLEATS, 40) + 1, cleats),
    Maneuver(7, "washboard 4 km/h", 4, 15.0, washboard),
    Maneuver(8, "uneven road, braked from 30 km/h", 30, APPROACH + 30 / 3.6 / BRAKING + 1, uneven, braked=True),
    Maneuver(9, "uneven road, braked from 50 km/h", 50, APPROACH + 50 / 3.6 / BRAKING + 1, uneven, braked=True),
    Maneuver(10, "uneven road 4 km/h", 4, 30.0, uneven),
    Maneuver(11, "uneven road 30 km/h", 30, 20.0, uneven),
    Maneuver(12, "uneven road 50 km/h", 50, 20.0, uneven),
)


def wheel_input(maneuver: Maneuver, axle: str, seed: int = 1) -> tuple[Array, Array]:
    """Heights under the wheel [m] and load moved to the corner by braking [N], both (n,) with the time step `DT`."""
    time = np.arange(0.0, maneuver.seconds, DT)
    speed = np.full_like(time, maneuver.speed_kmh / 3.6)
    push = np.zeros_like(time)
    if maneuver.braked:
        speed = np.clip(speed - BRAKING * np.clip(time - APPROACH, 0.0, None), 0.0, None)
        # The brake pressure builds up within 0.2 s and is released at standstill.
        share = np.clip((time - APPROACH) / 0.2, 0.0, 1.0) * (speed > 0)
        push = SHIFT * share * (1.0 if axle == "front" else -1.0)
    position = np.concatenate([[0.0], np.cumsum(speed[1:] * DT)])
    height: Array = maneuver.profile(position, seed) * np.clip(time / 0.5, 0.0, 1.0)
    return height, push
