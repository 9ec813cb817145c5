"""What a stored result depends on, for every cache, journal and FMU: the sources behind it, found by their imports.

Nobody keeps a list of files: a new import of a module, a new effect or a changed parameter file changes the fingerprint.
"""

import ast
import hashlib
from functools import cache
from importlib.metadata import version
from pathlib import Path

from twintube.common.parsing import parsed

PACKAGE = "twintube"
ROOT = Path(__file__).parent
# Their results differ in the last bits, which a search or a chaotic drive enlarges.
LIBRARIES = ("numpy", "scipy")


def location(module: str) -> Path | None:
    """The file of a module of this package; None where the name is none, and for the package itself, which imports all."""
    *folders, last = module.split(".")
    if not folders or folders[0] != PACKAGE:
        return None
    place = ROOT.joinpath(*folders[1:], last)
    return next((path for path in (place.with_suffix(".py"), place / "__init__.py") if path.is_file()), None)


@cache
def named(path: Path) -> tuple[Path, ...]:
    """The files that a source file depends on: by imports, by naming them in a text, by importing its folder's files."""
    found: list[Path] = []
    for node in ast.walk(parsed(path.read_text(encoding="utf-8"))):
        modules: list[str] = []
        match node:
            case ast.Import():
                modules = [item.name for item in node.names]
            case ast.ImportFrom(module=str(module)):
                parts = [f"{module}.{item.name}" for item in node.names]
                modules = [part if location(part) else module for part in parts]
            case ast.Constant(value=str(text)) if "/" in text and text.endswith(".py") and (ROOT / text).is_file():
                found.append(ROOT / text)
            case ast.Name(id="importlib") if path.name == "__init__.py":
                found += path.parent.glob("*.py")
        found += filter(None, map(location, modules))
    return tuple(found)


@cache
def files(module: str) -> tuple[Path, ...]:
    """The files of a module and of all that it imports from this package, with the parameter files beside them."""
    waiting = list(filter(None, [location(module)]))
    seen: set[Path] = set()
    while waiting:
        path = waiting.pop()
        if path not in seen:
            seen.add(path)
            seen.update(path.parent.glob("*.toml"))
            waiting += named(path)
    return tuple(sorted(seen))


@cache
def fingerprint(module: str) -> str:
    """A digest (16 hexadecimal digits) of what the results of a module of this package depend on, except its input."""
    parts = [f"{name} {version(name)}".encode() for name in LIBRARIES]
    for path in files(module):
        parts += [path.name.encode(), path.read_bytes()]
    return hashlib.sha256(b"\0".join(parts)).hexdigest()[:16]
