"""What a method of identification found."""

import dataclasses
import os
from typing import Any, Dict, Optional, Sequence, Union

from sinew import _sinew
from sinew._tables import Path


def _write(path: Path, text: str, force: bool) -> None:
    with open(path, "w" if force else "x", encoding="utf-8") as file:
        file.write(text)


class Found:
    """What a method found: its report, and the parameter file that it makes."""

    report: Dict[str, Any]
    """As `sinew identify --json` prints it: all models that were tried, with values, intervals, errors."""

    def __init__(self, found: _sinew.Identified) -> None:
        """Hold what the library found."""
        self._found = found
        self.report = found.report

    @property
    def model(self) -> str:
        """The name of the law that was chosen."""
        return str(self.report["chosen"])

    @property
    def score(self) -> Sequence[Dict[str, Any]]:
        """How a machine in simulation meets a run that was not fitted, driven by its valve commands alone.

        One of each quantity, "angle" [rad], "tension" [N], "pressure" [Pa]: "parts" has rmse, nrmse,
        correlation and r_squared of each joint or muscle, "all" those of all of them. Empty: not scored.
        """
        return list(self.report.get("score", []))

    def text(self, path: Path = "") -> str:
        """Return the parameter file, as it would stand at `path`: a base is named from there.

        Raises RefusalError where the data support no file, IndexError where the method makes none.
        """
        return self._found.text(0, os.fspath(path))

    def write(self, path: Path, force: bool = False) -> None:
        """Write the parameter file. Raises FileExistsError, unless `force` replaces it; and as text()."""
        _write(path, self.text(path), force)

    def page(self) -> str:
        """Return the page with the data beside the models, as HTML: what `--report` leaves.

        Raises ValueError for what was counted, RuntimeError where the library was built without a page.
        """
        return self._found.page()

    def _repr_html_(self) -> Optional[str]:
        """Return the page for a cell of a notebook."""
        return self._found.cell()

    def __repr__(self) -> str:
        """Return the method's subject."""
        return f"<sinew.identify.{type(self).__name__} {self.report.get('subject', '')}>"


class Joint(Found):
    """What was found of a joint: a part of its robot's file, and its actuator's."""

    def actuator_text(self) -> str:
        """Return the actuator's file, with the effectiveness that was found."""
        return self._found.text(1, "")

    def write_actuator(self, path: Path, force: bool = False) -> None:
        """Write the actuator's file. Raises FileExistsError, unless `force` replaces it."""
        _write(path, self.actuator_text(), force)


class Valve(Found):
    """What was found of a valve."""

    @property
    def refused(self) -> str:
        """What the data do not support, beside what the report has; empty where they support all."""
        return self._found.refused

    def timing(self, frequency: Union[float, int, str, None] = None) -> str:
        """Return predict.dat: when to switch the coil, so that the valve itself is open for the duty.

        frequency [Hz] of the pulses; None: the one that was asked with, or 100 Hz. Raises RefusalError
        where the delays are not known.
        """
        return self._found.timing(frequency)[0]


@dataclasses.dataclass(frozen=True)
class Static:
    """The static law of an actuator, or of several of one make.

    report: what was found, as `sinew identify static --json` prints it: all models that were tried, with
        values, intervals and errors, and the chosen one.
    files: the text of an actuator file for each muscle, the longest first.
    """

    report: Dict[str, Any]
    files: Sequence[str]

    @property
    def model(self) -> str:
        """The name of the law that was chosen."""
        return str(self.report["chosen"])

    def write(self, path: Path, muscle: int = 0, force: bool = False) -> None:
        """Write the actuator file of a muscle. Raises FileExistsError, unless `force` replaces it."""
        if not 0 <= muscle < len(self.files):
            raise IndexError(f"muscle: found {muscle}; expected 0 to {len(self.files) - 1}")
        _write(path, self.files[muscle], force)


@dataclasses.dataclass(frozen=True)
class Checked:
    """What measurements are, what is wrong with them, and what a static law could find in them.

    report: as `sinew identify check --json` prints it: what was recognised, noise of the force, which
        parameters the data determine, and the checks.
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
        """Return what is not green, a line each."""
        return "\n".join(
            f"{check['light']}: {check['name']}: {check['evidence']} {check.get('advice', '')}".rstrip()
            for check in self.checks
            if check["light"] != "green"
        )


@dataclasses.dataclass(frozen=True)
class Plan:
    """Which lengths and pressures to measure: the plan, and the table to fill in."""

    report: Dict[str, Any]
    """As `sinew identify plan --json` prints it: mounts in order, each with the error after it, in percent."""

    table: str
    """CSV with a row for each reading, whose force is empty."""

    @property
    def minutes(self) -> float:
        """How long it takes."""
        return float(self.report["time_s"]) / 60

    def write(self, path: Path, force: bool = False) -> None:
        """Write the table. Raises FileExistsError, unless `force` replaces it."""
        _write(path, self.table, force)
