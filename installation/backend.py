"""The build backend: setuptools, with the libraries of this machine compiled before it collects the files.

A wheel with the libraries of all platforms is for any machine; one with those of this machine alone says so in its name.
"""

import sys
import sysconfig
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from setuptools import build_meta
from setuptools.build_meta import *  # noqa: F403  # the hooks that are not below

sys.path.insert(0, str(Path(__file__).parents[1] / "src"))

from twintube.native import compiler, made

COMPILER = "ziglang>=0.13"
Settings = Mapping[str, Any] | None


def required() -> list[str]:
    """A compiler, where one is needed."""
    here = compiler.this_machine()
    return [] if compiler.own_compiler() or made.complete(here) else [COMPILER]


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """What setuptools wants, and a compiler."""
    return [*build_meta.get_requires_for_build_wheel(config_settings), *required()]


def get_requires_for_build_editable(config_settings: Settings = None) -> list[str]:
    """The same for a checkout."""
    return [*build_meta.get_requires_for_build_editable(config_settings), *required()]


def compile_missing() -> None:
    """Make the libraries of this machine where they are missing or of other sources."""
    here = compiler.this_machine()
    if not made.complete(here):
        made.made_for(here)


def build_wheel(wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None) -> str:
    """A wheel for any machine where all libraries are there, else for this one."""
    compile_missing()
    settings = dict(config_settings or {})
    if not all(map(made.complete, compiler.TARGETS)):
        named = settings.get("--build-option", [])
        settings["--build-option"] = [
            *([named] if isinstance(named, str) else named),
            f"--plat-name={sysconfig.get_platform()}",
        ]
    return build_meta.build_wheel(wheel_directory, settings, metadata_directory)


def build_editable(wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None) -> str:
    """An installation that uses the checkout."""
    compile_missing()
    return build_meta.build_editable(wheel_directory, config_settings, metadata_directory)
