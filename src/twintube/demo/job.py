"""The main job: damper -> FMU -> fmpy -> quarter car on a class D road -> wheel-load fluctuation over oil loss."""

import json
import tempfile
from concurrent.futures import as_completed
from dataclasses import fields
from pathlib import Path
from typing import Any

import fmpy

from twintube.common.bars import Bar
from twintube.common.files import write_text
from twintube.common.processes import pool
from twintube.core import effects
from twintube.core.variables import fmi_name
from twintube.dampers import Damper
from twintube.dampers.freed_gas import AS_PUBLISHED, DEFAULT, SCALAR, WAYS, acting, as_published
from twintube.demo.bands import SPEEDS, Rides, Setting, bands, everything
from twintube.demo.moments import SPAN, Moment, moments
from twintube.demo.ride import Ride, RideCase, ride
from twintube.demo.words import sentences
from twintube.fmu import build_fmu
from twintube.vehicle import road
from twintube.vehicle.cars import CarSet, axle
from twintube.vehicle.quarter_car import Car, static_load
from twintube.vehicle.ride import WINDOW, measures, track

LEVELS = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)
MAP_SPEEDS = (20.0, 30.0, 40.0, 50.0, 60.0, 70.0)  # [km/h] of the time to failure
MAP_WAYS = (DEFAULT, AS_PUBLISHED, "pushes_oil")
MAP_LONGER = 2  # length of these rides over that of the other rides
FIGURES = ("dlc", "wheel_load_rms_N", "min_wheel_load_N", "contact_loss_share")
WIDTHS = (5, 7, 6, 13, 13, 7, 10, 6, 6, 10, 9)  # of the table's columns


def strengths(damper: Damper) -> tuple[str, ...]:
    """The FMU's names of the strengths of the damper's effects, the default for freed gas aside."""
    damper = as_published(damper)
    table = {item.name: item for item in fields(effects.Parameters)}
    return tuple(fmi_name(table[name]) for name in effects.neutral(damper.parameters))


def cases(off: tuple[str, ...]) -> list[RideCase]:
    """Intact and all oil levels without preload at both speeds, with and without the damper's effects `off`."""
    return [
        RideCase(speed, level, preload, without)
        for without in dict.fromkeys(((), off))
        for speed in SPEEDS
        for level, preload in ((1.0, 1), *((level, 0) for level in LEVELS))
    ]


def run(fmu: Path, car: Car, case: RideCase, *, seconds: float, dt: float, seed: int) -> Ride:
    """One ride; runs in a worker process."""
    return ride(fmu, car, case, track(case.speed_kmh, seconds, seed=seed, dt=dt))


def run_all(fmu: Path, car: Car, todo: list[RideCase], *, seconds: float, dt: float, seed: int) -> dict[RideCase, Ride]:
    """All cases on all cores."""
    with pool() as workers:
        futures = {workers.submit(run, fmu, car, case, seconds=seconds, dt=dt, seed=seed): case for case in todo}
        bar = Bar(as_completed(futures), total=len(todo), unit="ride", desc="quarter car with the FMU")
        return {futures[future]: future.result() for future in bar}


def development(figures: dict[str, Any]) -> list[dict[str, float]]:
    """The windows of a ride, one entry each."""
    rows = zip(figures["dlc_window"], figures["damping_work_window_J"], figures["oil_mL_window_end"], strict=True)
    return [
        {"from_s": WINDOW * i, "to_s": WINDOW * (i + 1), "dlc": d, "damping_work_J": w, "oil_mL": oil}
        for i, (d, w, oil) in enumerate(rows)
    ]


def entry(
    speed: float, level: float | None, rides_by_case: dict[RideCase, Ride], rides: Rides, car: Car, *, off: tuple[str, ...]
) -> dict[str, Any]:
    """All figures of one state at one speed for JSON; `level` None is the intact damper."""
    case = RideCase(speed, 1.0 if level is None else level, int(level is None))
    intact = rides_by_case[RideCase(speed, 1.0, 1)]
    figures = measures(rides_by_case[case], car, intact)
    head = {"oil_level": case.oil_level, "gas_preload": case.gas_preload}
    figures = head | figures | {"development": development(figures), "bands": bands(rides, speed, level)}
    if off:
        without = RideCase(case.speed_kmh, case.oil_level, case.gas_preload, off)
        compared = measures(rides_by_case[without], car, rides_by_case[RideCase(speed, 1.0, 1, off)])
        figures["without_effects"] = {name: compared[name] for name in FIGURES}
    if level is not None:
        for name, freed_gas in (("scalar_factor", SCALAR), ("bare_paper_model", AS_PUBLISHED)):
            compared = rides.results[speed, level, Setting(freed_gas=freed_gas)]
            over_time = ("dlc_window", "damping_work_window_J", "time_to_failure_s")
            figures[name] = {key: compared[key] for key in (*FIGURES, *over_time)}
    return figures


