"""`python -m twintube.native`: translate and compile the library of this machine."""

import sys

from twintube.native import build
from twintube.native.compiler import CompilerError, this_machine
from twintube.native.kinds import SubsetError


def main() -> None:
    """Compile and say what was made; ends with 1 where it cannot be."""
    try:
        path = build.made(this_machine())
    except (CompilerError, SubsetError) as error:
        sys.exit(f"error: {error}")
    print(f"{path}: {path.stat().st_size // 1024} kB")


if __name__ == "__main__":
    main()
