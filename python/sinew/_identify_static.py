"""A muscle at rest: its static law, what it is fitted to, and what to measure for it."""

from typing import Any, Dict, List, Optional, Sequence, Union

import numpy.typing

from sinew import _sinew
from sinew._found import Checked, Found, Plan, Static
from sinew._identify_settings import Path, Quantity, in_meters
from sinew._tables import held_out_of, tables_of


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
    diameter: Optional[float] = None,
    anyway: bool = False,
) -> Static:
    """Return the static law of an actuator from forces [N] at lengths [m] and gauge pressures [Pa].

    Arrays with a number for each point, or one number for all. rest_length [m] of the muscle without
    pressure and load (None: the longest length; several say which points are of which muscle). fitted:
    False for points that are held out, to score what was not seen; hold_out does that with every second
    "pressure" or each "length" once. model: that law alone; else the data choose. source: where the data
    are from, for the file. diameter [m] without pressure, to compare the force with. The points are checked
    first, as by check(): what is red is refused, unless they are to be fitted anyway; then it is among the
    report's warnings, as suspicions are.

    Raises RefusalError where the data support no law or a check is red, and ValueError for arrays that do
    not belong together or a model that there is not.
    """
    report, files = _sinew.identify_static(
        length, pressure, force, rest_length, fitted, model, hold_out, name, source, diameter, anyway
    )
    texts: List[str] = files
    return Static(report, tuple(texts))


def static_from(
    data: Any,
    *,
    rest_length: Optional[Quantity] = None,
    actuator: Optional[Path] = None,
    branch: str = "both",
    fit_where: Union[str, Sequence[str]] = (),
    hold_out: Any = "",
    model: str = "",
    name: str = "bpa",
    diameter: Optional[Quantity] = None,
    anyway: bool = False,
    predict: Union[Quantity, Sequence[Quantity]] = (),
) -> Static:
    """Return the static law of an actuator from tables, or recordings with a column of time.

    Columns force [N] or load [kg], pressure [Pa gauge], length [m], or contraction [1] with rest_length; branch,
    time where there are such. data: a table, or several; of a file without a column sinew.identify.Table states its
    value, Table("rig.csv", values={"length": "205 mm"}). actuator: a file whose braid is known. branch: "fill",
    "vent" or "both". fit_where: only rows with "NAME=VALUE,..." are fitted, the others held out. hold_out: "pressure"
    (every second), "length" or "muscle" (each once), or another table. diameter [m] without pressure, and
    anyway: as static() has them. predict: rest lengths [m] that nobody measured; their files follow those
    of the muscles that were.
    """
    unseen = [predict] if isinstance(predict, (str, float, int)) else predict
    settings = _static_settings(data, {**locals(), "predict": [in_meters(one) for one in unseen]})
    del settings["unseen"]
    found = _sinew.identify_tables("static", tables_of("static", data), settings)
    return Static(found.report, tuple(found.text(i, "") for i in range(found.files)))


def scale(
    file: Path,
    rest_length: Quantity,
    *,
    reading: Union[str, Sequence[float]] = "",
    actuator: str = "",
    name: str = "",
) -> Found:
    """Return the actuator of a muscle that nobody measured, from the file of one of its make.

    file: as static_from() writes it; actuator: which one in it. rest_length [m] of the new muscle. reading:
    one of it at rest, (length [m], pressure [Pa gauge], force [N]) or "115 mm, 400 kPa gauge, 210 N", which
    corrects the law. The report tells the largest force and within what 68 and 95 % of forces are expected;
    None where no muscle was left out when the file was made. name: of the new actuator.
    """
    if not isinstance(reading, str):
        length, pressure, force = (float(one) for one in reading)
        reading = f"{length!r} m, {pressure!r} Pa gauge, {force!r} N"
    settings = {
        "file": file,
        "actuator": actuator,
        "rest_length": rest_length,
        "reading": reading,
        "name": name,
    }
    return Found(_sinew.identify_tables("scale", [], settings))


def check(
    data: Any,
    *,
    rest_length: Optional[Quantity] = None,
    actuator: Optional[Path] = None,
    branch: str = "both",
    fit_where: Union[str, Sequence[str]] = (),
    hold_out: Any = "",
    diameter: Optional[Quantity] = None,
) -> Checked:
    """Return what static_from() would find in the same tables, and what speaks against it.

    Arguments are those of static_from(). What no method can read is a red check, too.
    """
    settings = _static_settings(data, dict(locals()))
    return Checked(_sinew.identify_tables("check", tables_of("check", data), settings).report)


def _static_settings(data: Any, given: Dict[str, Any]) -> Dict[str, Any]:
    """Return the settings of a call; what is held out may be a word or a table."""
    settings = {name: value for name, value in given.items() if name not in ("data", "hold_out")}
    if isinstance(given["hold_out"], str):
        settings["hold_out"] = given["hold_out"]
    else:
        settings["held_out"] = held_out_of("static", data, given["hold_out"])
    return settings


def columns(method: str) -> Dict[str, Any]:
    """Return which columns a method of `sinew identify` reads, as `--columns --json` prints it.

    method: "static", "dynamic", ... For each column its quantity, accepted units, meaning, and whether it is
    needed; for each kind of table what a row is. Raises sinew.InputError for a method that there is not.
    """
    return dict(_sinew.identify_inputs(method))


def template(method: str, kind: str = "") -> str:
    """Return a table to fill in, as `--template` writes it: CSV that the method reads as it is.

    kind: of table, where a method takes several, "chart"; else the usual one.
    """
    return str(_sinew.identify_template(method, kind))


def plan(
    data: Any = None,
    *,
    rest_length: Optional[Quantity] = None,
    diameter: Optional[Quantity] = None,
    actuator: Optional[Path] = None,
    pressure: Optional[Quantity] = None,
    noise: Optional[Quantity] = None,
    length_error: Quantity = 1e-4,
    law_error: Quantity = 0.01,
    error: Quantity = 0.02,
    mount_time: Quantity = 600.0,
    step_time: Quantity = 30.0,
    shortest: Optional[Quantity] = None,
    longest: Optional[Quantity] = None,
    lowest: Optional[Quantity] = None,
    criterion: str = "mean",
    most: int = 12,
    branch: str = "both",
) -> Plan:
    """Return which lengths and pressures to measure so that a static law is known well enough.

    Without data for a muscle that nobody has measured: its rest_length and diameter [m], or an actuator's
    file with one like it, and the highest pressure [Pa gauge]. With data, as of static_from(), what to
    measure next and what it buys; actuator's braid is then known. noise [N] of a reading (None: 2 N, or
    what the data scatter), length_error [m] of a mount, law_error that no measurement lowers and error that
    is wanted, both shares of the largest force; mount_time and step_time [s]. shortest and longest [m],
    lowest [Pa gauge]: where the law is wanted. criterion: "mean", error is a root mean square over that
    region; "worst", half of the 95 % interval at its worst place. most: mounts.
    """
    settings = {
        "rest_length": rest_length,
        "diameter": diameter,
        "actuator": actuator,
        "pressure": pressure,
        "noise": noise,
        "length_error": length_error,
        "law_error": law_error,
        "error": error,
        "mount_time": mount_time,
        "step_time": step_time,
        "shortest": shortest,
        "longest": longest,
        "lowest": lowest,
        "criterion": criterion,
        "most": most,
        "branch": branch,
    }
    report, table = _sinew.identify_plan([] if data is None else tables_of("static", data), settings)
    return Plan(report, table)
