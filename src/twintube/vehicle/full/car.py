"""The records of the whole car: what is given of body and wheels, and what moves.

Axes of ISO 8855: x forward, y to the left, z up; roll turns the left side up, pitch the nose down. Heights and angles are
relative to the car at rest on a flat road, speeds along x and y are those of the body's centre of gravity in axes that turn
with the body. Forces are those in addition to the weight. Wheels stand in the order of WHEELS.
"""

from dataclasses import dataclass

from twintube.core.variables import var
from twintube.vehicle.quarter_car import Car

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")


@dataclass
class Layout:
    """What a car's file gives of the body, beside the masses of its corners."""

    wheelbase: float = var("body", "l", "m", "distance of the axles", lower=0.5, upper=10)
    height: float = var("body", "h", "m", "height of the body's centre of gravity above the road", lower=0.1, upper=3)
    I_roll: float = var("body", "I_x", "kg.m2", "roll inertia of the sprung mass", lower=20, upper=20000)
    I_pitch: float = var("body", "I_y", "kg.m2", "pitch inertia of the sprung mass", lower=50, upper=50000)
    I_yaw: float = var("body", "I_z", "kg.m2", "yaw inertia of the sprung mass", lower=50, upper=50000)
    drag: float = var("body", "", "kg/m", "air drag over the square of the speed: density / 2 times c_d A", lower=0, upper=5)


@dataclass
class Body(Layout):
    """The sprung mass; what follows from the corners comes last."""

    mass: float = var("body", "m", "kg", "sprung mass", default=0.0)
    x_front: float = var("body", "a", "m", "front axle ahead of its centre of gravity", default=0.0)
    x_rear: float = var("body", "b", "m", "rear axle behind its centre of gravity", default=0.0)


@dataclass
class Suspension:
    """What an axle has beside the corner of `quarter_car.Car`; equal left and right."""

    track: float = var("axle", "t", "m", "distance of left and right wheel", lower=0.5, upper=3)
    h_roll: float = var("axle", "", "m", "height of the roll centre above the road", lower=-0.5, upper=1)
    support: float = var("axle", "", "1", "lift of the body per braking force at the wheel (anti-dive)", lower=-1, upper=1)
    c_bar: float = var(
        "axle", "", "N/m", "anti-roll bar: force at each wheel per difference of the strokes", lower=0, upper=1e6
    )
    steer_compliance: float = var(
        "axle", "", "rad/N", "steer angle of a wheel out of the turn per lateral force", lower=-1e-4, upper=1e-4
    )
    steers: float = var("axle", "", "1", "share of the steer angle", lower=0, upper=1)
    drive: float = var("axle", "", "1", "share of the drive torque", lower=0, upper=1)
    brake: float = var("axle", "", "m3", "brake torque per wheel over brake pressure", lower=0, upper=1e-3)


