"""What the whole car does: rides, braking, cornering, and the ten drives of the paper's Table 3."""

from dataclasses import dataclass

import numpy as np

from twintube.common.arrays import Array
from twintube.engine.simulate import InputError
from twintube.vehicle import maneuvers as table3
from twintube.vehicle.full.run import DT, CarRun, FullCar, drive_car
from twintube.vehicle.road import GD_N0, SPACING
from twintube.vehicle.tracks import tracks

FADE = 30.0  # [m] over which an uneven road begins
APPROACH = 5.0  # [s] at constant speed before braking or steering, for oil and body to settle on the road
PRESSURE = 1.5e7  # [Pa] that the driver wants in an emergency stop
STEER_RATE = 0.5  # [deg/s] at the wheel
MOST_STEER = 40.0  # [deg] at the wheel
MOST_LATERAL, MOST_SLIP = 11.0, 6.0  # [m/s2], [deg] of the front tyres: where the steering ends, beyond the largest force
SMOOTH = "smooth"
CLASSES = (SMOOTH, *GD_N0)
GRIPS = (0.1, 1.5)  # ice to a racing tyre
SLOWEST, FASTEST = 1.0, 250.0  # [km/h]


@dataclass(frozen=True)
class Road:
    """Which road: smooth or a class of ISO 8608, its seed, whether left and right are equal, and their grips.

    A grip is the factor of all tyre forces against those of the tyre's dry road. `apart` is the distance of the tracks on an
    isotropic surface over that on this road: below 1 left and right agree in shorter waves too.
    """

    kind: str = "D"
    seed: int = 1
    equal: bool = False
    grips: tuple[float, float] = (1.0, 1.0)
    apart: float = 1.0

    def __post_init__(self) -> None:
        """Raises InputError for an unknown class and for a grip out of GRIPS."""
        if self.kind not in CLASSES:
            raise InputError(f"road class {self.kind}: must be one of {', '.join(CLASSES)}")
        for side, grip in zip(("left", "right"), self.grips, strict=True):
            if not GRIPS[0] <= grip <= GRIPS[1]:
                raise InputError(f"grip {grip:g} on the {side}: must be from {GRIPS[0]:g} to {GRIPS[1]:g}")

    def heights(self, car: FullCar, length: float) -> Array:
        """Heights (2, m) [m] of the tracks for a drive of `length` [m]; they begin at 0."""
        whole = length + car.body.wheelbase + 1.0
        if self.kind == SMOOTH:
            return np.zeros((2, int(whole / SPACING) + 2))
        apart = self.apart * float(np.mean([wheel.track for wheel in car.wheels]))
        ground = tracks(whole, apart, road_class=self.kind, seed=self.seed, equal=self.equal)
        place = np.arange(ground.shape[1]) * SPACING
        heights: Array = (ground - ground[:, :1]) * np.clip(place / FADE, 0.0, 1.0)
        return heights


def checked_speed(speed_kmh: float) -> float:
    """The speed [m/s]; raises InputError."""
    if not SLOWEST <= speed_kmh <= FASTEST:
        raise InputError(f"speed {speed_kmh:g} km/h: must be from {SLOWEST:g} to {FASTEST:g} km/h")
    return speed_kmh / 3.6


def ride(car: FullCar, speed_kmh: float, seconds: float, road: Road, dt: float = DT) -> CarRun:
    """Straight ahead at constant speed; raises InputError."""
    speed = checked_speed(speed_kmh)
    inputs = np.zeros((round(seconds / dt), 3))
    inputs[:, 2] = speed
    # On a rough road the speed that is held swings, and the road must not end before the time.
    return drive_car(car, road.heights(car, 1.1 * speed * seconds), SPACING, inputs, speed, grips=road.grips, dt=dt)


def braking(car: FullCar, speed_kmh: float, road: Road, dt: float = DT) -> CarRun:
    """An emergency stop with slip control, brakes from APPROACH on; ends when the car stands. Raises InputError."""
    speed = checked_speed(speed_kmh)
    slow = min(1.0, float(np.mean(road.grips)))
    # Even a third of the deceleration of such a road stops the car in this time.
    seconds = APPROACH + 1.0 + speed / (3.0 * slow)
    time = np.arange(round(seconds / dt)) * dt
    inputs = np.zeros((len(time), 3))
    inputs[:, 1] = PRESSURE * (time >= APPROACH)
    inputs[:, 2] = speed * (time < APPROACH)
    return drive_car(
        car, road.heights(car, speed * (APPROACH + speed / (4.0 * slow))), SPACING, inputs, speed, grips=road.grips, dt=dt
    )


def cornering(car: FullCar, speed_kmh: float, road: Road, dt: float = DT) -> CarRun:
    """Constant speed with evenly growing steer angle, to the left, from APPROACH on (ISO 13674-like); raises InputError."""
    speed = checked_speed(speed_kmh)
    # What the steering gives way by: the outer wheel carries at most twice its load.
    gives = max(2.0 * wheel.steer_compliance * wheel.weight for wheel in car.wheels)
    most = np.degrees(car.body.wheelbase * MOST_LATERAL / speed**2 + gives) + MOST_SLIP
    seconds = APPROACH + float(min(most, MOST_STEER)) / STEER_RATE
    time = np.arange(round(seconds / dt)) * dt
    inputs = np.zeros((len(time), 3))
    inputs[:, 0] = np.radians(STEER_RATE) * np.clip(time - APPROACH, 0.0, None)
    inputs[:, 2] = speed
    return drive_car(car, road.heights(car, 1.1 * speed * seconds), SPACING, inputs, speed, grips=road.grips, dt=dt)


def table3_drive(
    car: FullCar, drive: table3.Maneuver, seed: int = 1, grips: tuple[float, float] = (1.0, 1.0), dt: float = DT
) -> CarRun:
    """A drive of Table 3, both tracks equal but on the uneven road; braked ones with 6 m/s2 from 3 s on."""
    speed = drive.speed_kmh / 3.6
    time = np.arange(round(drive.seconds / dt)) * dt
    if drive.profile is table3.uneven:
        heights = Road("D", seed).heights(car, speed * drive.seconds)
    else:
        place = np.arange(int((speed * drive.seconds + car.body.wheelbase + 2.0) / SPACING)) * SPACING
        # The obstacle is as far ahead of the front axle as it is of the wheel in the paper's plan.
        single = drive.profile(np.clip(place - car.body.wheelbase, 0.0, None), seed)
        heights = np.vstack([single, single])
    inputs = np.zeros((len(time), 3))
    inputs[:, 2] = speed
    if drive.braked:
        on = time >= table3.APPROACH
        gain = 2.0 * sum(wheel.brake / wheel.radius for wheel in car.wheels[::2])
        inputs[on, 1] = car.mass * table3.BRAKING / gain
        inputs[on, 2] = 0.0
    return drive_car(car, heights, SPACING, inputs, speed, grips=grips, dt=dt)
