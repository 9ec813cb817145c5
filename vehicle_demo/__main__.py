"""The main job: damper -> FMU -> fmpy -> quarter car on a class D road -> wheel-load fluctuation over oil loss."""

import json
import tempfile
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import fields
from pathlib import Path
from typing import Annotated, Any

import fmpy
import typer
from tqdm import tqdm

import build_fmu
from twintube import effects, road
from twintube.drive import CORNERS, axle
from twintube.parameters import Damper, ParameterError, load
from twintube.quarter_car import Car, static_load
from twintube.variables import fmi_name
from vehicle_demo.damper_fmu import FmuError
from vehicle_demo.measures import measures
from vehicle_demo.ride import Case, Ride, heights, ride

SPEEDS = (30.0, 50.0)  # [km/h]
FIGURES = ("dlc", "wheel_load_rms_N", "min_wheel_load_N", "contact_loss_share")
WIDTHS = (5, 7, 6, 9, 7, 6, 6, 10, 9)  # of the table's columns
LEVELS = (1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3)


def strengths(damper: Damper) -> tuple[str, ...]:
    """The FMU's names of the strengths of the damper's effects."""
    table = {item.name: item for item in fields(effects.Parameters)}
    return tuple(fmi_name(table[name]) for name in effects.neutral(damper.parameters))


def cases(off: tuple[str, ...]) -> list[Case]:
    """Intact, all oil levels without preload, and the scalar-factor damper of variant 1, at both speeds.

    Where the damper has effects, also the same without them, their strengths `off`.
    """
    found = []
    for speed in SPEEDS:
        if off:
            found.append(Case(speed, 1.0, 1, off=off))
            found += [Case(speed, level, 0, off=off) for level in LEVELS]
        found.append(Case(speed, 1.0, 1))
        found += [Case(speed, level, 0) for level in LEVELS]
        found += [Case(speed, level, 0, scalar=True) for level in LEVELS]
    return found


def corner(damper: Damper) -> Car:
    """The corner of the car that the damper sits in; its spring is set for the intact damper."""
    return Car(**CORNERS[axle(damper)], F_rest=-damper.parameters.F_0)


def run(fmu: Path, car: Car, case: Case, seconds: float, dt: float, seed: int) -> Ride:
    """One case, in a process of its own."""
    return ride(fmu, car, case, heights(case, seconds, dt, seed), dt)


def run_all(fmu: Path, car: Car, todo: list[Case], seconds: float, dt: float, seed: int) -> list[Ride]:
    """All cases on all cores, in their order."""
    with ProcessPoolExecutor() as pool:
        futures = {pool.submit(run, fmu, car, case, seconds, dt, seed): i for i, case in enumerate(todo)}
        done = {}
        for future in tqdm(as_completed(futures), total=len(todo), unit="ride", desc="quarter car"):
            done[futures[future]] = future.result()
    return [done[i] for i in range(len(todo))]


def summary(damper: Damper, car: Car, rides: list[Ride], seconds: float, dt: float, seed: int) -> dict[str, Any]:
    """Everything that the pictures show, as numbers."""
    static = static_load(car)
    profile = road.generate(seconds * max(SPEEDS) / 3.6, seed=seed)
    centres, density = road.measured_density(profile.height)
    speeds = []
    for speed in SPEEDS:
        of_speed = [r for r in rides if r.case.speed_kmh == speed]
        full = [measures(r, static) for r in of_speed if not r.case.scalar and not r.case.off]
        plain = {(r.case.oil_level, r.case.gas_preload): measures(r, static) for r in of_speed if r.case.off}
        for entry in full:
            if plain:
                other = plain[entry["oil_level"], entry["gas_preload"]]
                entry["without_effects"] = {name: other[name] for name in FIGURES}
        scalar = {r.case.oil_level: measures(r, static) for r in of_speed if r.case.scalar}
        for entry in full[1:]:
            other = scalar[entry["oil_level"]]
            entry["scalar_factor"] = {name: other[name] for name in FIGURES}
        speeds.append({"speed_kmh": speed, "intact": full[0], "oil_levels": full[1:]})
    return {
        "damper": damper.name,
        "axle": axle(damper),
        "effects": list(effects.active(damper.parameters)),
        "assumed": dict(damper.assumed) | {"vehicle": "a corner of a car of the Passat B8 class, see twintube.quarter_car"},
        "road": {
            "class": "D",
            "seed": seed,
            "length_without_repetition_m": profile.length,
            "gd_n0_m3": road.measured_gd_n0(profile.height),
            "density_m3_by_octave": dict(zip(map(float, centres), map(float, density), strict=True)),
        },
        "step_s": dt,
        "seconds": seconds,
        "static_wheel_load_N": static,
        "speeds": speeds,
    }