@dataclass
class Tyre:
    """A tyre after TMeasy and its wheel; forces at nominal load, and at twice that load where the name ends with 2."""

    radius: float = var("tyre", "r", "m", "rolling radius", lower=0.1, upper=1)
    I_spin: float = var("tyre", "I_w", "kg.m2", "inertia of wheel and drive about the axle", lower=0.05, upper=50)
    F_nominal: float = var("tyre", "F_N", "N", "nominal load", lower=100, upper=1e5)
    rise_x: float = var("tyre", "dF_x0", "N", "rise of the force along over slip, at no slip", lower=1e3, upper=1e7)
    rise_x2: float = var("tyre", "", "N", "the same", lower=1e3, upper=1e7)
    s_most_x: float = var("tyre", "s_xM", "1", "slip of the largest force along", lower=0.01, upper=1)
    s_most_x2: float = var("tyre", "", "1", "the same", lower=0.01, upper=1)
    most_x: float = var("tyre", "F_xM", "N", "largest force along", lower=100, upper=1e6)
    most_x2: float = var("tyre", "", "N", "the same", lower=100, upper=1e6)
    s_slide_x: float = var("tyre", "s_xS", "1", "slip from which the tyre slides along", lower=0.02, upper=10)
    s_slide_x2: float = var("tyre", "", "1", "the same", lower=0.02, upper=10)
    slide_x: float = var("tyre", "F_xS", "N", "sliding force along", lower=100, upper=1e6)
    slide_x2: float = var("tyre", "", "N", "the same", lower=100, upper=1e6)
    rise_y: float = var("tyre", "dF_y0", "N", "rise of the lateral force over slip, at no slip", lower=1e3, upper=1e7)
    rise_y2: float = var("tyre", "", "N", "the same", lower=1e3, upper=1e7)
    s_most_y: float = var("tyre", "s_yM", "1", "slip of the largest lateral force", lower=0.01, upper=1)
    s_most_y2: float = var("tyre", "", "1", "the same", lower=0.01, upper=1)
    most_y: float = var("tyre", "F_yM", "N", "largest lateral force", lower=100, upper=1e6)
    most_y2: float = var("tyre", "", "N", "the same", lower=100, upper=1e6)
    s_slide_y: float = var("tyre", "s_yS", "1", "slip from which the tyre slides aside", lower=0.02, upper=10)
    s_slide_y2: float = var("tyre", "", "1", "the same", lower=0.02, upper=10)
    slide_y: float = var("tyre", "F_yS", "N", "sliding lateral force", lower=100, upper=1e6)
    slide_y2: float = var("tyre", "", "N", "the same", lower=100, upper=1e6)
    c_x: float = var("tyre", "c_x", "N/m", "stiffness of the tyre along", lower=1e4, upper=1e7)
    d_x: float = var("tyre", "d_x", "N.s/m", "damping of the tyre along", lower=1, upper=1e5)
    c_y: float = var("tyre", "c_y", "N/m", "lateral stiffness of the tyre", lower=1e4, upper=1e7)
    d_y: float = var("tyre", "d_y", "N.s/m", "lateral damping of the tyre", lower=1, upper=1e5)


@dataclass
class Wheel(Car, Suspension, Tyre):
    """Everything given about a wheel: the corner, its axle and tyre, and its place."""

    x: float = var("wheel", "x", "m", "place ahead of the body's centre of gravity", default=0.0)
    y: float = var("wheel", "y", "m", "place to the left of it", default=0.0)
    weight: float = var("wheel", "F_z0", "N", "load at rest", default=0.0)


@dataclass(slots=True)
class Sums:
    """What the wheels add up in a step: generalised forces, power, and the matrix of the masses."""

    q_x: float = var("sums", "", "N", "force forward", default=0.0)
    q_y: float = var("sums", "", "N", "force to the left", default=0.0)
    q_z: float = var("sums", "", "N", "force upward", default=0.0)
    q_yaw: float = var("sums", "", "N.m", "yaw moment", default=0.0)
    q_pitch: float = var("sums", "", "N.m", "pitch moment", default=0.0)
    q_roll: float = var("sums", "", "N.m", "roll moment", default=0.0)
    m_all: float = var("sums", "", "kg", "mass along and aside", default=0.0)
    m_x: float = var("sums", "", "kg.m", "masses times their places ahead", default=0.0)
    m_h: float = var("sums", "", "kg.m", "masses times their arms in pitch", default=0.0)
    m_g: float = var("sums", "", "kg.m", "masses times their levers in roll", default=0.0)
    m_xg: float = var("sums", "", "kg.m2", "masses times place and lever", default=0.0)
    i_pitch: float = var("sums", "", "kg.m2", "inertia in pitch", default=0.0)
    i_yaw: float = var("sums", "", "kg.m2", "inertia in yaw", default=0.0)
    i_roll: float = var("sums", "", "kg.m2", "inertia in roll", default=0.0)
    power: float = var("sums", "", "W", "power of all applied forces", default=0.0)


