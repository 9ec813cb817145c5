"""What the road does to the rotation of the wheels, beside what slips them: for signals of wheel speeds.

`tyre.py` has a constant rolling radius, and the wheel fixed along the body. Here three things are added to a drive:

- The effective rolling radius changes with the load: Magic Formula 6.1 in the form of TNO's manual, with the coefficients of
  its tyre 205/60 R15 91 V. Formula and coefficients stand in `Tirepacejkacombined_test.m` of dhr999/openvehicledynamics, the
  formula also in `MagicFormula62` of MBSim.
- The load pushes along where the road rises or falls under the contact: minus load times slope. A tyre's force is normal to
  an effective road plane (A. J. C. Schmeitz, "A Semi-Empirical Three-Dimensional Model of the Pneumatic Tyre Rolling over
  Arbitrarily Uneven Road Surfaces", TU Delft 2004). Its slope is here that between the ends of the contact: assumed.
- The wheel moves along the body on the bushings of its links: a mass on a spring with a damper of its own.

The tyre answers by its rise at no slip and its deflection along, the wheel by its inertia. This is a small motion on top of
the drive: of what it does to the car, only the force along the body is given back. How stroke and pitch move the contact
along (`support`) is in `body.py`. Left out: growth by speed, runout and imbalance, engine and shafts, torsion of the belt.

In the kernel's own subset of Python: compiled with the damper.
"""

import math
from collections.abc import Sequence

from twintube.common.arrays import Table, Vector
from twintube.vehicle.full.car import Wheel
from twintube.vehicle.full.tyre import LARGEST_LOAD, ROLLING, deflect, over_load

# Of the Magic Formula 6.1: how the rolling radius falls as the tyre is pressed.
R_STIFF = 8.386  # BREFF
R_PEAK = 0.25826  # DREFF
R_HIGH = 0.07394  # FREFF
ROLL_COLUMNS = 5  # the wheels' spin, and the force along the body
ROLL_STATES = 4  # spin, tyre deflection, place and speed along, of each wheel


def shrinking(share: float) -> float:
    """How far the rolling radius is below the free one at a deflection `share`, both over the one at nominal load."""
    return R_PEAK * math.atan(R_STIFF * share) + R_HIGH * share


def roll_wheels(
    ks: Sequence[Wheel], stiff: Vector, soft: Vector, load: Table, slope: Table, spin: Table, force: Table, a_x: Vector,
    dt: float, state: Table, out: Table,
) -> None:  # fmt: skip
    """Rotation of the wheels of a drive: `load` [N], `spin` [rad/s], `force` along [N] (n, 4) and `a_x` [m/s2] (n,) are its.

    `stiff` [N/m] and `soft` [N.s/m] (4,) are the bushings', `slope` [1] (n, 4) that of the road. `state` (4, ROLL_STATES) is
    carried on. `out` (n, ROLL_COLUMNS) receives the spin of each wheel, and the force [N] by which the bushings push the
    body forward beyond that of the drive.
    """
    for n in range(len(load)):
        pushed = 0.0
        for i in range(4):
            k = ks[i]
            nominal = k.F_nominal / k.c_tyre
            pressed = load[n, i] / k.F_nominal
            shrunk = nominal * (shrinking(pressed) - shrinking(k.weight / k.F_nominal))
            turn, e, x, u = state[i, 0], state[i, 1], state[i, 2], state[i, 3]
            speed = max(abs(k.radius * spin[n, i]), ROLLING)
            secant = 0.0
            if pressed > 0.0:
                secant = over_load(k.rise_x, k.rise_x2, min(pressed, LARGEST_LOAD))
            slide = u - k.radius * turn + shrunk * (spin[n, i] + turn)
            more = deflect(k.c_x, k.d_x, secant, slide, speed, e)
            held = stiff[i] * x + soft[i] * u
            usual = force[n, i] - k.m_wheel * a_x[n]
            # Speeds first, then places by the new ones: no energy comes from nowhere.
            u += dt * (usual + more - load[n, i] * slope[n, i] - held) / k.m_wheel
            turn -= dt * more * k.radius / k.I_spin
            slide = u - k.radius * turn + shrunk * (spin[n, i] + turn)
            rate = (deflect(k.c_x, k.d_x, secant, slide, speed, e) - k.c_x * e) / k.d_x
            state[i, 0] = turn
            state[i, 1] = e + dt * rate / (1.0 + 0.5 * dt * speed * k.c_x / (speed * k.d_x + secant))
            state[i, 2] = x + dt * u
            state[i, 3] = u
            out[n, i] = max(spin[n, i] + turn, 0.0)
            pushed += held - usual
        out[n, 4] = pushed
