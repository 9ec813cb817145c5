"""Numbers for readers: engineering units and as many digits as the interval allows."""

import math

# From the SI unit: name and factor, largest first; the last one serves what is smaller still.
UNITS: dict[str, tuple[tuple[float, str, float], ...]] = {  # least SI value, unit, factor
    "m": ((0.0, "mm", 1e3),),
    "m2": ((0.0, "ml/m", 1e6),),  # oil per stroke travelled
    "m3": ((0.0, "ml", 1e6),),
    "m/N": ((0.0, "mm/kN", 1e6),),
    "N/m": ((0.0, "N/mm", 1e-3),),
    "1/J": ((0.0, "%/kJ", 1e5),),
    "s": ((0.5, "s", 1.0), (0.0, "ms", 1e3)),
    "J": ((2e3, "kJ", 1e-3), (0.0, "J", 1.0)),
    "m/s2": ((0.0, "m/s²", 1.0),),
    "Pa": ((0.0, "bar", 1e-5),),
    "": ((0.0, "", 1.0),),
}
MISSING = "–"
# Where rounding makes another number of digits: shares that would be -1000, 10 and 100 % and an amount that would be 1000.
FAR_BELOW, TENTH, NEARLY_WHOLE, THOUSAND = -9.995, 0.0995, 0.9995, 999.5
HUNDREDTH_OFF = 0.99  # from here on a tenth of a percent counts


def unit_of(unit: str, size: float, share: bool = True) -> tuple[str, float]:
    """Engineering unit and factor for values of about `size` in the SI `unit`; `share`: plain numbers as percent."""
    if unit == "1":
        return ("%", 100.0) if share else ("", 1.0)
    for least, name, factor in UNITS.get(unit, ((0.0, unit, 1.0),)):
        if not abs(size) < least:
            return name, factor
    return unit, 1.0


def digits(value: float, resolution: float) -> str:
    """A number with the decimals that its resolution asks for, at most four significant digits of the value."""
    if not math.isfinite(value):
        return MISSING
    if not (math.isfinite(resolution) and resolution > 0.0):
        return f"{value:.4g}"
    decimals = -math.floor(math.log10(resolution / 2))
    most = 3 - math.floor(math.log10(abs(value))) if value else decimals
    return f"{value:.{max(0, min(decimals, most, 9))}f}"


def percent(value: float) -> str:
    """A share as text; only the whole is 100 %, and a gain far below zero is only called that."""
    if not math.isfinite(value):
        return MISSING
    if value < FAR_BELOW:
        return "below −999 %"
    if NEARLY_WHOLE <= value < 1.0:
        return "99.9 %"
    near = abs(value) < TENTH or HUNDREDTH_OFF <= abs(value) < NEARLY_WHOLE
    return f"{round(value * 100, 1 if near else 0) + 0.0:.{1 if near else 0}f} %".replace("-", "−")


def amount(value: float, unit: str) -> str:
    """A force or work as text."""
    if not math.isfinite(value):
        return MISSING
    return f"{value:#.3g}".rstrip(".") + f" {unit}" if value < THOUSAND else f"{value:.0f} {unit}"
