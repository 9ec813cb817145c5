"""Units as test benches write them, and the name and unit in a header.

Scales and many load cells show kg: units of mass are a force only where the user says so.
"""

import math
import re
from collections.abc import Sequence
from unicodedata import normalize

from twintube.dampers.quantity import parsed, quantity

UNIT_NAMES = {
    "sec": "s", "sek": "s", "second": "s", "seconds": "s", "sekunden": "s", "msec": "ms", "millisekunden": "ms",
    "millimeter": "mm", "meter": "m", "newton": "N", "kilonewton": "kN", "kn": "kN", "n": "N", "dan": "daN", "kp": "kgf",
    "°c": "degC", "c": "degC", "degc": "degC", "deg c": "degC", "celsius": "degC", "grad c": "degC", "k": "K", "kelvin": "K",
    "°f": "degF", "f": "degF", "degf": "degF", "deg f": "degF", "fahrenheit": "degF",
    "inch": "in", "inches": "in", '"': "in", "mil": "thou", "mils": "thou", "foot": "ft", "feet": "ft", "micron": "um",
    "microns": "um", "lb": "lbf", "lbs": "lbf", "mm/sec": "mm/s", "m/sec": "m/s", "in/sec": "in/s", "ips": "in/s",
    "ft/sec": "ft/s", "fps": "ft/s", "kmh": "km/h", "kph": "km/h",
    "с": "s", "сек": "s", "мс": "ms", "мкс": "us", "м": "m", "мм": "mm", "см": "cm", "мкм": "um", "н": "N", "кн": "kN",
    "кгс": "kgf", "м/с": "m/s", "мм/с": "mm/s", "см/с": "cm/s", "км/ч": "km/h", "°с": "degC",
    "days": "day", "tage": "day",
}  # fmt: skip
# Kept by their case: ms is not MS, mm not Mm.
PLAIN_UNITS = ("s", "ms", "us", "day", "m", "mm", "cm", "um", "in", "ft", "thou", "N", "kN", "daN", "kgf", "lbf", "m/s",
               "mm/s", "cm/s", "in/s", "ft/s", "km/h", "mph", "degC", "degF", "K")  # fmt: skip
OTHER_UNITS = ("V", "mV", "A", "mA", "%", "-", "1", "bar", "psi", "Pa", "MPa", "Hz", "rpm", "1/min", "mm/m", "J", "W")
NUMBER = re.compile(r"\s*[+-]?[0-9]+([.,][0-9]*)?([eE][+-]?[0-9]+)?\s*")
BRACKETS = re.compile(r"[\[(<{]\s*([^\[\](){}<>]*?)\s*[\])>}]")
HEADER = re.compile(r"(.*?)\s*(?:\[(.*)\]|\((.*)\))", re.DOTALL)
FEWEST = 2  # cells with a unit make a row of units
FULL_WIDTH = str.maketrans("（）［］＜＞｛｝", "()[]<>{}")  # brackets as Chinese and Japanese programs write them
G = 9.80665  # standard gravity [m/s2]
WEIGHTS = {"kg": "kgf", "g": "gf"}  # `lb` is read as lbf


def plain(text: str) -> str:
    """A header without blanks around it, its brackets those of ASCII."""
    return text.strip().translate(FULL_WIDTH)


def unit_of(text: str) -> str:
    """A unit as `twintube` writes it; "" for a text that is not one."""
    text = text.strip().replace("\N{MASCULINE ORDINAL INDICATOR}", "°")
    text = normalize("NFKC", text).replace("\N{GREEK SMALL LETTER MU}", "u").replace("s^-1", "/s")  # also ℃, ㎜, µ
    if text in PLAIN_UNITS:
        return text
    low = text.lower()
    return UNIT_NAMES.get(low, low if low in PLAIN_UNITS else "")


def split_header(header: str) -> tuple[str, str]:
    """Name and unit of `name [unit]` or `name (unit)`."""
    text = plain(header)
    parts = HEADER.fullmatch(text)
    return (parts[1], (parts[2] if parts[2] is not None else parts[3]).strip()) if parts else (text, "")


def name_and_unit(header: str) -> tuple[str, str]:
    """Name and unit of `Kraft [kN]`, `Kraft (kN)`, `Kraft in kN`, `Kraft / kN`, `force_kN` and the like.

    A unit in brackets that is not known is handed on as it is, so that it can be said.
    """
    text = plain(header).strip('"').strip()
    bracketed = re.fullmatch(r"(.*?)\s*[\[(<{]\s*([^\])>}]*?)\s*[\])>}]", text)
    if bracketed and unit_of(bracketed[2]):
        return bracketed[1], unit_of(bracketed[2])
    for inside in BRACKETS.finditer(text):  # `Load [kN] filtered`
        if len(inside[1]) > 1 and unit_of(inside[1]):
            return " ".join(f"{text[: inside.start()]} {text[inside.end() :]}".split()), unit_of(inside[1])
    if bracketed:
        return bracketed[1], bracketed[2]
    parted = re.fullmatch(r"(.+?)(?:\s*,\s*|\s+in\s+|\s*/\s*|\s+|_)([^\s,_]+)", text)
    if parted and unit_of(parted[2]) and not unit_of(text):
        return re.sub(r"(\s+in|\s*[/,])$", "", parted[1]), unit_of(parted[2])
    slashed = re.fullmatch(r"([^/]+)/\s*(.+)", text)
    if slashed and unit_of(slashed[2]):
        return slashed[1].strip(), unit_of(slashed[2])
    return text, ""


def units_row(cells: Sequence[str]) -> list[str] | None:
    """The units in a row under the header, without their brackets; None where the row is another one."""
    texts = [plain(cell).strip("[]()").strip() for cell in cells]
    written = [text for text in texts if text]
    known = [text for text in written if unit_of(text) or text in OTHER_UNITS]
    if len(known) < FEWEST or any(NUMBER.fullmatch(text) and text != "1" for text in written):
        return None
    return texts


def is_mass(unit: str) -> bool:
    """Whether a text is a unit of mass, and not the usual short form of one of force."""
    if unit_of(unit):
        return False
    try:
        return dict(parsed(unit).dimensionality) == {"[mass]": 1}
    except ValueError:
        return False


def is_weight_of(force: str, mass: str) -> bool:
    """Whether a unit of force is the weight of a unit of mass: kgf of kg."""
    try:
        newtons, kilograms = quantity(f"1 {unit_of(force) or force}", "N"), quantity(f"1 {mass}", "kg")
    except ValueError:
        return False
    return math.isclose(newtons, G * kilograms, rel_tol=1e-6)


def weight_advice(mass: str, column: str) -> str:
    """What to write where a mass stands for its weight; `column` is its name in the file, as TOML."""
    if mass in WEIGHTS:
        return f'if its weight is meant, write "force [{WEIGHTS[mass]}]" = {column}'
    scale = f"{G * quantity(f'1 {mass}', 'kg'):g} N/{mass}"
    return f'if its weight is meant, set channels = {{force = {{column = {column}, scale = "{scale}"}}}}'