def failure_map(damper: Damper, car: CarSet, seconds: float, dt: float, seed: int) -> dict[str, Any]:
    """Time to failure [s] over speed and oil level (null: not within the ride) by what freed gas does."""
    rides = Rides(damper, car, seconds, dt, seed)
    levels = LEVELS[1:]
    settings = {name: Setting(freed_gas=name) for name in MAP_WAYS}
    rides.drive_all(MAP_SPEEDS, levels, settings.values(), "time to failure")
    return {
        "seconds": seconds,
        "speeds_kmh": list(MAP_SPEEDS),
        "oil_levels": list(levels),
        "freed_gas_ways": {
            name: [[rides.get(v, level, s, "time_to_failure_s") for level in levels] for v in MAP_SPEEDS]
            for name, s in settings.items()
        },
    }


def ride_to_show(rides_by_case: dict[RideCase, Ride], speeds: list[dict[str, Any]]) -> tuple[Ride, Ride, list[Moment]]:
    """The ride in which the damping is lost last, the ride of the intact damper, and the moments to show."""
    block = speeds[-1]
    lost = [e for e in block["oil_levels"] if e["time_to_failure_s"]]
    level = lost[0]["oil_level"] if lost else 0.6
    lossy, intact = (rides_by_case[RideCase(block["speed_kmh"], *state)] for state in ((level, 0), (1.0, 1)))
    return lossy, intact, moments(lossy, intact)


def road_figures(length: float, seed: int) -> dict[str, Any]:
    """The road of the given length [m] for JSON."""
    profile = road.generate(length, seed=seed)
    centres, density = road.measured_density(profile.height)
    return {
        "class": "D",
        "seed": seed,
        "length_without_repetition_m": (len(profile.height) - 1) * road.SPACING,
        "gd_n0_m3": road.measured_gd_n0(profile.height),
        "density_m3_by_octave": dict(zip(map(float, centres), map(float, density), strict=True)),
    }


def fmu_difference(rides_by_case: dict[RideCase, Ride], rides: Rides, car: Car) -> float:
    """Largest relative difference [1] of the DLC between the FMU and the compiled damper."""
    differences: list[float] = []
    for case, run_with_fmu in rides_by_case.items():
        if not case.off:
            compiled = rides.get(case.speed_kmh, None if case.gas_preload else case.oil_level, Setting(), "dlc")
            differences.append(abs(measures(run_with_fmu, car)["dlc"] / compiled - 1))
    return max(differences)


def moment_figures(lossy: Ride, shown: list[Moment], dt: float) -> dict[str, Any]:
    """The moments of a ride for JSON."""
    return {
        "speed_kmh": lossy.case.speed_kmh,
        "oil_level": lossy.case.oil_level,
        "moments": [
            {
                "name": moment.name,
                "from_s": moment.start,
                "to_s": moment.start + SPAN,
                "power_share": moment.power_share,
                "oil_mL": float(lossy.oil[round(moment.start / dt)] * 1e6),
            }
            for moment in shown
        ],
    }


def summary(
    damper: Damper, car: CarSet, rides_by_case: dict[RideCase, Ride], rides: Rides, *, off: tuple[str, ...], seed: int
) -> tuple[dict[str, Any], tuple[Ride, Ride, list[Moment]]]:
    """The content of summary.json, and the ride whose moments are shown."""
    corner = car.corner(damper)
    speeds: list[dict[str, Any]] = []
    for speed in SPEEDS:
        states = [entry(speed, level, rides_by_case, rides, corner, off=off) for level in (None, *LEVELS)]
        speeds.append({"speed_kmh": speed, "intact": states[0], "oil_levels": states[1:]})
    lossy, intact, moments_shown = ride_to_show(rides_by_case, speeds)
    result = {
        "damper": damper.name,
        "axle": axle(damper),
        "freed_gas": acting(damper),
        "effects": list(effects.active(as_published(damper).parameters)),
        "car": {"name": car.name, "title": car.title, "band": car.band, "assumed": dict(car.assumed)},
        "assumed": dict(damper.assumed) | {"freed_gas": "; ".join(f"{c.name}: {c.says}" for c in WAYS.values())},
        "road": road_figures(rides.seconds * max(SPEEDS) / 3.6, seed),
        "step_s": rides.dt,
        "seconds": rides.seconds,
        "static_wheel_load_N": static_load(corner),
        "largest_difference_of_dlc_fmu_to_kernel": fmu_difference(rides_by_case, rides, corner),
        "speeds": speeds,
        "time_to_failure": failure_map(damper, car, MAP_LONGER * rides.seconds, rides.dt, seed),
        "moments": moment_figures(lossy, moments_shown, rides.dt),
    }
    return result | {"sentences": sentences(result)}, (lossy, intact, moments_shown)


