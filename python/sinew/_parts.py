"""Robots and other files of parts as objects whose attributes are their values."""

import os
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Union

from sinew import _sinew

_Sets = Optional[Union[Mapping[str, Any], Sequence[str]]]


class Part:
    """Table of a file. Its attributes are values, in SI, and the tables below.

    Names that are not identifiers are accessed with brackets.
    """

    _robot: "Robot"
    _key: str

    def __init__(self, robot: "Robot", key: str) -> None:
        object.__setattr__(self, "_robot", robot)
        object.__setattr__(self, "_key", key)

    def _below(self, name: str) -> str:
        return f"{self._key}.{name}" if self._key else name

    def _get(self, name: str) -> Any:
        key = self._below(name)
        if key in self._robot._values:
            return self._robot._values[key]
        if any(other.startswith(key + ".") for other in self._robot._origins):
            return Part(self._robot, key)
        if key in self._robot._origins:
            return None  # exists, but is not set
        raise KeyError(key)

    def _missing(self, name: str) -> str:
        return (
            f"{self._robot.path}: found no {self._below(name)!r}; expected one of "
            f"{', '.join(self) or 'none'}"
        )

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # Python's own: copying requests some before the key is set
            raise AttributeError(name)
        try:
            return self._get(name)
        except KeyError:
            raise AttributeError(self._missing(name)) from None

    def __getitem__(self, name: str) -> Any:
        try:
            return self._get(name)
        except KeyError:
            raise KeyError(self._missing(name)) from None

    def __setitem__(self, name: str, value: Any) -> None:
        self[name]  # raises KeyError if it does not exist
        self._robot._change(self._below(name), value)

    def __setattr__(self, name: str, value: Any) -> None:
        getattr(self, name)  # raises AttributeError if it does not exist
        self[name] = value

    def __iter__(self) -> Iterator[str]:
        begin = self._key + "." if self._key else ""
        names: Dict[str, None] = {}
        for key in self._robot._origins:
            if key.startswith(begin):
                names[key[len(begin) :].split(".")[0]] = None
        return iter(names)

    def __contains__(self, name: object) -> bool:
        return any(name == one for one in self)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self]

    def origin(self, name: str) -> Dict[str, Any]:
        """Return the origin of a value: text as written, unit, source, file, line, range.

        Raises KeyError for a name that is not a value.
        """
        key = self._below(name)
        if key not in self._robot._origins:
            raise KeyError(self._missing(name))
        return self._robot._origins[key]

    def __repr__(self) -> str:
        return f"<sinew.Part {self._key}: {', '.join(self)}>"


class Robot(Part):
    """File of a robot, an experiment, a rig, an actuator, valves or wiring.

        leg = sinew.Robot(sinew.shipped("robots/leg/robot.toml"))
        leg.joint.hip.damping                  # N m s/rad
        leg.joint.hip.damping = 0.1            # checked at once
        sinew.run(walk, leg.changes)

    Nothing is written to the file. Raises InputError for faults of the file and for invalid values.
    """

    path: str
    changes: Dict[str, Any]
    _values: Dict[str, Any]
    _origins: Dict[str, Dict[str, Any]]

    def __init__(self, path: "Union[str, os.PathLike[str]]", sets: _Sets = None) -> None:
        super().__init__(self, "")
        values, origins = _sinew.read_values(path, sets)
        for name, value in (
            ("path", os.fspath(path)),
            ("changes", {}),
            ("_sets", sets),
            ("_values", values),
            ("_origins", origins),
        ):
            object.__setattr__(self, name, value)

    def _change(self, key: str, value: Any) -> None:
        changes = {**self.changes, key: value}
        sets: Any = changes
        base = object.__getattribute__(self, "_sets")
        if isinstance(base, Mapping):
            sets = {**base, **changes}
        elif base is not None:
            raise TypeError("changes: found settings that are a list; expected a dict")
        values, origins = _sinew.read_values(self.path, sets)
        object.__setattr__(self, "changes", changes)
        object.__setattr__(self, "_values", values)
        object.__setattr__(self, "_origins", origins)

    def keys(self) -> List[str]:
        """Return the keys of all values, dotted."""
        return list(self._origins)

    def __repr__(self) -> str:
        return f"<sinew.Robot {self.path}: {', '.join(self)}>"
