"""Progress of what takes longer than seconds."""

from collections.abc import MutableMapping
from typing import Any

from tqdm import tqdm

BEGUN = 0.1  # of the work: the first part also waits for what is compiled and started, and would promise hours
WITHOUT_ESTIMATE = "{l_bar}{bar}| {n_fmt}/{total_fmt} [{elapsed}{postfix}]"


class Bar(tqdm):  # type: ignore[misc]  # tqdm has no types
    """A bar that says how long the rest takes only once a tenth of the work is done."""

    @property
    def format_dict(self) -> MutableMapping[str, Any]:
        """What is shown."""
        shown: MutableMapping[str, Any] = super().format_dict
        begun = self.n - self.initial >= BEGUN * ((self.total or 0) - self.initial)
        return shown if begun and self.n > self.initial else {**shown, "bar_format": self.bar_format or WITHOUT_ESTIMATE}
