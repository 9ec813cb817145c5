"""What to install where a package of an extra is missing; the extras are those of `pyproject.toml`."""

import re
from importlib.metadata import requires

NOT_FOR_USERS = ("all", "test")


def extra_of(module: str) -> str | None:
    """The extra of this package that brings a module, None where none does."""
    name = module.split(".", maxsplit=1)[0].lower()
    for requirement in requires("twintube") or []:
        # An extra may hold other extras of this package, which no module is missing for.
        match = re.match(r"(?!twintube\b)([\w.-]+).*extra == ['\"](\w+)['\"]", requirement)
        if match and match[1].replace("-", "_").lower() == name and match[2] not in NOT_FOR_USERS:
            return match[2]
    return None


def missing(error: ModuleNotFoundError) -> str:
    """A message that says what to install; empty where the module is none of an extra's."""
    extra = extra_of(error.name or "")
    return f"the package {error.name} is not installed: pip install 'twintube[{extra}]'" if extra else ""
