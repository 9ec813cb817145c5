"""The virtual damper: dimensions of one of eight dampers, typical hydraulics sized for published forces."""

from dataclasses import dataclass, replace
from math import pi, sqrt

from twintube.lab.virtual_rig.constants import Constants
from twintube.lab.virtual_rig.dimensions import DIMENSIONS, Forces, Lengths, default_forces, default_lengths
from twintube.lab.virtual_rig.physics import P_0

BAR = 1e5  # [Pa]
# [m] smallest excess length of the outer tube, for the foot and the space under the seal: 200 against 180 mm in
# Global_Parameters.mo of Czesiek1701/Modelica-Double-tube-shock-absorber.
OVERHANG = 0.02
# [1] largest share of the reserve that oil takes at rest, assumed: Audi's Self-study programme 242 says "partially filled",
# and the gas must accommodate the rod. If the published oil would fill more, the outer tube is longer.
FULLEST = 0.65
# Pressure drop of the foot valve relative to the piston's in compression, at the two velocities: the lowest values without
# cavitation in the rebound chamber with preload. Without preload the chamber is not filled.
FOOT_TO_PISTON = (1.25, 0.85)
PAST = 0.15  # [1] share of the flow that leaks past the piston
WEAKEST = 0.2 * BAR  # [Pa] lowest opening pressure of a check valve, so that its spring closes it; assumed


@dataclass(frozen=True)
class VirtualDamper:
    """Geometry and physical constants, SI units; valve areas are relative to the area that feeds the valve.

    The constants are assumed: typical of a passenger car's damper and the same for all dampers. None is a parameter of
    `twintube`. The valves are sized, see `sized`.
    """

    name: str  # the damper whose dimensions these are
    D_PR: float  # [m] diameter of the piston rod
    D_li: float  # [m] inner diameter of the inner tube
    D_la: float  # [m] outer diameter of the inner tube
    D_a: float  # [m] diameter of the outer tube
    h_l: float  # [m] length of the inner tube
    V_oil: float  # [m3] oil of the intact damper
    lengths: Lengths  # [m] components in the inner tube
    forces: Forces  # [m/s], [N] for which the valves are sized
    overhang: float  # [m] outer tube beyond the inner tube

    piston_bleed: float  # [1] of A_1
    piston_crack: float  # [Pa] of the blow-off valve in rebound
    piston_opening: float  # [1/Pa] of A_1
    check_crack: float  # [Pa] of the piston's valve in compression
    check_opening: float  # [1/Pa] of A_1
    base_bleed: float  # [1] of A_rod
    base_crack: float  # [Pa] of the foot's blow-off valve in compression
    base_opening: float  # [1/Pa] of A_rod
    piston_gap: float  # [m3/(Pa s)] laminar leak past the piston at 25 degC

    preload: float = 6.0 * BAR  # [Pa] gauge pressure of the reserve's gas: 6 to 8 bar (Audi, Self-study programme 242; PMG)
    n_reserve: float = 1.1  # [1] polytropic exponent of the reserve's gas
    K_oil: float = 0.8e9  # [Pa] bulk modulus of oil and tube
    rho_oil: float = 860.0  # [kg/m3]
    C_d: float = 0.7  # [1] discharge coefficient
    suction: float = 0.45  # [1] of A_rod: suction valve of the foot, and its windows to the reserve
    suction_pressure: float = 0.05 * BAR  # [Pa] at which the suction valve is fully open
    rod_guide: float = (
        1e-7  # [m2] notch from rebound chamber to reserve: a hole of 0.36 mm with a lip that blocks the return
    )
    rod_clearance: float = 3e-5  # [m] between rod and guide: gas flows a hundred times more easily than oil
    guide_length: float = 0.015  # [m]
    viscosity: float = 1.2e-5  # [m2/s] of oil at 25 degC
    thinning: float = 0.03  # [1/K] share of viscosity lost per kelvin at 25 degC
    port: float = 2e-3  # [m] height of oil over which a port changes from oil to gas at rest
    draw: float = 1.2  # [1] the same under flow, relative to (Q^2/g)^(1/5), the height from which a port draws
    v_mix: float = 0.2  # [m/s] piston velocity whose flow breaks half of the gas into bubbles
    jet: float = 1.0  # [1] pocket gas that an oil jet entrains, per oil: plunging jets of 50 m/s entrain about their volume
    jet_width: float = 8e-3  # [m] width of a foot-valve jet: a window in the foot, or the gap of the reserve
    released: float = 0.3  # [1] largest share of the dissolved gas that one pass of a cavitating valve releases
    cavitating: float = 20.0  # [1] pressure drop over downstream pressure at which a valve releases half of that
    t_separate: float = 20.0  # [s] time constant of rising bubbles: 0.3 mm at 5 mm/s through 0.1 m
    solubility: float = 0.103  # [1] dissolved gas per oil at 1 bar: 9.3 to 11.3 % (paper)
    t_release: float = 5.6  # [s] half-life of released gas: 3.6 to 7.6 s (paper)
    t_dissolve: float = 8.2  # [s] half-life of dissolving bubbles: 6.1 to 10.2 s (paper)
    heat_capacity: float = 900.0  # [J/K] oil and tubes
    cooling: float = 5.0  # [W/K] with the rig's fan
    F_static: float = 30.0  # [N] friction before sliding
    F_sliding: float = 20.0  # [N]
    v_stribeck: float = 0.02  # [m/s]
    bristle: float = 2e5  # [N/m]
    viscous: float = 5.0  # [N s/m]
    leak: float = 0.0  # [m2] oil that the rod carries out past its seal, per stroke out
    foam: float = 0.0  # [1] share of both working chambers that is bubbles at the start, of a fast run before

    @property
    def A_2(self) -> float:
        """Area of the piston [m2]."""
        return pi / 4 * self.D_li**2

    @property
    def A_rod(self) -> float:
        """Area of the piston rod [m2]."""
        return pi / 4 * self.D_PR**2

    @property
    def A_1(self) -> float:
        """Annulus of the piston [m2]."""
        return self.A_2 - self.A_rod

    @property
    def A_3(self) -> float:
        """Cross-section of the reserve [m2]."""
        return pi / 4 * (self.D_a**2 - self.D_la**2)

    @property
    def half(self) -> float:
        """Travel [m] of the piston from stroke 0, midway between the end stops (assumed), to either stop."""
        return (self.h_l - self.lengths.total) / 2

    @property
    def reserve_oil(self) -> float:
        """Oil of the intact damper in the reserve at rest at stroke 0 [m3]."""
        return self.V_oil - (self.A_1 + self.A_2) * self.half

    @property
    def height_3(self) -> float:
        """Height of the reserve [m]."""
        return self.h_l + self.overhang

    def constants(self, gas_preload: float, ambient_degC: float) -> Constants:
        """Constants of the right-hand side, with a share of the preload [1]."""
        derived = {
            "V_10": self.A_1 * self.half,
            "V_20": self.A_2 * self.half,
            "height_1": self.half,
            "height_2": self.half,
            "V_3": self.A_3 * self.height_3,
            "p_fill": P_0 + gas_preload * self.preload,
            "Q_mix": self.A_2 * self.v_mix,
            "wetted": pi * (self.D_a + self.D_la),
            "guide_gap": pi * self.D_PR * self.rod_clearance**3 / (12 * self.viscosity * self.rho_oil * self.guide_length),
            "T_ambient": ambient_degC,
        }
        for name in ("piston_bleed", "piston_opening", "check_opening"):
            derived[name] = getattr(self, name) * self.A_1
        for name in ("base_bleed", "base_opening", "suction"):
            derived[name] = getattr(self, name) * self.A_rod
        return Constants(*(float(derived[name] if name in derived else getattr(self, name)) for name in Constants._fields))


