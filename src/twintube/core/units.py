"""Units of the variables in terms of SI base units, for files that importers read."""

# Exponents of the SI base units, for importers that refuse to connect units they do not know, and the quantity's name.
UNITS: dict[str, tuple[str, dict[str, str]]] = {
    "m": ("Length", {"m": "1"}),
    "m3": ("Volume", {"m": "3"}),
    "m/s": ("Velocity", {"m": "1", "s": "-1"}),
    "kg": ("Mass", {"kg": "1"}),
    "N": ("Force", {"kg": "1", "m": "1", "s": "-2"}),
    "N/m": ("Stiffness", {"kg": "1", "s": "-2"}),
    "s": ("Time", {"s": "1"}),
    "1/s": ("Rate", {"s": "-1"}),
    "m2": ("Area", {"m": "2"}),
    "m/N": ("Compliance", {"kg": "-1", "s": "2"}),
    "1/m": ("RelativeChangePerLength", {"m": "-1"}),
    "1/m2": ("RelativeChangePerSquareLength", {"m": "-2"}),
    "1/J": ("RelativeChangePerEnergy", {"kg": "-1", "m": "-2", "s": "2"}),
    "N.s": ("Impulse", {"kg": "1", "m": "1", "s": "-1"}),
    "N.s/m": ("Damping", {"kg": "1", "s": "-1"}),
    "s/m": ("Slowness", {"m": "-1", "s": "1"}),
    "N/m3": ("StiffnessPerSquareLength", {"kg": "1", "m": "-2", "s": "-2"}),
    "K": ("ThermodynamicTemperature", {"K": "1"}),
    "1/K": ("RelativeChangePerTemperature", {"K": "-1"}),
    "K/J": ("TemperaturePerEnergy", {"K": "1", "kg": "-1", "m": "-2", "s": "2"}),
    "J": ("Energy", {"kg": "1", "m": "2", "s": "-2"}),
    "rad": ("Angle", {"rad": "1"}),
    "rad/s": ("AngularVelocity", {"rad": "1", "s": "-1"}),
    "rad/N": ("AngularCompliance", {"rad": "1", "kg": "-1", "m": "-1", "s": "2"}),
    "m/s2": ("Acceleration", {"m": "1", "s": "-2"}),
    "N.m": ("Moment", {"kg": "1", "m": "2", "s": "-2"}),
    "W": ("Power", {"kg": "1", "m": "2", "s": "-3"}),
    "rad/s2": ("AngularAcceleration", {"rad": "1", "s": "-2"}),
    "kg.m": ("FirstMoment", {"kg": "1", "m": "1"}),
    "kg/m": ("MassPerLength", {"kg": "1", "m": "-1"}),
    "kg.m2": ("MomentOfInertia", {"kg": "1", "m": "2"}),
    "Pa": ("Pressure", {"kg": "1", "m": "-1", "s": "-2"}),
    "Pa/s": ("PressureRate", {"kg": "1", "m": "-1", "s": "-3"}),
}

# What importers may show instead: the unit's name, and how many of it make the SI unit.
DISPLAY: dict[str, tuple[str, float]] = {"m": ("mm", 1e3), "m3": ("mL", 1e6)}

# The magnitude that a quantity of a damper usually has, in SI units, by which importers scale.
NOMINAL: dict[str, float] = {
    "1": 1.0,
    "m": 0.05,
    "m2": 1e-6,
    "m3": 1e-4,
    "m/s": 0.5,
    "kg": 1.0,
    "N": 1000.0,
    "N/m": 1000.0,
    "s": 0.01,
    "1/s": 0.1,
    "m/N": 1e-6,
    "1/m": 1.0,
    "1/m2": 10.0,
    "1/J": 1e-5,
    "J": 100.0,
    "W": 100.0,
    "K": 300.0,
    "K/J": 1e-3,
}