def table(result: dict[str, Any]) -> str:
    """The figures for the terminal."""
    plain = "no effect" if result["effects"] else ""
    head = ("km/h", "oil", "DLC", plain, "scalar", "RMS N", "min N", "no contact", "damper J")
    lines = [" ".join(f"{name:>{width}}" for name, width in zip(head, WIDTHS, strict=True))]
    for block in result["speeds"]:
        for entry in [block["intact"], *block["oil_levels"]]:
            name = "intact" if entry["gas_preload"] else f"{entry['oil_level']:.0%}"
            scalar = f"{entry['scalar_factor']['dlc']:.3f}" if "scalar_factor" in entry else ""
            plain = f"{entry['without_effects']['dlc']:.3f}" if "without_effects" in entry else ""
            cells = (
                f"{block['speed_kmh']:.0f}", name, f"{entry['dlc']:.3f}", plain, scalar, f"{entry['wheel_load_rms_N']:.0f}",
                f"{entry['min_wheel_load_N']:.0f}", f"{entry['contact_loss_share']:.2%}", f"{entry['damping_work_J']:.0f}",
            )  # fmt: skip
            lines.append(" ".join(f"{cell:>{width}}" for cell, width in zip(cells, WIDTHS, strict=True)))
    return "\n".join(lines)


app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)


@app.command(epilog="Example: python -m vehicle_demo --damper SA7 --output results/front")
def main(
    output: Annotated[Path, typer.Option(help="Folder for summary.json and the pictures.")] = Path("results/vehicle_demo"),
    damper: Annotated[str, typer.Option(help="A named damper or a parameter file.")] = "SA8",
    seconds: Annotated[float, typer.Option(help="Length of each ride [s].", min=10.0, max=3600.0)] = 60.0,
    step_ms: Annotated[float, typer.Option(help="Communication step [ms].", min=0.05, max=1.0)] = 1.0,
    seed: Annotated[int, typer.Option(help="Seed of the road.")] = 1,
) -> None:
    """Drive a quarter car over a class D road with the damper FMU, from intact to 30 % oil.

    A damper with effects, such as the extended.toml of a diagnosis, is driven without them too, which shows what they do.
    """
    from vehicle_demo.pictures import draw

    try:
        chosen = load(damper)
        car = corner(chosen)
        output.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as folder:
            fmu = build_fmu.build(chosen, Path(folder), platforms=(fmpy.platform,))
            rides = run_all(fmu, car, cases(strengths(chosen)), seconds, step_ms * 1e-3, seed)
        result = summary(chosen, car, rides, seconds, step_ms * 1e-3, seed)
        pictures = draw(output, chosen, rides, result)
        part = output / "summary.json.part"
        part.write_text(json.dumps(result, indent=1), encoding="utf-8")
        part.replace(output / "summary.json")
    except (ParameterError, build_fmu.BuildError, FmuError, OSError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None
    typer.echo(f"{chosen.name} in the {axle(chosen)} corner of a car of the Passat B8 class (assumed)")
    typer.echo(table(result))
    typer.echo(f"{output / 'summary.json'} and {', '.join(p.name for p in pictures)}")


if __name__ == "__main__":
    app()