def virtual_damper(
    name: str = "SA8", lengths: Lengths | None = None, forces: Forces | None = None, **changes: float
) -> VirtualDamper:
    """A virtual damper with the dimensions of one of the paper's, e.g. `virtual_damper("SA1", preload=4e5)`.

    Its valves are sized for the `forces`; by default these and the `lengths` are those of `dimensions.py`. Raises
    ValueError for a damper that is not in the paper.
    """
    if name not in DIMENSIONS:
        raise ValueError(f"unknown damper {name}: the virtual rig has {', '.join(DIMENSIONS)}")
    published = DIMENSIONS[name]
    lengths, forces = lengths or default_lengths(published.D_PR), forces or default_forces(published.D_PR)
    values = {"overhang": OVERHANG} | published._asdict() | sized(published.D_PR, published.D_li, forces) | changes
    damper = VirtualDamper(name=name, lengths=lengths, forces=forces, **values)
    if "overhang" in changes:
        return damper
    return replace(damper, overhang=max(OVERHANG, damper.reserve_oil / (FULLEST * damper.A_3) - damper.h_l))


def sized(D_PR: float, D_li: float, forces: Forces) -> dict[str, float]:
    """Valves with which the damper reaches the `forces` [N], as a damper designer sizes them.

    The bleeds and the leak past the piston, a share of the flow, carry the lower velocity; the blow-off valves
    open there and carry the rest at the higher one. In compression both valves share the force. A piston valve that would
    have to be open at rest has the weakest spring; the force at the lower velocity is then higher than specified.
    """
    A_rod = pi / 4 * D_PR**2
    A_1 = pi / 4 * D_li**2 - A_rod
    slow, fast = forces.slow[0], forces.fast[0]
    rebound, compression = zip(forces.slow[1:], forces.fast[1:], strict=True)

    def area(v: float, dp: float) -> float:
        """Area of an orifice relative to the area that feeds it at v [m/s]."""
        return v / VirtualDamper.C_d / sqrt(2 * dp / VirtualDamper.rho_oil)

    down = [F / A_1 for F in rebound]
    piston = [F / (A_1 + ratio * A_rod) for F, ratio in zip(compression, FOOT_TO_PISTON, strict=True)]
    foot = [ratio * dp for dp, ratio in zip(piston, FOOT_TO_PISTON, strict=True)]
    gap = PAST * slow / down[0]  # [m/(Pa s)]
    bleed = area((1 - PAST) * slow, down[0])
    foot_bleed = area(slow, foot[0])
    check_slope = (area(fast, piston[1]) - area(slow, piston[0])) / (piston[1] - piston[0])
    check_crack = max(piston[0] - (area(slow, piston[0]) - bleed) / check_slope, WEAKEST)
    return {
        "piston_gap": gap * A_1,
        "piston_bleed": bleed,
        "piston_crack": down[0],
        "piston_opening": (area(fast - gap * down[1], down[1]) - bleed) / (down[1] - down[0]),
        "check_crack": check_crack,
        "check_opening": (area(fast, piston[1]) - bleed) / (piston[1] - check_crack),
        "base_bleed": foot_bleed,
        "base_crack": foot[0],
        "base_opening": (area(fast, foot[1]) - foot_bleed) / (foot[1] - foot[0]),
    }
