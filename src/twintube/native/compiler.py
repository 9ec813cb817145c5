"""A C compiler: for this machine `CC` where it is set, for all platforms that of the package ziglang.

Needed where libraries are made: at the installation of a checkout, and for a release.
"""

import os
import platform
import shlex
import subprocess
import sys
import sysconfig
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

from twintube.common.caches import cache_folder, writable
from twintube.native.mathematics import INEXACT

# Equal operations in equal order on every platform, as the interpreter does them: no fused multiply-add, and no function of
# math.h that the compiler computes itself, which rounds otherwise.
EQUAL = ("-std=c99", "-ffp-contract=off", *(f"-fno-builtin-{name}" for name in INEXACT))
# Functions of a shared library have no prefix; the headers of FMI 2.0 have none in any case.
FLAGS = (*EQUAL, "-O2", "-fvisibility=hidden", "-shared", "-s", "-DFMI3_OVERRIDE_FUNCTION_PREFIX")
LONGEST = 900  # [s] of one compilation: five times what all platforms take one after another, with their runtimes
CACHES = ("ZIG_GLOBAL_CACHE_DIR", "ZIG_LOCAL_CACHE_DIR")
# By the names of FMI 3.0: what ziglang calls the platform, and the ending of a library.
TARGETS = {
    "x86_64-linux": ("x86_64-linux-gnu.2.17", "so"),
    "aarch64-linux": ("aarch64-linux-gnu.2.17", "so"),
    "x86_64-windows": ("x86_64-windows-gnu", "dll"),
    "x86_64-darwin": ("x86_64-macos.11.0", "dylib"),
    "aarch64-darwin": ("aarch64-macos.11.0", "dylib"),
    "wasm32-wasi": ("wasm32-wasi", "wasm"),
}
PROCESSORS = {"amd64": "x86_64", "arm64": "aarch64"}  # as systems name them


class CompilerError(RuntimeError):
    """The sources could not be compiled; the message says why."""


def this_machine() -> str:
    """The name of this machine's platform, of TARGETS where it is known."""
    # A 32-bit Python on a 64-bit processor is not told apart: no library fits it, and loading says so.
    processor = platform.machine().lower()
    system = "musl" if "musl" in (sysconfig.get_config_var("SOABI") or "") else platform.system().lower()
    return f"{PROCESSORS.get(processor, processor)}-{system}"


def own_compiler() -> list[str]:
    """The command that `CC` names; empty where it is not set."""
    return shlex.split(os.environ.get("CC", ""))


def command(name: str) -> list[str]:
    """The compiler for a platform; raises CompilerError where there is none."""
    if name == this_machine() and own_compiler():
        return own_compiler()
    if name not in TARGETS:
        raise CompilerError(f"{name}: set CC to a C compiler of this machine; known are {', '.join(TARGETS)}")
    if find_spec("ziglang") is None:
        raise CompilerError("no C compiler: pip install ziglang")
    return [sys.executable, "-m", "ziglang", "cc", "-target", TARGETS[name][0]]


def platform_flags(name: str, flags: Sequence[str], file: str) -> tuple[str, ...]:
    """What a platform needs besides the common flags: code that can be loaded anywhere, on macOS a name without a path."""
    if "windows" in name or "wasm" in name:
        return ()
    if "darwin" in name and "-shared" in flags:
        return ("-fPIC", f"-Wl,-install_name,@rpath/{file}")
    return ("-fPIC",)


def compiler_environment() -> dict[str, str]:
    """The environment with folders for what the compiler keeps: ours, but where the user names some that can be written."""
    ours = str(cache_folder("zig"))
    named = {name: os.path.abspath(folder) for name in CACHES if (folder := os.environ.get(name))}
    return {**os.environ, **{name: ours for name in CACHES}, **{k: v for k, v in named.items() if writable(Path(v))}}


def compiled(
    sources: Sequence[Path], name: str, output: Path, flags: Sequence[str] = FLAGS, usual: Sequence[str] = ()
) -> None:
    """Compile source files for a platform of TARGETS, by the command `usual` if there is one; raises CompilerError."""
    start = [*(usual or command(name)), *flags, *platform_flags(name, flags, output.name)]
    environment = compiler_environment()
    try:
        done = subprocess.run(
            [*start, *map(str, sources), "-o", str(output), "-lm"],
            capture_output=True, text=True, check=False, cwd=output.parent, env=environment, timeout=LONGEST,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        raise CompilerError(
            f"{name}: the compiler did not end within {LONGEST} s; delete its cache {environment[CACHES[0]]}, "
            f"or name another folder by {CACHES[0]}"
        ) from None
    except OSError as error:
        raise CompilerError(f"{start[0]}: {error.strerror}") from None
    if done.returncode != 0 or not output.exists():
        raise CompilerError(f"{name}: {done.stderr.strip() or 'the compiler wrote no library'}")
