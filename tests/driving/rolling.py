"""Drives of four oscillators over a random road: quick, and with known damping ratios."""

import numpy as np

from twintube.driving.channels import PLACES
from twintube.driving.signals import Signals

SHEET = {"name": "oscillators", "wheelbase_m": 2.8, "track_front_m": 1.5, "track_rear_m": 1.5, "wheel_radius_m": 0.3}


def rolling(  # noqa: PLR0913 - a property of the drive each
    damping=(0.3, 0.3, 0.3, 0.3),
    *,
    seconds=60.0,
    speed=20.0,
    rough=1e-3,
    interval=0.01,
    noise=1e-5,
    swing=0.0,
    accels=False,
    runout=0.0,
    seed=1,
) -> Signals:
    """Signals; the rear wheels run over the road of the front wheels later. `swing` [m/s2] changes the speed slowly.

    `runout` is that of the encoders over their radius.
    """
    random = np.random.default_rng(seed)
    time = np.arange(round(seconds / interval)) * interval
    n, f = len(time), np.fft.rfftfreq(len(time), interval)
    faster = swing / 0.3 * (1.0 - np.cos(0.3 * time))
    values = {}
    for side in "lr":
        road = np.fft.rfft(random.standard_normal(n)) / np.maximum(f, 0.5)
        for end in "fr":
            zeta = damping[PLACES.index(end + side)]
            late = np.exp(-2j * np.pi * f * (SHEET["wheelbase_m"] / speed if end == "r" else 0.0))
            shown = np.fft.irfft(road * late / (1.0 - (f / 12.0) ** 2 + 2j * zeta * f / 12.0), n)
            if accels:
                values[f"wheel_accel_{end}{side}_m_per_s2"] = 0.05 * np.gradient(np.gradient(shown))
            own = speed + faster + speed * (rough * shown + noise * random.standard_normal(n))
            own *= 1.0 + runout * np.sin(np.cumsum(own) * interval / SHEET["wheel_radius_m"])
            values[f"wheel_speed_{end}{side}_rad_per_s"] = own / SHEET["wheel_radius_m"]
    values["accel_x_m_per_s2"] = np.gradient(faster, time) + 0.05 * random.standard_normal(n)
    values["accel_y_m_per_s2"] = 0.05 * random.standard_normal(n)
    values["yaw_rate_rad_per_s"] = 0.002 * random.standard_normal(n)
    values |= {"steering_angle_rad": np.zeros(n), "brake_pressure_pa": np.zeros(n)}
    return Signals(time, {name: values[name] for name in values}, SHEET)
