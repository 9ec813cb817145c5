"""The state that a command's options give a damper: one rule for all of them, and the words in which they say it.

An option changes what it names: `--oil-level` leaves the gas preload as it is, `--gas-lost` takes it away.
"""

from typing import TYPE_CHECKING, Annotated, Any

import typer

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
WORN_GAS_LOST = Annotated[bool, typer.Option(GAS, help="Gas preload of the worn dampers.")]
LOST_BELOW_FULL = Annotated[bool, typer.Option(GAS, help="Gas preload of dampers with less than 100 % oil.")]


def in_state(damper: "Damper", oil_level: float | None, gas_lost: bool | None) -> "Damper":
    """The damper in the state that is given, else as its parameter set says; raises ParameterError."""
    changes: dict[str, Any] = {} if oil_level is None else {"oil_level": oil_level}
    if gas_lost is not None:
        changes["gas_preload"] = int(not gas_lost)
    return damper.with_(**changes)


def in_words(damper: "Damper") -> str:
    """`60 % oil, gas lost`."""
    p = damper.parameters
    return state_in_words(p.oil_level, gas_lost=not p.gas_preload)


def state_in_words(oil_level: float, *, gas_lost: bool) -> str:
    """The same of an oil level [1] and the gas preload."""
    return f"{100 * oil_level:.4g} % oil, gas {'lost' if gas_lost else 'kept'}"
