"""How results show themselves: as a table of pandas and as a picture, imported when they are asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from twintube.common.extras import missing
from twintube.errors import UserError

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure as Figure  # noqa: PLC0414 - also for the package, whose room does not draw


def data_frame(
    columns: Mapping[str, Any] | Sequence[Mapping[str, Any]],
    units: Mapping[str, str] | None = None,
    index: str | None = None,
) -> pd.DataFrame:
    """Columns by name, or one mapping a row; `units` stand in `attrs["units"]`. Raises UserError without pandas."""
    try:
        import pandas as pd
    except ModuleNotFoundError as error:
        raise UserError(missing(error) or f"the package {error.name} is not installed") from None
    frame = pd.DataFrame(columns)
    frame.attrs["units"] = dict(units or {})
    return frame if index is None else frame.set_index(index)


DRAWS: list[Callable[[Any], Figure]] = []  # entered by the package: what draws stands above what computes


def picture(result: Any) -> Figure:
    """A picture that pyplot shows."""
    return DRAWS[-1](result)
