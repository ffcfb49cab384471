"""Conversion of recordings to pandas."""

from typing import TYPE_CHECKING, Any, Optional, Sequence

from sinew._sinew import Recording

if TYPE_CHECKING:
    import pandas  # type: ignore[import]


def to_pandas(recording: Recording, channels: Optional[Sequence[str]] = None) -> "pandas.DataFrame":
    """Return channels of a recording as a table, a row for each instant, the index in seconds.

    Without `channels`, all that are sampled together; valves' edges have times of their own and must
    be named. If times differ, a cell without a sample is NaN. Raises KeyError for an unknown channel,
    and ImportError if pandas is not installed.
    """
    import pandas

    if channels is None:
        rows = recording.time(recording.channels[0].name)
        channels = [
            c.name
            for c in recording.channels
            if len(recording.time(c.name)) == len(rows)
            and bool((recording.time(c.name) == rows).all())
        ]
    columns: "dict[str, Any]" = {}
    for name in channels:
        index = pandas.Index(recording.time(name), name="time [s]")
        columns[name] = pandas.Series(recording[name], index=index)
    return pandas.DataFrame(columns)
