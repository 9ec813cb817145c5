"""`python -m twintube.native`: make the libraries of this machine, of named platforms or of all."""

import argparse
import sys

from twintube.native.compiler import TARGETS, CompilerError, this_machine
from twintube.native.kinds import SubsetError
from twintube.native.made import made_for


def main() -> None:
    """Compile and say what was made; ends with 1 where it cannot be."""
    parser = argparse.ArgumentParser(prog="python -m twintube.native", description=__doc__)
    parser.add_argument("platform", nargs="*", help=f"one of {', '.join(TARGETS)}; by default that of this machine")
    parser.add_argument("--all", action="store_true", help="every platform; needs the package ziglang")
    arguments = parser.parse_args()
    try:
        for platform in list(TARGETS) if arguments.all else arguments.platform or [this_machine()]:
            for path in made_for(platform):
                print(f"{path}: {path.stat().st_size // 1024} kB", flush=True)
    except (CompilerError, SubsetError) as error:
        sys.exit(f"error: {error}")


if __name__ == "__main__":
    main()
