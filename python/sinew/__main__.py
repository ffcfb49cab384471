"""`python3 -m sinew run …`: runs the program `sinew` of this package's installation."""

import os
import sys


def program() -> str:
    """Return the program's path: bin/sinew in a folder above this package.

    Raises FileNotFoundError if this installation has none.
    """
    above = os.path.dirname(os.path.abspath(__file__))
    while above != os.path.dirname(above):
        above = os.path.dirname(above)
        path = os.path.join(above, "bin", "sinew")
        if os.access(path, os.X_OK):
            return path
    raise FileNotFoundError(
        f"found no program bin/sinew above {os.path.dirname(os.path.abspath(__file__))}; expected the "
        "one that is installed with the package: try `cmake --install`, or the package sinew"
    )


def main() -> None:
    """Replace this process by the program, with the same arguments."""
    try:
        path = program()
    except FileNotFoundError as error:
        sys.exit(f"error: {error}")
    os.execv(path, ["sinew", *sys.argv[1:]])


if __name__ == "__main__":
    main()
