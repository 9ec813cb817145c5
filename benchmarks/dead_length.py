"""What hangs on the dead length, over its bounds: where the EUSAMA bench turns, and the wheel load on the road."""

from itertools import product

from twintube.dampers import Damper, load
from twintube.dampers.dead_length import collapse_level
from twintube.dampers.freed_gas import condition
from twintube.inspection import METHODS, Setting, read
from twintube.vehicle.cars import load_car
from twintube.vehicle.ride import measures, ride, track

LENGTHS = (60, 70, 80, 90, 100, 110)  # [mm]
DAMPERS = ("SA8", "SA7", "SA1")
ABOVE = 6  # [% of oil] above the level of geometry, where the search begins: a stroke of the plate spreads it by less
LEVELS, SPEEDS, WAYS = (0.5, 0.4), (30.0, 50.0), ("dissolves", "pushes_oil")
SECONDS = 120.0
LINKS = 450.0  # [N s/m] the upper end of the car's band, with which a lost damper is missed least


def turning(damper: Damper) -> int:
    """The highest oil level [%], in whole per cent, at which EUSAMA fails."""
    car = load_car().corner(damper)
    for percent in range(round(100 * collapse_level(damper)) + ABOVE, 0, -1):
        worn = damper.with_(oil_level=percent / 100, gas_preload=0)
        if not METHODS["eusama"].passed(read(worn, car, ("eusama",), Setting())["eusama"]):
            return percent
    return 0


def rises(damper: Damper, **changes: float) -> dict[str, float]:
    """Rise of the DLC over the intact damper's [%], class D road, seed 1, by oil level, speed and way of the freed gas."""
    car, found = load_car().corner(damper, **changes), {}
    for speed in SPEEDS:
        route = track(speed, SECONDS)
        intact = measures(ride(damper, car, route), car)["dlc"]
        for level, way in product(LEVELS, WAYS):
            worn = measures(ride(condition(damper, level, 0, way), car, route), car)["dlc"]
            found[f"{level:.0%} {speed:g} km/h {way}"] = round(100.0 * (worn / intact - 1.0))
    return found


def bench_dead_length() -> dict[str, dict[str, dict[str, float]]]:
    """Both tables, by dead length."""
    lengths = {f"{mm} mm": 1e-3 * mm for mm in LENGTHS}
    sa8 = load("SA8")
    wheel = {head: rises(sa8.with_(dead_length=length)) for head, length in lengths.items()}
    longest = sa8.with_(dead_length=1e-3 * LENGTHS[-1])
    wheel[f"{LENGTHS[-1]} mm, links {LINKS:g} N s/m"] = rises(longest, d_links=LINKS)
    return {
        "EUSAMA fails from [% of oil]": {
            name: {head: float(turning(load(name).with_(dead_length=length))) for head, length in lengths.items()}
            for name in DAMPERS
        },
        "rise of the DLC of SA8 [%]": wheel,
    }
