"""Design calculations: from what a robot has to do to its parts.

    import sinew.design as design

    joint = design.joint(actuator="robots/leg/actuator.toml", torque="20 lbf in", angles="40 deg",
                         pressure="100 psi gauge")
    joint.report["moment_arm_m"], joint.report["designs"]
    open("joint.html", "w").write(joint.page())

Each calculation of `sinew design` is a function with the same report and page. Settings are keywords: a
number in the SI unit given here, or text with a unit, "6 lb". Functions raise sinew.InputError for a
setting that cannot be used, and TypeError for an argument of the wrong type or an unknown one.
"""

import os
from typing import Any, Callable, Dict, Optional, Union

from sinew import _sinew
from sinew._found import _write, settings_text
from sinew._tables import Path

__all__ = ["Design", "air", "joint", "life", "valve"]

Setting = Union[float, int, str, "os.PathLike[str]", None]


class Design:
    """Result of a design calculation."""

    report: Dict[str, Any]
    """As `sinew design --json` prints it: values in SI, their intervals, tables, notes and warnings."""

    def __init__(self, designed: _sinew.Designed) -> None:
        """Hold the result of the library."""
        self._designed = designed
        self.report = designed.report

    @property
    def refused(self) -> str:
        """Why no design is possible; empty: there is one."""
        return self._designed.refused

    def text(self) -> str:
        """Return the result as text, in SI."""
        return self._designed.text()

    def page(self) -> str:
        """Return the page with tables and plots, as HTML.

        Raises RuntimeError if the library was built without a page.
        """
        return self._designed.page()

    def write(self, path: Path, force: bool = False) -> None:
        """Write the file that the design makes, such as a robot file over `base`.

        Raises FileExistsError unless `force` is set, and ValueError if the design makes none.
        """
        _write(path, self._designed.file(os.fspath(path)), force)

    def _repr_html_(self) -> Optional[str]:
        """Return the page for a cell of a notebook."""
        return self._designed.cell()

    def __repr__(self) -> str:
        """Return the title."""
        return f"<sinew.design.Design {self.report['title']}>"


def _calculation(name: str, doc: str) -> Callable[..., Design]:
    def calculation(**settings: Setting) -> Design:
        return Design(_sinew.design(name, settings))

    calculation.__name__ = calculation.__qualname__ = name
    calculation.__doc__ = settings_text(doc, _sinew.design_settings(name))
    return calculation


joint = _calculation("joint", "Return the feasible joints with a pair of muscles, and the one that needs the fewest.")
valve = _calculation("valve", "Return the flow and the delays that a valve of a muscle needs, and the valves that have them.")
air = _calculation("air", "Return how long a store of air lasts: time, steps and distance, with their spread.")
life = _calculation("life", "Return how many cycles and how long muscles last, as the range that is known.")
