"""Sources to shared libraries for all platforms, by the C compiler of the package ziglang."""

import struct
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path

from twintube.fmu.platforms import PLATFORMS
from twintube.fmu.sources import COMPILED

# No fused multiply-add: every platform computes the same operations in the same order.
FLAGS = ("-std=c99", "-O2", "-ffp-contract=off", "-fvisibility=hidden", "-shared", "-s")
PAGE = 14  # bits of the alignment of a part of a universal file
MACHINES = {"x86_64-macos": (0x01000007, 3), "aarch64-macos": (0x0100000C, 0)}


class CompilerError(RuntimeError):
    """The sources could not be compiled; the message says why."""


def headers() -> Path:
    """The folder with the headers of FMI 2.0: fmpy has them."""
    spec = find_spec("fmpy")
    assert spec is not None and spec.origin is not None
    return Path(spec.origin).parent / "c-code"


def compiled(source: Path, target: str, output: Path, flags: Sequence[str] = FLAGS) -> None:
    """Compile one source file for a target; raises CompilerError."""
    if find_spec("ziglang") is None:
        raise CompilerError("no C compiler: pip install ziglang")
    position = () if "windows" in target else ("-fPIC",)
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target, *flags, *position, f"-I{headers()}"]
    done = subprocess.run(
        [*command, str(source), "-o", str(output), "-lm"], capture_output=True, text=True, check=False, cwd=output.parent
    )
    if done.returncode != 0 or not output.exists():
        raise CompilerError(f"{target}: {done.stderr.strip() or 'no library was made'}")


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


def binaries(sources: Mapping[str, str], name: str, platforms: Sequence[str]) -> dict[str, bytes]:
    """The libraries by their path inside the FMU."""
    found = {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for file, text in sources.items():
            (folder / file).write_text(text, encoding="utf-8")
        for platform in platforms:
            if platform not in PLATFORMS:
                raise CompilerError(f"platform = {platform}: must be one of {', '.join(PLATFORMS)}")
            ending, targets = PLATFORMS[platform]
            parts = {}
            for target in targets:
                made = folder / target / f"{name}.{ending}"
                made.parent.mkdir()
                compiled(folder / COMPILED, target, made)
                parts[target] = made.read_bytes()
            whole = universal(parts) if len(parts) > 1 else next(iter(parts.values()))
            found[f"binaries/{platform}/{name}.{ending}"] = whole
    return found
