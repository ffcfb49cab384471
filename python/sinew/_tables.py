"""Conversion of tables of measurements to the library's form: files, or columns of numbers."""

import dataclasses
import os
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Union

import numpy

from sinew import _sinew

Path = Union[str, "os.PathLike[str]"]


@dataclasses.dataclass(frozen=True)
class Table:
    """A table of measurements, and the meaning of its columns.

    data: the path of a CSV file; or columns by name, each an array or one number for all rows: a dict, a
        pandas frame, a structured array. A column is named "force [lbf]", or "force" if it is in SI.
    values: values of missing columns, {"length": "205 mm"}. offsets: added to columns, {"length": "200 mm"}.
    names: the table's name of a column, {"force": "F_N"}. units: units of its columns, {"F_N": "N"}.
    where: only rows with these values, {"phase": "fill"}. columns: the header of a file without one,
        ["force [N]", "time [s]"]. atmosphere: reference of gauge pressures [Pa], absolute.
    drop_incomplete: leave out rows with cells that do not hold a number.

    Format settings that a file may leave open: encoding "latin1"; decimal "." or ","; thousands ".", ",",
    " " or "'"; dates "day first", "month first" or "excel" (days since 1900); rate "100 Hz" of the rows, in
    place of a column of times; spread_times: rows that share a time are spread evenly up to the next time;
    part: 2 reads only the second of several recordings in the file.
    """

    data: Any
    names: Optional[Mapping[str, str]] = None
    units: Optional[Mapping[str, str]] = None
    where: Optional[Mapping[str, str]] = None
    columns: Union[str, Sequence[str], None] = None
    atmosphere: Union[float, int, str, None] = None
    drop_incomplete: bool = False
    encoding: Optional[str] = None
    decimal: Optional[str] = None
    thousands: Optional[str] = None
    dates: Optional[str] = None
    rate: Optional[str] = None
    spread_times: bool = False
    part: int = 0
    values: Optional[Mapping[str, str]] = None
    offsets: Optional[Mapping[str, str]] = None


def names_of(data: Any) -> "Optional[List[str]]":
    """Return the names of the columns; None if the object has no named columns."""
    if isinstance(data, numpy.ndarray):
        return list(data.dtype.names) if data.dtype.names else None
    keys = getattr(data, "keys", None)
    return [str(key) for key in keys()] if callable(keys) else None


def number_text(number: "Union[float, int]") -> str:
    """Return a number as text, with all digits of large integers, which a float would round."""
    return str(number) if isinstance(number, int) and abs(number) > 2**53 else repr(float(number))


def cells(name: str, values: Any) -> "List[str]":
    """Return the cells of a column. Raises TypeError for values that a table cannot hold."""
    column = numpy.asarray(values)
    masked: Any = getattr(values, "mask", None) if isinstance(values, numpy.ma.MaskedArray) else None
    if masked is not None and numpy.any(masked):
        if column.dtype.kind not in "fiub":
            raise TypeError(f"{name}: found masked words; expected words alone")
    if column.ndim > 1:
        raise ValueError(f"{name}: found an array of shape {column.shape}; expected one number a row")
    if column.dtype.kind in "fiub":
        empty = numpy.zeros(column.shape, bool) if masked is None else numpy.broadcast_to(masked, column.shape)
        cells_of = zip(column.ravel().tolist(), empty.ravel().tolist())
        return ["nan" if is_empty else number_text(one) for one, is_empty in cells_of]
    texts = [str(one) for one in column.ravel().tolist()]
    for text in texts:
        if column.dtype.kind not in "UO" or any(mark in text for mark in ",;\t\n\r"):
            raise TypeError(f"{name}: found {text!r}; expected numbers, or words without separators")
    return texts


def text_of(table: Table, names: "List[str]", units: "Mapping[str, str]") -> str:
    """Return columns as the text of a CSV file."""
    called = {theirs: name for name, theirs in (table.names or {}).items()}
    header: "List[str]" = []
    columns: "List[List[str]]" = []
    for name in names:
        if any(mark in name for mark in ",;\t\n\r"):
            raise ValueError(f"column: found {name!r}; expected a name without separators")
        unit = units.get(called.get(name, name))
        told = "[" in name or name in (table.units or {})
        header.append(name if told or unit is None else f"{name} [{unit}]")
        columns.append(cells(name, table.data[name]))
    rows = max((len(column) for column in columns), default=0)
    for name, column in zip(names, columns):
        if len(column) not in (1, rows):
            raise ValueError(f"{name}: found {len(column)} numbers; expected {rows}, or one")
    full = [column * rows if len(column) != rows else column for column in columns]
    lines: "Iterable[str]" = (",".join(row) for row in zip(*full))
    return "\n".join([",".join(header), *lines, ""])


def texts_of(name: str, given: Any) -> "Optional[Dict[str, str]]":
    """Return a dict of texts, or None. Raises TypeError for anything else."""
    if given is None:
        return None
    pairs = dict(given) if isinstance(given, Mapping) else None
    if pairs is None or not all(isinstance(one, str) for pair in pairs.items() for one in pair):
        raise TypeError(f"{name}: found {given!r}; expected a dict of texts")
    return pairs


def header_of(given: Any) -> "Optional[List[str]]":
    """Return the given header as a list: from a list of texts, or a text with commas."""
    if given is None:
        return None
    if isinstance(given, str):
        return [one.strip() for one in given.split(",")]
    if not isinstance(given, (list, tuple)) or not all(isinstance(one, str) for one in given):
        raise TypeError(f"columns: found {given!r}; expected texts, \"force [N]\"")
    return list(given)


def parts_of(data: Any, units: "Mapping[str, str]", label: str) -> "Dict[str, Any]":
    """Return a table in the library's form; `label` is the name of a table without a file."""
    table = data if isinstance(data, Table) else Table(data)
    settings = (field.name for field in dataclasses.fields(table) if field.name != "data")
    parts: "Dict[str, Any]" = {name: getattr(table, name) for name in settings}
    for name in ("names", "units", "where", "values", "offsets"):
        parts[name] = texts_of(name, parts[name])
    parts.update(path=label, text=None, columns=header_of(table.columns))
    if isinstance(table.data, (str, os.PathLike)):
        parts["path"] = os.fspath(table.data)
        return parts
    names = names_of(table.data)
    if names is None:
        shown = repr(table.data)
        raise TypeError(
            f"data: found {shown[:60]}; expected the path of a CSV file, or columns by their names"
        )
    parts["text"] = text_of(table, names, units)
    return parts


def tables_of(method: str, data: Any, word: str = "arrays of Python") -> "List[Dict[str, Any]]":
    """Return one table, or a list of tables, in the library's form."""
    units = _sinew.identify_columns(method)
    if not isinstance(data, (list, tuple)):
        return [parts_of(data, units, word)]
    several = len(data) > 1
    return [
        parts_of(one, units, f"{word} {number}" if several else word)
        for number, one in enumerate(data, 1)
    ]


def like(data: Any, other: Any) -> Any:
    """Return another table with the column settings of the first, unless it is a Table itself."""
    first = data[0] if isinstance(data, (list, tuple)) and data else data
    if isinstance(first, Table) and not isinstance(other, Table):
        return dataclasses.replace(first, data=other)
    return other
