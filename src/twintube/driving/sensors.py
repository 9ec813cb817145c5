"""What the sensors of a car make of its motion, and how its bus says it: encoders, inertial sensors, messages.

Sources. Bus of the Volkswagen MQB platform, of which the Passat B8 is one: scaling of each signal in `vw_mqb_2010.dbc`
(commaai/opendbc), messages of 10 and 20 ms as openpilot checks them. Inertial sensor Bosch SMI700, product sheet: noise 6 mg
and 0.1 deg/s root mean square, corner frequency 11, 18, 21 or 77 Hz. Encoder: its errors repeat with each turn of the wheel
(N. Persson and F. Gustafsson, "Event Based Sampling with Application to Vibration Analysis in Pneumatic Tires", Linköping
2001, LiTH-ISY-R-2374). Assumed: 48 teeth (a Hyundai Tiburon of 2007 has 44, by its service manual), size of their errors,
clock of the controller, order of the filters, ratio of the steering, and the vertical accelerometers of cars with controlled
dampers.

Left out: offsets and their drift, which the controller takes away, misalignment, delays and lost messages of the bus.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import signal

from twintube.common.arrays import Array
from twintube.driving.channels import PLACES
from twintube.vehicle.quarter_car import GRAVITY

RASTER: Final = 0.01  # [s] of the fastest messages
SLOW: Final = 0.02  # [s] of the others
TEETH: Final = 48
CLOCK: Final = 1e-6  # [s] by which the controller counts the time of a tooth: assumed
WHEEL_SPEED: Final = 0.0075 / 3.6  # [m/s] resolution of the bus, by the rolling radius of the data sheet
STEERING: Final = np.radians(0.1) / 16.0  # [rad] at the wheels: 0.1 deg at the hand wheel, ratio 16 (assumed)
OUTSIDE: Final = 0.5  # [K] resolution of the air's temperature on the bus: assumed
ORDER: Final = 2  # of the sensors' filters: assumed


@dataclass(frozen=True)
class Inertial:
    """A sensor: corner frequency [Hz], noise (root mean square) and resolution of the bus in SI units."""

    corner: float
    noise: float
    resolution: float
    interval: float = SLOW


INERTIAL: Final = {
    "accel_x_m_per_s2": Inertial(18.0, 6e-3 * GRAVITY, 0.03125),
    "accel_y_m_per_s2": Inertial(18.0, 6e-3 * GRAVITY, 0.01 * GRAVITY),
    "yaw_rate_rad_per_s": Inertial(18.0, np.radians(0.1), np.radians(0.01)),
    "brake_pressure_pa": Inertial(18.0, 0.0, 0.3e5),
}
# Of cars with controlled dampers; assumed: half a per cent of a range of 12 g at the wheels and 1.6 g at the body.
VERTICAL: Final = {
    **{f"wheel_accel_{place}_m_per_s2": Inertial(40.0, 0.5, 0.1, RASTER) for place in PLACES},
    "body_accel_z_m_per_s2": Inertial(40.0, 0.08, 0.01, RASTER),
}


@dataclass(frozen=True)
class Encoder:
    """The teeth of a wheel: how far each is from its place [pitches], (TEETH,)."""

    errors: Array

    @classmethod
    def drawn(cls, random: np.random.Generator, scatter: float, runout: float) -> "Encoder":
        """Teeth that `scatter` [pitches, root mean square] and an encoder ring with a `runout` over its radius."""
        turn = 2.0 * np.pi * (np.arange(TEETH) / TEETH + random.uniform())
        # A ring off its centre shows a tooth early on one side and late on the other, by its runout over the radius [rad].
        errors = scatter * random.standard_normal(TEETH) + runout * np.sin(turn) / (2.0 * np.pi / TEETH)
        return cls(errors)


def rounded(values: Array, resolution: float) -> Array:
    """Values as whole steps of a resolution."""
    return np.asarray(np.round(values / resolution) * resolution)


def wheel_speed(spin: Array, dt: float, encoder: Encoder, radius: float) -> Array:
    """The wheel speed [rad/s] on the bus, every RASTER, of a `spin` (n,) every `dt` [s]; `radius` [m] of the data sheet.

    The controller divides the teeth that passed since the last message by the time between the last one of then and of now.
    """
    pitch = 2.0 * np.pi / TEETH
    angle = np.concatenate([[0.0], np.cumsum(spin) * dt])
    number = np.arange(1, int(angle[-1] / pitch))
    time = np.interp((number + encoder.errors[number % TEETH]) * pitch, angle, np.arange(len(angle)) * dt)
    time = np.concatenate([[0.0], rounded(time, CLOCK)])
    last = np.searchsorted(time, np.arange(round(len(spin) * dt / RASTER) + 1) * RASTER, side="right") - 1
    teeth = np.diff(last)
    passed = teeth > 0
    speeds = np.zeros(len(teeth))
    speeds[passed] = teeth[passed] * pitch / (time[last[1:]] - time[last[:-1]])[passed]
    # Without a tooth since the last message its speed stays.
    speeds = speeds[np.maximum.accumulate(np.where(passed, np.arange(len(teeth)), 0))]
    return rounded(speeds, WHEEL_SPEED / radius)


def sensed(values: Array, dt: float, sensor: Inertial, random: np.random.Generator) -> Array:
    """What a sensor says of `values` (n,) every `dt` [s], on the raster of the bus; slower messages are repeated."""
    sections = signal.butter(ORDER, sensor.corner, fs=1.0 / dt, output="sos")
    start = signal.sosfilt_zi(sections) * values[0]
    filtered, _ = signal.sosfilt(sections, values, zi=start)
    taken = filtered[:: round(sensor.interval / dt)]
    taken = rounded(taken + sensor.noise * random.standard_normal(len(taken)), sensor.resolution)
    return np.repeat(taken, round(sensor.interval / RASTER))[: round(len(values) * dt / RASTER)]


def resolutions(radius: float, names: Mapping[str, object]) -> dict[str, dict[str, float]]:
    """Sample interval [s] and resolution [the channel's unit] of the channels `names`."""
    known = {
        **{f"wheel_speed_{place}_rad_per_s": (RASTER, WHEEL_SPEED / radius) for place in PLACES},
        "steering_angle_rad": (RASTER, float(STEERING)),
        "ambient_temperature_degC": (RASTER, OUTSIDE),
        **{name: (sensor.interval, float(sensor.resolution)) for name, sensor in (INERTIAL | VERTICAL).items()},
    }
    return {name: {"sample_interval_s": known[name][0], "resolution": known[name][1]} for name in names}