def table(result: dict[str, Any]) -> str:
    """The figures as a table for the terminal."""
    plain = "no effect" if result["effects"] else ""
    head = ("km/h", "oil", "DLC", "freed gas", "all bands", plain, "factor", "RMS N", "min N", "no contact", "fails at")
    lines = [" ".join(f"{name:>{width}}" for name, width in zip(head, WIDTHS, strict=True))]
    for block in result["speeds"]:
        for e in [block["intact"], *block["oil_levels"]]:
            intact = bool(e["gas_preload"])
            over_intact = e["bands"].get("all_over_intact")
            failed = e["time_to_failure_s"]
            cells = (
                f"{block['speed_kmh']:.0f}", "intact" if intact else f"{e['oil_level']:.0%}", f"{e['dlc']:.3f}",
                "{:.3f}-{:.3f}".format(*e["bands"]["freed_gas_ways"]),
                "x {:.2f}-{:.2f}".format(*over_intact) if over_intact else "",
                f"{e['without_effects']['dlc']:.3f}" if "without_effects" in e else "",
                "" if intact else f"{e['scalar_factor']['dlc']:.3f}", f"{e['wheel_load_rms_N']:.0f}",
                f"{e['min_wheel_load_N']:.0f}", f"{e['contact_loss_share']:.2%}",
                "" if failed is None else f"{failed:.0f} s",
            )  # fmt: skip
            lines.append(" ".join(f"{cell:>{width}}" for cell, width in zip(cells, WIDTHS, strict=True)))
    return "\n".join(lines)


def draw(
    folder: Path, result: dict[str, Any], rides_by_case: dict[RideCase, Ride], shown: tuple[Ride, Ride, list[Moment]]
) -> list[Path]:
    """All pictures, as PNG files in `folder`."""
    from twintube.demo import moments as moment_pictures
    from twintube.demo import pictures

    lossy, intact, moments_shown = shown
    at_speed = [r for case, r in rides_by_case.items() if case.speed_kmh == lossy.case.speed_kmh and not case.off]
    at_speed.sort(key=lambda r: (-r.case.gas_preload, -r.case.oil_level))
    return [
        pictures.dlc(folder, result),
        pictures.development(folder, result),
        pictures.failure(folder, result),
        pictures.bands(folder, result),
        moment_pictures.wheel_load(folder, result, lossy, intact, moments_shown),
        moment_pictures.loops(folder, result, lossy, intact, moments_shown),
        moment_pictures.volumes(folder, result, lossy),
        pictures.spectrum(folder, result, at_speed),
    ]


def main_job(
    damper: Damper, car: CarSet, output: Path, *, seconds: float, dt: float, seed: int
) -> tuple[dict[str, Any], list[Path]]:
    """Build the damper's FMU, drive it in every state and write `summary.json` and the pictures to `output`.

    Returns the summary and the pictures. Raises BuildError, FmuError, InputError, OSError, ParameterError.
    """
    off = strengths(damper)
    output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        fmu = build_fmu(damper, Path(folder), platforms=(fmpy.platform,))
        rides_by_case = run_all(fmu, car.corner(damper), cases(off), seconds=seconds, dt=dt, seed=seed)
    rides = Rides(damper, car, seconds, dt, seed)
    rides.drive_all(SPEEDS, LEVELS, [*everything(rides), Setting(freed_gas=SCALAR)], "bands")
    result, shown = summary(damper, car, rides_by_case, rides, off=off, seed=seed)
    pictures = draw(output, result, rides_by_case, shown)
    write_text(output / "summary.json", json.dumps(result, indent=1))
    return result, pictures
