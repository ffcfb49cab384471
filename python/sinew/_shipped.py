"""The robots and experiments that come with Sinew."""

import os
from typing import Union

from sinew import _where


def shipped(path: Union[str, "os.PathLike[str]"] = "") -> str:
    """Return where a file that comes with Sinew is: shipped("experiments/walk-test-1.toml").

    Without a path, the folder of them all. Raises FileNotFoundError, which names what is there.
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
