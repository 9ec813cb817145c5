"""The state that a command's options give a damper: one rule for all of them.

An option changes what it names: `--oil-level` leaves the gas preload as it is, `--gas-lost` takes it away, `--gas` a share.
"""

from typing import TYPE_CHECKING, Annotated

import typer

from twintube.errors import InputError

if TYPE_CHECKING:
    from twintube.dampers import Damper

GAS = "--gas-lost/--gas-kept"
OIL_LEVEL = Annotated[
    float | None,
    typer.Option(metavar="0..1", help="Oil, share of the intact volume. The gas preload stays unless --gas-lost."),
]
GAS_LOST = Annotated[bool | None, typer.Option(GAS, help="Gas preload; as in the parameter set (kept) if left out.")]
WORN_OIL_LEVEL = Annotated[
    float,
    typer.Option(
        "--oil-level",
        metavar="0..1",
        help="Oil of the worn dampers. Their gas preload stays unless --gas-lost.",
    ),
]
GAS_SHARE = Annotated[
    float | None, typer.Option("--gas", metavar="0..1", help="Gas pressure above ambient, share of the nominal.")
]
TEMPERATURE = Annotated[
    float | None,
    typer.Option(metavar="DEGC", help="Temperature of oil, seals and gas; that of the parameters if left out."),
]
WORN_GAS_LOST = Annotated[bool | None, typer.Option(GAS, help="Gas preload of the worn dampers; kept if left out.")]
LOST_BELOW_FULL = Annotated[
    bool | None, typer.Option(GAS, help="Gas preload of dampers with less than 100 % oil; kept if left out.")
]


def gas_preload(gas_lost: bool | None, gas: float | None) -> float | None:
    """The share of the gas preload [1] that is given, None where none is; raises InputError."""
    if gas is None:
        return None if gas_lost is None else float(not gas_lost)
    if gas_lost is not None:
        raise InputError(f"--gas {gas:g} and --gas-{'lost' if gas_lost else 'kept'}: give one of them")
    if not 0.0 <= gas <= 1.0:
        raise InputError(f"--gas {gas:g}: must be a number from 0 to 1")
    return gas


def worn_preload(gas_lost: bool | None, gas: float | None) -> float:
    """The same of worn dampers, which keep it where none is given."""
    share = gas_preload(gas_lost, gas)
    return 1.0 if share is None else share


def in_kelvins(degC: float, name: str = "--temperature") -> float:
    """A temperature [K] that is given in degC; raises InputError, in degC too, where the model has none."""
    from twintube.core.checks import KELVIN, TEMPERATURE, outside

    low, high = (TEMPERATURE[end] - KELVIN for end in ("lower", "upper"))
    if message := outside(name, degC, low, high, "degC"):
        raise InputError(message)
    return degC + KELVIN


def tempered(damper: "Damper", degC: float | None) -> "Damper":
    """The damper at the temperature that is given, else as its parameter set says; raises InputError."""
    from twintube.dampers.temperature import at_temperature

    return damper if degC is None else at_temperature(damper, in_kelvins(degC))


def in_state(damper: "Damper", oil_level: float | None, gas_lost: bool | None, gas: float | None) -> "Damper":
    """The damper in the state that is given, else as its parameter set says; raises InputError and ParameterError."""
    given = {"oil_level": oil_level, "gas_preload": gas_preload(gas_lost, gas)}
    return damper.with_(**{name: value for name, value in given.items() if value is not None})
