"""What the car exchanges with other simulators: the variables of its FMU beside the parameters of its file."""

from dataclasses import dataclass

from twintube.core.variables import var


@dataclass(slots=True)
class DriverInputs:
    """What the driver does, and the road's grip."""

    steer: float = var("", "", "rad", "steer angle of the steered wheels, to the left", lower=-1.5, upper=1.5, default=0.0)
    brake_pressure: float = var(
        "", "p", "Pa", "brake pressure that the driver wants", lower=0, upper=1e8, default=0.0, nominal=1e6
    )
    speed: float = var("", "", "m/s", "speed that the driver holds, 0: none", lower=0, upper=150, default=0.0, nominal=10.0)
    torque: float = var(
        "", "", "N.m", "drive torque beside that which holds the speed", lower=-1e5, upper=1e5, default=0.0, nominal=100.0
    )
    grip: float = var("", "", "1", "factor of all tyre forces", lower=1e-9, upper=2, default=1.0)


@dataclass(slots=True)
class WheelInputs:
    """Of each wheel; the car starts on a flat road at height 0."""

    force: float = var("", "F", "N", "force of the damper, as its FMU gives it", lower=-1e6, upper=1e6, default=0.0)
    road: float = var("", "", "m", "height of the road under the wheel", lower=-1e4, upper=1e4, default=0.0)
    road_rate: float = var("", "", "m/s", "rate of this height as the car drives on", lower=-1e3, upper=1e3, default=0.0)


@dataclass(slots=True)
class BodyOutputs:
    """Of the body; axes as in `car.py`."""

    x: float = var("motion", "x", "m", "place of the body's centre of gravity", default=0.0)
    y: float = var("motion", "y", "m", "the same, aside", default=0.0)
    z: float = var("motion", "z", "m", "height of the body above its rest", default=0.0)
    yaw: float = var("motion", "", "rad", "direction of travel", default=0.0)
    pitch: float = var("motion", "", "rad", "pitch angle, nose down", default=0.0)
    roll: float = var("motion", "", "rad", "roll angle, left side up", default=0.0)
    v_x: float = var("motion", "v_x", "m/s", "speed forward", default=0.0)
    v_y: float = var("motion", "v_y", "m/s", "speed to the left", default=0.0)
    v_z: float = var("motion", "v_z", "m/s", "speed upward", default=0.0)
    yaw_rate: float = var("motion", "", "rad/s", "yaw rate", default=0.0)
    a_x: float = var("motion", "a_x", "m/s2", "acceleration forward, at the start of the last part of a step", default=0.0)
    a_y: float = var("motion", "a_y", "m/s2", "acceleration to the left, then", default=0.0)
    a_z: float = var("motion", "a_z", "m/s2", "acceleration upward, then", default=0.0)


@dataclass(slots=True)
class WheelOutputs:
    """Of each wheel; forces and slips are those at the start of the last part of a step."""

    stroke: float = var("", "z", "m", "stroke of the damper, positive in rebound", default=0.0)
    velocity: float = var("", "", "m/s", "mean velocity of the damper over the coming step, foreseen", default=0.0)
    height: float = var("", "z_w", "m", "height of the wheel above its rest", default=0.0)
    load: float = var("", "F_z", "N", "wheel load", default=0.0)
    F_x: float = var("", "F_x", "N", "tyre force along the wheel", default=0.0)
    F_y: float = var("", "F_y", "N", "tyre force aside", default=0.0)
    slip_x: float = var("", "s_x", "1", "slip along, negative in braking", default=0.0)
    slip_y: float = var("", "s_y", "1", "slip aside", default=0.0)
    spin: float = var("", "", "rad/s", "speed of rotation", default=0.0)
    pressure: float = var("", "p", "Pa", "brake pressure", default=0.0, nominal=1e6)


@dataclass(slots=True)
class Course:
    """Lengths of communication steps, which need not be equal."""

    span: float = var("course", "", "s", "last communication step", default=0.0)
    earlier: float = var("course", "", "s", "the one before", default=0.0)
    part: float = var("course", "", "s", "part of the last communication step", default=0.0)


@dataclass(slots=True)
class Start:
    """How the car starts."""

    speed: float = var(
        "start", "v_x", "m/s", "speed at the start, straight ahead", lower=0, upper=150, default=0.0, nominal=10.0
    )
