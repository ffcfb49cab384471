"""Parameters from measurements.

    import sinew.identify

    found = sinew.identify.static(length, pressure, force, rest_length=0.25)
    found.model, found.report["parameters"], found.report["cross_validated"]
    found.write("my-actuator.toml")
    sinew.Actuator("my-actuator.toml").tension(0.22, 3e5)

What the numbers mean, and what is refused: docs/how-to-characterise.md and docs/theory/static-models.md.
"""

import dataclasses
import os
from typing import Any, Dict, List, Optional, Sequence, Union

import numpy.typing

from sinew import _sinew
from sinew._sinew import RefusalError

__all__ = ["RefusalError", "Static", "static"]


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

    def write(self, path: "Union[str, os.PathLike[str]]", muscle: int = 0, force: bool = False) -> None:
        """Write the actuator file of a muscle. Raises FileExistsError, unless `force` replaces it."""
        if not 0 <= muscle < len(self.files):
            raise IndexError(f"muscle: found {muscle}; expected 0 to {len(self.files) - 1}")
        with open(path, "w" if force else "x", encoding="utf-8") as file:
            file.write(self.files[muscle])


def static(
    length: numpy.typing.ArrayLike,
    pressure: numpy.typing.ArrayLike,
    force: numpy.typing.ArrayLike,
    *,
    rest_length: Optional[numpy.typing.ArrayLike] = None,
    fitted: numpy.typing.ArrayLike = True,
    model: str = "",
    hold_out: str = "",
    name: str = "bpa",
    source: str = "arrays of Python",
) -> Static:
    """Return the static law of an actuator from forces [N] at lengths [m] and gauge pressures [Pa].

    Arrays with a number for each point, or one number for all. rest_length [m] of the muscle without
    pressure and load (None: the longest length; several say which points are of which muscle). fitted: False for
    points that are held out, to score what was not seen; hold_out does that with every second
    "pressure" or each "length" once. model: that law alone; else the data choose. source: where the data
    are from, for the file.

    Raises RefusalError where the data support no law, and ValueError for arrays that do not belong
    together or a model that there is not.
    """
    report, files = _sinew.identify_static(
        length, pressure, force, rest_length, fitted, model, hold_out, name, source
    )
    texts: List[str] = files
    return Static(report, tuple(texts))
