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
    "J": ("Energy", {"kg": "1", "m": "2", "s": "-2"}),
}
