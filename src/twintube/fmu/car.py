"""The car as a co-simulation FMU: body, wheels, tyres, brakes and driver; the damper forces are inputs."""

import html
from collections.abc import Iterator, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from twintube.common.words import printable
from twintube.fmu import archive, licences
from twintube.fmu.assemble import (
    REFUSALS,
    BuildError,
    chosen_platforms,
    file_name,
    in_order,
    native_content,
    target_file,
    written,
)
from twintube.fmu.description import EXPERIMENT, PREFIX, identifier
from twintube.fmu.documentation import STYLE, interval
from twintube.fmu.model import Model
from twintube.fmu.platforms import Fmi
from twintube.fmu.standards import STANDARDS
from twintube.fmu.table import Variable, bounds
from twintube.vehicle.full.brakes import Brakes
from twintube.vehicle.full.car import WHEELS, Layout, Suspension, Tyre
from twintube.vehicle.full.run import FullCar
from twintube.vehicle.full.signals import BodyOutputs, DriverInputs, Start, WheelInputs, WheelOutputs
from twintube.vehicle.quarter_car import Car
from twintube.version import __version__

TITLE = (
    "Car without dampers: body, four wheels, tyres, brakes and driver; damper forces in, damper strokes and velocities out"
)
PARTS = (("", Car), ("_axle", Suspension), ("_tyre", Tyre))
ABOUT = """
<p>Connect each wheel's <em>stroke</em> and <em>velocity</em> to the damper's FMU and the damper's <em>force</em> back. All
inputs are the values at the start of a communication step; a road goes on at its rate within the step. The
velocity is the mean one over the step to come, foreseen from the accelerations of the last part of a step; the force is
carried on to where the car is. Outputs change in doStep only. Steps are divided into parts of at most 1 ms. The car
starts at rest in height, straight ahead at <em>start.speed</em>, on a flat road at height 0.</p>
<p>Axes of ISO 8855: x forward, y to the left, z up; roll turns the left side up, pitch the nose down. Heights and angles are
those relative to the car at rest. <em>F_rest</em> and <em>travel</em> of an axle belong to its dampers.</p>
"""


def car_name(car: FullCar) -> str:
    """The model's name and identifier."""
    return identifier(f"{PREFIX}car_", car.name)


def variables(car: FullCar, speed: float) -> Iterator[Variable]:
    """Inputs, outputs and parameters; `speed` [m/s] is that at the start."""
    yield from exchanged(DriverInputs, "", "input", "now.driver")
    for i, wheel in enumerate(WHEELS):
        for variable in exchanged(WheelInputs, f"{wheel}.", "input", f"now.given[{i}]"):
            yield Variable(**vars(variable) | {"start": car.wheels[i].F_rest}) if variable.item.name == "force" else variable
    yield from exchanged(BodyOutputs, "motion.", "output", "now.out")
    for i, wheel in enumerate(WHEELS):
        yield from exchanged(WheelOutputs, f"{wheel}.", "output", f"now.wheel[{i}]")
    (start,) = fields(Start)
    yield Variable("start.speed", "parameter", start, -1, speed, "wanted.speed", bounds(start))
    yield from given(Layout, car.body, "body", "wanted.body")
    for axle, values in (("front", car.wheels[0]), ("rear", car.wheels[2])):
        for ending, record in PARTS:
            yield from given(record, values, f"{axle}{ending}", f"wanted.{axle}")
    yield from given(Brakes, car.brakes, "brakes", "wanted.brakes")


def exchanged(record: type, prefix: str, causality: str, place: str) -> Iterator[Variable]:
    """The fields of a record as inputs or outputs."""
    for item in fields(record):
        start = item.metadata["default"] if causality == "input" else None
        yield Variable(f"{prefix}{item.name}", causality, item, -1, start, f"{place}.{item.name}", bounds(item))


def given(record: type, values: Any, group: str, place: str) -> Iterator[Variable]:
    """The fields of a record as parameters, named as in the car's file."""
    for item in fields(record):
        value = float(getattr(values, item.name))
        yield Variable(f"{group}.{item.name}", "parameter", item, -1, value, f"{place}.{item.name}", bounds(item))


def car_model(car: FullCar, speed: float) -> Model:
    """The car as a model."""
    return Model(car_name(car), TITLE, tuple(variables(car, speed)), EXPERIMENT, "car", False)


def page(car: FullCar, model: Model) -> bytes:
    """The documentation page inside the FMU."""
    rows = "\n".join(
        f"<tr><td>{v.name}</td><td>{v.causality}</td><td>{'' if v.start is None else f'{v.start:g}'} "
        f"{'' if v.item.metadata['unit'] == '1' else v.item.metadata['unit']}</td>"
        f"<td>{html.escape(v.item.metadata['description'])} <small>{interval(*v.bounds)}</small></td></tr>"
        for v in model.variables
    )
    name = html.escape(printable(car.name))
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>twintube {name}</title><style>{STYLE}</style>'
        f"<h1>twintube: {name}</h1><p>{TITLE}. Version {__version__}.</p>{ABOUT}"
        f"<table><tr><th>name</th><th>causality</th><th>start value</th><th>meaning, range</th></tr>{rows}</table></html>"
    ).encode()


def build_car_fmu(
    car: FullCar,
    speed: float,
    output: Path | str | None = None,
    platforms: Sequence[str] | None = None,
    *,
    fmi: Fmi = 2,
) -> Path:
    """Build and validate the native FMU of a car that starts at a `speed` [m/s].

    `output`, `platforms`, `fmi` and errors as `build_fmu`.
    """
    model = car_model(car, speed)
    target = target_file(output, file_name(model.name, fmi))
    try:
        chosen = chosen_platforms(model, platforms, fmi)
        content = native_content(model, chosen, archive.build_date(), fmi)
        content |= licences.files("native", chosen, STANDARDS[fmi]) | {"documentation/index.html": page(car, model)}
        written(target, in_order(content), fmi)
    except REFUSALS as error:
        raise BuildError(str(error)) from error
    return target
