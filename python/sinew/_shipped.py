"""Robots and experiments shipped with Sinew."""

import os
from typing import Union

from sinew import _where


def shipped(path: Union[str, "os.PathLike[str]"] = "") -> str:
    """Return the path of a file shipped with Sinew: shipped("experiments/walk-test-1.toml").

    Without an argument, returns their folder. Raises FileNotFoundError, which lists the existing files.
    """
    full = os.path.join(_where.SHARE, os.fspath(path))
    if os.path.exists(full):
        return full
    folder = os.path.dirname(full)
    there = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
    raise FileNotFoundError(
        f"found no {os.fspath(path)!r} with Sinew; expected one of "
        f"{', '.join(there) if there else 'robots/, experiments/'}"
    )