@dataclass(slots=True)
class BodyMotion(Sums):
    """Places and angles at one time, speeds half a step earlier (leapfrog)."""

    x: float = var("motion", "x", "m", "place of the body's centre of gravity", default=0.0)
    y: float = var("motion", "y", "m", "the same, aside", default=0.0)
    yaw: float = var("motion", "", "rad", "direction of travel", default=0.0)
    z: float = var("motion", "z", "m", "height of the body", default=0.0)
    pitch: float = var("motion", "", "rad", "pitch angle, nose down", default=0.0)
    roll: float = var("motion", "", "rad", "roll angle, left side up", default=0.0)
    v_x: float = var("motion", "v_x", "m/s", "speed forward", default=0.0)
    v_y: float = var("motion", "v_y", "m/s", "speed to the left", default=0.0)
    v_z: float = var("motion", "v_z", "m/s", "speed upward", default=0.0)
    w_yaw: float = var("motion", "", "rad/s", "yaw rate", default=0.0)
    w_pitch: float = var("motion", "", "rad/s", "pitch rate", default=0.0)
    w_roll: float = var("motion", "", "rad/s", "roll rate", default=0.0)
    dv_x: float = var("motion", "", "m/s", "last change of v_x", default=0.0)
    dv_y: float = var("motion", "", "m/s", "last change of v_y", default=0.0)
    dv_z: float = var("motion", "", "m/s", "last change of v_z", default=0.0)
    dw_yaw: float = var("motion", "", "rad/s", "last change of w_yaw", default=0.0)
    dw_pitch: float = var("motion", "", "rad/s", "last change of w_pitch", default=0.0)
    dw_roll: float = var("motion", "", "rad/s", "last change of w_roll", default=0.0)
    a_x: float = var("motion", "a_x", "m/s2", "acceleration forward of the centre of gravity", default=0.0)
    a_y: float = var("motion", "a_y", "m/s2", "acceleration to the left", default=0.0)
    way: float = var("motion", "", "m", "way along the road since the start", default=0.0)
    seen: float = var("motion", "", "m/s", "speed that the slip control takes for the car's", default=0.0)
    behind: float = var("motion", "", "m", "way by which the held speed was missed", default=0.0)
    work: float = var("motion", "", "J", "work of road, drive, brakes, damping and friction on the car", default=0.0)


@dataclass(slots=True)
class WheelMotion:
    """A wheel's motion, its forces and its brake."""

    z: float = var("wheel", "z_w", "m", "height", default=0.0)
    v: float = var("wheel", "v_w", "m/s", "vertical speed half a step earlier", default=0.0)
    dv: float = var("wheel", "", "m/s", "its last change", default=0.0)
    spin: float = var("wheel", "", "rad/s", "speed of rotation half a step earlier", default=0.0)
    d_spin: float = var("wheel", "", "rad/s", "its last change", default=0.0)
    e_x: float = var("wheel", "e_x", "m", "deflection of the tyre along", default=0.0)
    e_y: float = var("wheel", "e_y", "m", "deflection of the tyre aside", default=0.0)
    de_x: float = var("wheel", "", "m/s", "its rate", default=0.0)
    de_y: float = var("wheel", "", "m/s", "its rate", default=0.0)
    grip: float = var("wheel", "", "1", "factor of all tyre forces", default=1.0)
    load: float = var("wheel", "F_z", "N", "wheel load", default=0.0)
    F_x: float = var("wheel", "F_x", "N", "tyre force along the wheel", default=0.0)
    F_y: float = var("wheel", "F_y", "N", "tyre force aside", default=0.0)
    lifted: float = var("wheel", "", "N", "vertical force on the wheel but for its axle's", default=0.0)
    aside: float = var("wheel", "", "N", "what its lateral force does to it through the roll centre", default=0.0)
    friction: float = var("wheel", "", "N", "friction between body and wheel at these heights", default=0.0)
    slip_x: float = var("wheel", "s_x", "1", "slip along, negative in braking", default=0.0)
    slip_y: float = var("wheel", "s_y", "1", "slip aside", default=0.0)
    stroke: float = var("wheel", "", "m", "stroke of the damper at the start of the step", default=0.0)
    velocity: float = var("wheel", "", "m/s", "its mean velocity over the step", default=0.0)
    road: float = var("wheel", "", "m", "height of the road under it", default=0.0)
    road_rate: float = var("wheel", "", "m/s", "its rate", default=0.0)
    damper: float = var("wheel", "F", "N", "damper force", default=0.0)
    before: float = var("wheel", "", "N", "damper force a step earlier", default=0.0)
    acting: float = var("wheel", "", "N", "damper force at the start of the step to come", default=0.0)
    pressure: float = var("wheel", "p", "Pa", "brake pressure", default=0.0)
    waiting: float = var("wheel", "", "s", "time until the slip control decides again", default=0.0)
    controlled: float = var("wheel", "", "Pa", "brake pressure at which the slip control last began a release", default=0.0)
    order: float = var("wheel", "", "1", "its order: 0 hold, 1 build up, 2 release, 3 let recover", default=1.0)
    rim: float = var("wheel", "", "m/s", "speed of the rim at its last decision", default=0.0)
