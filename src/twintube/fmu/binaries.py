"""Sources to shared libraries for all platforms, by the C compiler of the package ziglang."""

import hashlib
import os
import struct
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

from twintube.common.caches import cache_folder, writable
from twintube.fmu import library_cache
from twintube.fmu.standards import STANDARDS, Standard

# No fused multiply-add: every platform computes equal operations in equal order.
# Functions of a shared library have no prefix; fmpy's headers of FMI 2.0 have none in any case.
FLAGS = (
    "-std=c99", "-O2", "-ffp-contract=off", "-fvisibility=hidden", "-shared", "-s", "-DFMI3_OVERRIDE_FUNCTION_PREFIX"
)  # fmt: skip
COMPILED = STANDARDS[2].compiled
SLOW = 15  # [s] after which a word is due
LONGEST = 900  # [s] of one compilation: five times what all platforms take one after another, with their runtimes
CACHES = ("ZIG_GLOBAL_CACHE_DIR", "ZIG_LOCAL_CACHE_DIR")
PAGE = 14  # bits of the alignment of a part of a universal file
MACHINES = {"x86_64-macos.11.0": (0x01000007, 3), "aarch64-macos.11.0": (0x0100000C, 0)}


class CompilerError(RuntimeError):
    """The sources could not be compiled; the message says why."""


def require_compiler() -> None:
    """Raise CompilerError where ziglang is not installed."""
    if find_spec("ziglang") is None:
        raise CompilerError("no C compiler: pip install 'twintube[fmu]'")


def headers() -> Path:
    """The folder with the headers of FMI 2.0 and 3.0: fmpy has them."""
    spec = find_spec("fmpy")
    if spec is None or spec.origin is None:
        raise CompilerError("no headers of FMI: pip install 'twintube[fmu]'")
    return Path(spec.origin).parent / "c-code"


def target_flags(target: str, flags: Sequence[str], file: str) -> tuple[str, ...]:
    """What a target needs besides the common flags: code that can be loaded anywhere, on macOS a name without a path."""
    if "windows" in target or "wasm" in target:
        return ()
    if "macos" in target and "-shared" in flags:
        return ("-fPIC", f"-Wl,-install_name,@rpath/{file}")
    return ("-fPIC",)


def compiler_environment() -> dict[str, str]:
    """The environment with folders for what the compiler keeps: ours, but where the user names some that can be written."""
    ours = str(cache_folder("zig"))
    named = {name: os.path.abspath(folder) for name in CACHES if (folder := os.environ.get(name))}
    return {**os.environ, **{name: ours for name in CACHES}, **{k: v for k, v in named.items() if writable(Path(v))}}


def compiled(source: Path, target: str, output: Path, flags: Sequence[str] = FLAGS) -> None:
    """Compile a source file for a target; raises CompilerError."""
    require_compiler()
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target, *flags, *target_flags(target, flags, output.name)]
    command += [f"-I{headers()}", str(source), "-o", str(output), "-lm"]
    environment = compiler_environment()
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, cwd=output.parent, env=environment, timeout=LONGEST
        )
    except subprocess.TimeoutExpired:
        raise CompilerError(
            f"{target}: the compiler did not end within {LONGEST} s; delete its cache {environment[CACHES[0]]}, "
            f"or name another folder by {CACHES[0]}"
        ) from None
    if done.returncode != 0 or not output.exists():
        raise CompilerError(f"{target}: {done.stderr.strip() or 'the compiler wrote no library'}")


def key(texts: Mapping[str, str], target: str, file: str, source: str = COMPILED, flags: Sequence[str] = FLAGS) -> str:
    """A digest of all that a library depends on: sources, headers, flags, target, name and compiler."""
    parts = [target, file, source, version("ziglang"), *flags, *target_flags(target, flags, file)]
    parts += [part for name in sorted(texts) for part in (name, texts[name])]
    parts += [path.read_text(encoding="utf-8") for path in sorted(headers().glob("fmi[23]*.h"))]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def library(texts: Mapping[str, str], target: str, file: str, source: str = COMPILED, flags: Sequence[str] = FLAGS) -> bytes:
    """A library for a target, from the cache where it was compiled before; raises CompilerError."""
    require_compiler()
    name = key(texts, target, file, source, flags)
    data = library_cache.stored(name)
    if data is None:
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            for path, text in texts.items():
                (folder / path).write_text(text, encoding="utf-8")
            output = folder / "out" / file
            output.parent.mkdir()
            compiled(folder / source, target, output, flags)
            data = output.read_bytes()
        library_cache.store(name, data)
    return data


def universal(parts: Mapping[str, bytes]) -> bytes:
    """One file for several processors: a header with the place of each, as Apple's lipo writes it."""
    head, body, at = b"", b"", 1 << PAGE
    for target, data in parts.items():
        head += struct.pack(">IIIII", *MACHINES[target], at, len(data), PAGE)
        padded = data + b"\0" * (-len(data) % (1 << PAGE))
        body += padded
        at += len(padded)
    head = struct.pack(">II", 0xCAFEBABE, len(parts)) + head
    return head + b"\0" * ((1 << PAGE) - len(head)) + body


def binaries(
    texts: Mapping[str, str],
    name: str,
    platforms: Sequence[str],
    progress: Callable[[str], None] = lambda text: None,
    standard: Standard = STANDARDS[2],
) -> dict[str, bytes]:
    """The libraries of known platforms by their path inside the FMU; targets are compiled in parallel."""
    require_compiler()
    libraries = {}
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        waiting: dict[str, dict[str, Future[bytes]]] = {}
        for platform in platforms:
            ending, targets = standard.platforms[platform]
            file, source = f"{name}.{ending}", standard.compiled
            waiting[platform] = {t: workers.submit(library, texts, t, file, source) for t in targets}
        try:
            for number, (platform, futures) in enumerate(waiting.items(), start=1):
                progress(f"library {number} of {len(waiting)}, {platform}")
                if wait(futures.values(), SLOW).not_done:
                    progress(
                        f"{platform} takes longer the first time, as its runtime is compiled too (Windows: two minutes)"
                    )
                parts = {target: future.result() for target, future in futures.items()}
                whole = universal(parts) if len(parts) > 1 else next(iter(parts.values()))
                libraries[f"binaries/{platform}/{name}.{standard.platforms[platform][0]}"] = whole
        except BaseException:
            workers.shutdown(cancel_futures=True)
            raise
    return libraries
