"""What a ride says about road holding."""

from typing import Any

import numpy as np

from twintube.arrays import Array
from vehicle_demo.ride import EVERY, Ride

SETTLED = 5.0  # [s] left out at the start of a ride
WINDOW = 10.0  # [s] over which the development is reported


def dynamic_load_coefficient(load: Array, static: float) -> float:
    """Standard deviation of the wheel load over the static load [1]."""
    return float(np.std(load) / static)


def measures(ride: Ride, static: float) -> dict[str, Any]:
    """The figures of a ride, JSON ready; loads [N], work [J], shares and coefficients [1]."""
    steady = ride.time >= SETTLED
    load = ride.wheel_load[steady]
    lost = load <= 0.0
    dt = float(ride.time[1])
    case = ride.case
    found: dict[str, Any] = {
        "oil_level": case.oil_level,
        "gas_preload": case.gas_preload,
        "dlc": dynamic_load_coefficient(load, static),
        "wheel_load_rms_N": float(np.sqrt(np.mean((load - static) ** 2))),
        "min_wheel_load_N": float(load.min()),
        "contact_loss_share": float(lost.mean()),
        "contact_losses": int(np.count_nonzero(lost[1:] & ~lost[:-1])),
        "largest_stroke_mm": float(np.abs(ride.stroke).max() * 1e3),
    }
    if case.scalar or case.off:
        return found
    found["damping_work_J"] = float(ride.work[-1])
    development = []
    for start in np.arange(0.0, ride.time[-1] - WINDOW + dt, WINDOW):
        inside = (ride.time >= max(start, 1.0)) & (ride.time < start + WINDOW)
        ends = np.searchsorted(ride.time[::EVERY], [start, start + WINDOW - EVERY * dt])
        development.append(
            {
                "from_s": float(start),
                "to_s": float(start + WINDOW),
                "dlc": dynamic_load_coefficient(ride.wheel_load[inside], static),
                "contact_loss_share": float((ride.wheel_load[inside] <= 0.0).mean()),
                "damping_work_J": float(ride.work[ends[1]] - ride.work[ends[0]]),
                "oil_mL": float(ride.volumes[ends[1]][[0, 3, 6]].sum() * 1e6),
            }
        )
    found["development"] = development
    return found
