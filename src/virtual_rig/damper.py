"""The virtual damper: geometry of a damper of the paper, hydraulics of a typical one."""

from dataclasses import dataclass
from math import pi

from twintube.parameters import load
from virtual_rig.physics import P_0, Constants

BAR = 1e5  # [Pa]


@dataclass(frozen=True)
class VirtualDamper:
    """Geometry and physical constants, SI units; valve areas are relative to the area that feeds the valve.

    The hydraulics are assumed, typical of a passenger car's damper, and none of them is a parameter of `twintube`.
    """

    name: str  # the damper whose geometry this is
    D_PR: float  # [m] diameter of the piston rod
    D_li: float  # [m] inner diameter of the inner tube
    D_la: float  # [m] outer diameter of the inner tube
    D_a: float  # [m] diameter of the outer tube
    h_l: float  # [m] length of the inner tube
    dead_length: float  # [m] of it taken by piston, stops and foot valve
    V_oil: float  # [m3] oil of the intact damper

    preload: float = 5.0 * BAR  # [Pa] gauge pressure of the reserve's gas
    n_reserve: float = 1.1  # [1] polytropic exponent of the reserve's gas
    K_oil: float = 0.8e9  # [Pa] bulk modulus of oil and tube
    rho_oil: float = 860.0  # [kg/m3]
    C_d: float = 0.7  # [1] discharge coefficient
    piston_bleed: float = 3.3e-3  # [1] of A_1
    piston_crack: float = 8.0 * BAR  # [Pa]
    piston_opening: float = 4.3e-4 / BAR  # [1/Pa] of A_1
    piston_check: float = 0.07  # [1] of A_1
    base_bleed: float = 1.8e-3  # [1] of A_rod
    base_crack: float = 10.0 * BAR  # [Pa]
    base_opening: float = 1.1e-3 / BAR  # [1/Pa] of A_rod
    base_check: float = 0.45  # [1] of A_rod
    check_pressure: float = 0.05 * BAR  # [Pa] at which a check valve is fully open
    rod_guide: float = 5e-7  # [m2] gap from the rebound chamber to the reserve
    piston_gap: float = 1e-11  # [m3/(Pa s)] laminar leak past the piston at 25 degC
    thinning: float = 0.03  # [1/K] share of viscosity lost per kelvin
    port: float = 2e-3  # [m] height of oil over which a port changes from oil to gas at rest
    draw: float = 1.2  # [1] the same under flow, relative to (Q^2/g)^(1/5), the height from which a port draws
    v_mix: float = 0.2  # [m/s] piston velocity whose flow breaks half of the gas into bubbles
    jet: float = 0.5  # [1] pocket gas that an oil jet drags below, per oil
    t_separate: float = 15.0  # [s] time constant of rising bubbles
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

    def constants(self, gas_preload: bool, ambient_degC: float) -> Constants:
        """What the right-hand side needs."""
        half = (self.h_l - self.dead_length) / 2
        derived = {
            "V_10": self.A_1 * half,
            "V_20": self.A_2 * half,
            "height_1": half,
            "height_2": half,
            "height_3": self.h_l,
            "V_3": pi / 4 * (self.D_a**2 - self.D_la**2) * self.h_l,
            "p_fill": P_0 + (self.preload if gas_preload else 0.0),
            "Q_mix": self.A_2 * self.v_mix,
            "T_ambient": ambient_degC,
        }
        for name in ("piston_bleed", "piston_opening", "piston_check"):
            derived[name] = getattr(self, name) * self.A_1
        for name in ("base_bleed", "base_opening", "base_check"):
            derived[name] = getattr(self, name) * self.A_rod
        return Constants(**{name: derived.get(name, getattr(self, name, 0.0)) for name in Constants._fields})


def virtual_damper(name: str = "SA8", **changes: float) -> VirtualDamper:
    """A virtual damper with the geometry of one of the paper's, e.g. `virtual_damper("SA1", preload=4e5)`."""
    p = load(name).parameters
    geometry = {item: getattr(p, item) for item in ("D_PR", "D_li", "D_la", "D_a", "h_l", "dead_length", "V_oil")}
    return VirtualDamper(name=name, **(geometry | changes))
