"""Results of the methods of identification."""

import dataclasses
import inspect
import os
from typing import Any, Dict, Optional, Sequence, Union

from sinew import _sinew
from sinew._tables import Path


def _write(path: Path, text: str, force: bool) -> None:
    with open(path, "w" if force else "x", encoding="utf-8") as file:
        file.write(text)


def settings_text(doc: str, rows: Sequence[Dict[str, Any]]) -> str:
    """Return a docstring that ends with a line for each setting of a method."""
    lines = [inspect.cleandoc(doc), ""]
    for row in rows:
        unit = f" [{row['unit']}]" if "unit" in row else ""
        words = row.get("words", ())
        words = f": {', '.join(words)}" if any(word not in row["doc"] for word in words) else ""
        usual = f"; default: {row['default']}" if "default" in row else ""
        lines.append(f"{row['keyword']}{unit}: {row['doc']}{words}{usual}.")
    return "\n".join(lines)


class Found:
    """Result of a method: its report and its parameter file."""

    report: Dict[str, Any]
    """As `sinew identify --json` prints it: all models that were tried, with values, intervals, errors."""

    def __init__(self, found: _sinew.Identified) -> None:
        """Hold the result of the library."""
        self._found = found
        self.report = found.report

    @property
    def model(self) -> str:
        """The name of the law that was chosen."""
        return str(self.report["chosen"])

    @property
    def score(self) -> Sequence[Dict[str, Any]]:
        """Agreement of the simulated machine, driven by the valve commands, with a run that was not fitted.

        One dict per quantity, "angle" [rad], "tension" [N], "pressure" [Pa]: "parts" has rmse, nrmse,
        correlation and r_squared of each joint or muscle, "all" those of all together. Empty: not scored.
        """
        return list(self.report.get("score", []))

    def text(self, path: Path = "") -> str:
        """Return the text of the parameter file, with the path of a base relative to `path`.

        Raises RefusalError if the data do not support a file, IndexError if the method makes none.
        """
        return self._found.text(0, os.fspath(path))

    def write(self, path: Path, force: bool = False) -> None:
        """Write the parameter file. Raises FileExistsError unless `force` is set, and like text()."""
        _write(path, self.text(path), force)

    def page(self) -> str:
        """Return the HTML page with the data and the models, like `--report`.

        Raises ValueError for a counted braid, RuntimeError if the library was built without a page.
        """
        return self._found.page()

    def _repr_html_(self) -> Optional[str]:
        """Return the page for a cell of a notebook."""
        return self._found.cell()

    def __repr__(self) -> str:
        """Return the method's subject."""
        return f"<sinew.identify.{type(self).__name__} {self.report.get('subject', '')}>"


class Joint(Found):
    """Result for a joint: a part of its robot's file, and its actuator's file."""

    def actuator_text(self) -> str:
        """Return the text of the actuator's file, with the identified effectiveness."""
        return self._found.text(1, "")

    def write_actuator(self, path: Path, force: bool = False) -> None:
        """Write the actuator's file. Raises FileExistsError unless `force` is set."""
        _write(path, self.actuator_text(), force)


class Valve(Found):
    """Result for a valve."""

    @property
    def refused(self) -> str:
        """Results that the data do not support, besides those in the report; empty if they support all."""
        return self._found.refused

    def timing(self, frequency: Union[float, int, str, None] = None) -> str:
        """Return predict.dat: instants to switch the coil, so that the valve itself is open for the duty.

        frequency [Hz] of the pulses; None: that of the identification, or 100 Hz. Raises RefusalError if
        the delays are unknown.
        """
        return self._found.timing(frequency)[0]


@dataclasses.dataclass(frozen=True)
class Static:
    """The static law of an actuator, or of several of one make.

    report: output of `sinew identify static --json`: all models that were tried, with values, intervals
        and errors, and the chosen one.
    files: the text of an actuator file for each muscle, the longest first.
    """

    report: Dict[str, Any]
    files: Sequence[str]

    @property
    def model(self) -> str:
        """The name of the law that was chosen."""
        return str(self.report["chosen"])

    def write(self, path: Path, muscle: int = 0, force: bool = False) -> None:
        """Write the actuator file of a muscle. Raises FileExistsError unless `force` is set."""
        if not 0 <= muscle < len(self.files):
            raise IndexError(f"muscle: found {muscle}; expected 0 to {len(self.files) - 1}")
        _write(path, self.files[muscle], force)


@dataclasses.dataclass(frozen=True)
class Checked:
    """Check of measurements: their contents, their faults, and the parameters that they determine.

    report: output of `sinew identify check --json`: recognised columns, noise of the force, parameters
        that the data determine, and the checks.
    """

    report: Dict[str, Any]

    @property
    def red(self) -> bool:
        """Whether a check is red: then a fit would be wrong."""
        return bool(self.report["red"])

    @property
    def checks(self) -> Sequence[Dict[str, str]]:
        """The checks: each its name, light ("green", "grey", "yellow" or "red"), evidence and advice."""
        return tuple(self.report["checks"])

    def lights(self) -> Dict[str, str]:
        """Return the light of each check by its name; of several with one name the worst."""
        out: Dict[str, str] = {}
        for light in ("green", "grey", "yellow", "red"):
            out.update({check["name"]: light for check in self.checks if check["light"] == light})
        return out

    def __str__(self) -> str:
        """Return the checks that are not green, a line each."""
        return "\n".join(
            f"{check['light']}: {check['name']}: {check['evidence']} {check.get('advice', '')}".rstrip()
            for check in self.checks
            if check["light"] != "green"
        )


@dataclasses.dataclass(frozen=True)
class Plan:
    """Plan of the lengths and pressures to measure, and the table to fill in."""

    report: Dict[str, Any]
    """As `sinew identify plan --json` prints it: mounts in order, each with the error after it, in percent."""

    table: str
    """CSV with a row for each reading, whose force is empty."""

    @property
    def minutes(self) -> float:
        """Duration of the measurements [min]."""
        return float(self.report["time_s"]) / 60

    def write(self, path: Path, force: bool = False) -> None:
        """Write the table. Raises FileExistsError unless `force` is set."""
        _write(path, self.table, force)
