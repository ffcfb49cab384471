"""Identification of parameters from measurements.

    import sinew.identify as identify

    found = identify.static(length, pressure, force, rest_length=0.25)
    found.model, found.report["parameters"], found.report["cross_validated"]
    found.write("my-actuator.toml")
    sinew.Actuator("my-actuator.toml").tension(0.22, 3e5)

    print(identify.check("forces.csv", rest_length="102 mm", diameter="10 mm"))

    identify.valve("fill.csv", volume="0.5 L").write("my-valve.toml")
    identify.valve({"time": t, "pressure": p}, volume=5e-4)

Each method of `sinew identify` is a function with the same report and the same file. It takes measurements
as one table, or several where stated: a CSV file's path; a dict, pandas frame or structured array of
columns; or a Table, which also describes columns of other programs. Settings are those of the program: a
number in the SI unit given here, or text with a unit, "6 lb".

Functions raise RefusalError if the data do not support a result, sinew.InputError for faults of a table or
a setting, and TypeError for arguments of the wrong type. docs/how-to/characterise.md and the pages of
docs/theory that it names explain the results and refusals.

The settings of a method are described only in the library, from which the last lines of a docstring are
taken; None, "" and () leave a setting at the library's default.
"""

import os
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, TypeVar, Union

import numpy.typing

from sinew import _sinew
from sinew._found import Checked, Found, Joint, Plan, Static, Valve, settings_text
from sinew._sinew import RefusalError
from sinew._tables import Path, Table, like, parts_of, tables_of

__all__ = [
    "Checked",
    "Found",
    "Joint",
    "Plan",
    "RefusalError",
    "Static",
    "Table",
    "Valve",
    "check",
    "columns",
    "creep",
    "dynamic",
    "force_beam",
    "geometry",
    "geometry_from_trapezoids",
    "joint",
    "pair",
    "plan",
    "run",
    "scale",
    "sensor",
    "static",
    "static_from",
    "template",
    "valve",
]

Quantity = Union[float, int, str]
Quantities = Union[Quantity, Sequence[Quantity]]
Texts = Union[str, Sequence[str]]
Freeze = Mapping[str, Quantity]
Prior = Mapping[str, Union[str, Sequence[Quantity]]]
Tie = Mapping[str, str]
Function = TypeVar("Function", bound=Callable[..., Any])


def _of(method: str) -> Callable[[Function], Function]:
    """Return a decorator that ends a docstring with a line for each setting of the method."""

    def described(function: Function) -> Function:
        function.__doc__ = settings_text(function.__doc__ or "", _sinew.identify_settings(method))
        return function

    return described


def _text(value: Any) -> str:
    """Return text unchanged, a number as text in SI, a pair joined by ±."""
    if isinstance(value, str):
        return value
    return "±".join(map(_text, value)) if isinstance(value, Sequence) else f"{float(value)!r} SI"


def _held_out(method: str, data: Any, given: Any) -> "List[Union[str, Dict[str, Any]]]":
    """Return the held-out data: texts, which are rules or files, and tables in the library's form."""
    units = _sinew.identify_columns(method)
    every = given if isinstance(given, (list, tuple)) else [] if given is None or given == "" else [given]
    return [
        os.fspath(one)
        if isinstance(one, (str, os.PathLike))
        else parts_of(like(data, one), units, "held out arrays of Python")
        for one in every
    ]


def _found(method: str, given: Dict[str, Any]) -> _sinew.Identified:
    """Return the result of a method; `given` are the arguments of its function, by name."""
    settings = {name: value for name, value in given.items() if name != "data"}
    data = given.get("data")
    if data is not None and "hold_out" in settings:
        settings["hold_out"] = _held_out(method, data, settings["hold_out"])
    for name, value in settings.items():
        if isinstance(value, Mapping):
            settings[name] = [f"{key}={_text(one)}" for key, one in value.items()]
    return _sinew.identify_tables(method, [] if data is None else tables_of(method, data), settings)


# --- a muscle at rest -------------------------------------------------------------------------------


def static(
    length: numpy.typing.ArrayLike, pressure: numpy.typing.ArrayLike, force: numpy.typing.ArrayLike, *,
    rest_length: Optional[numpy.typing.ArrayLike] = None, fitted: numpy.typing.ArrayLike = True, model: str = "",
    hold_out: str = "", name: str = "bpa", source: str = "arrays of Python", diameter: Optional[float] = None,
    anyway: bool = False,
) -> Static:  # fmt: skip
    """Return the static law of an actuator from forces [N] at lengths [m] and gauge pressures [Pa].

    Arguments are arrays with a number for each point, or one number for all. rest_length [m]: of the muscle
    without pressure and load (None: the longest length; an array assigns the points to several muscles).
    fitted: False for points that are held out and only scored; hold_out holds out every second "pressure",
    or each "length" in turn. model: only this law; empty: chosen by the data. source: origin of the data,
    for the file. diameter [m]: of the air without pressure; gives its volume, and the force is compared with
    it. The points are checked first like in check(): a red check is refused, unless anyway is set; it is
    then reported as a warning, as suspicions are.

    Raises RefusalError if the data do not support a law or a check is red, and ValueError for arrays of
    different shapes or an unknown model.
    """
    report, files = _sinew.identify_static(
        length, pressure, force, rest_length, fitted, model, hold_out, name, source, diameter, anyway
    )
    return Static(report, tuple(files))


@_of("static")
def static_from(
    data: Any, *, rest_length: Optional[Quantity] = None, actuator: Optional[Path] = None,
    branch: Optional[str] = None, fit_where: Texts = (), hold_out: Any = "", model: str = "",
    name: Optional[str] = None, diameter: Optional[Quantity] = None, volume: Optional[Quantity] = None,
    anyway: bool = False, predict: Quantities = (),
) -> Static:  # fmt: skip
    """Return the static law of an actuator from tables, or recordings with a column of time.

    Columns: force [N] or load [kg], pressure [Pa gauge], length [m], or contraction [1] with rest_length;
    optionally branch and time. data: a table, or several; the value of a missing column is given with
    sinew.identify.Table("rig.csv", values={"length": "205 mm"}). The files of the muscles in `predict` follow
    those of the measured muscles.
    """
    found = _found("static", locals())
    return Static(found.report, tuple(found.text(i, "") for i in range(found.files)))


@_of("check")
def check(
    data: Any, *, rest_length: Optional[Quantity] = None, actuator: Optional[Path] = None,
    branch: Optional[str] = None, fit_where: Texts = (), hold_out: Any = "",
    diameter: Optional[Quantity] = None,
) -> Checked:  # fmt: skip
    """Return checks of tables before static_from(): their contents, faults, and the parameters they determine.

    Tables that cannot be read are reported as a red check.
    """
    return Checked(_found("check", locals()).report)


@_of("scale")
def scale(
    file: Path, rest_length: Quantity, *, reading: Union[str, Sequence[float]] = "", actuator: str = "",
    name: str = "", atmosphere: Optional[str] = None,
) -> Found:  # fmt: skip
    """Return the actuator of a muscle that was not measured, from the file of one of the same make.

    A reading may also be (length [m], pressure [Pa gauge], force [N]). The report has the largest force and
    the ranges in which 68 and 95 % of forces are expected; None if no muscle was left out for the file.
    """
    given = dict(locals())
    if not isinstance(reading, str):
        length, pressure, force = (float(one) for one in reading)
        given["reading"] = f"{length!r} m, {pressure!r} Pa gauge, {force!r} N"
    return Found(_found("scale", given))


def columns(method: str) -> Dict[str, Any]:
    """Return the columns that a method of `sinew identify` reads, like `sinew identify columns --json`.

    method: "static", "dynamic", ... Each column has its quantity, accepted units, meaning, and whether it is
    required; each kind of table has the meaning of a row. Raises sinew.InputError for an unknown method.
    """
    return dict(_sinew.identify_inputs(method))


def template(method: str, kind: str = "") -> str:
    """Return a table to fill in, like `sinew identify columns --template`: CSV that the method can read.

    kind: kind of table if the method has several, "chart"; empty: the usual one.
    """
    return str(_sinew.identify_template(method, kind))


@_of("plan")
def plan(
    data: Any = None, *, rest_length: Optional[Quantity] = None, diameter: Optional[Quantity] = None,
    actuator: Optional[Path] = None, pressure: Optional[Quantity] = None, noise: Optional[Quantity] = None,
    length_error: Optional[Quantity] = None, law_error: Optional[Quantity] = None,
    error: Optional[Quantity] = None, mount_time: Optional[Quantity] = None,
    step_time: Optional[Quantity] = None, shortest: Optional[Quantity] = None,
    longest: Optional[Quantity] = None, lowest: Optional[Quantity] = None, criterion: Optional[str] = None,
    most: Optional[int] = None, branch: Optional[str] = None,
) -> Plan:  # fmt: skip
    """Return the lengths and pressures to measure for a static law of the required accuracy.

    Without data, for a muscle that was not measured: give its rest_length and diameter, or the file of a
    similar actuator, and the highest pressure. With data like those of static_from(): returns what to
    measure next and the expected gain.
    """
    found = _found("plan", locals())
    return Plan(found.report, found.text(0, ""))


# --- dynamic measurements, and runs -------------------------------------------------------------------


@_of("creep")
def creep(data: Any) -> Found:
    """Return shares and time constants of creep from a force that keeps growing at one length.

    Columns: time [s], force [N], pressure [Pa gauge]. The result is report["creep"], for the table [creep]
    of an actuator's file; no file is made.
    """
    return Found(_found("creep", locals()))


@_of("dynamic")
def dynamic(
    data: Any, *, actuator: Path, mass: Quantities, pressure: Optional[Quantities] = None,
    external_volume: Optional[Quantities] = None, exponent: Optional[Quantity] = None,
    count: Optional[int] = None, hold_out: Any = (), freeze: Optional[Freeze] = None,
    prior: Optional[Prior] = None, tie: Optional[Tie] = None, model: str = "", name: str = "",
) -> Found:  # fmt: skip
    """Return viscous loss and dry friction of an actuator from a mass that swings on trapped air.

    data: a table for each swing, with columns time [s], length [m], and optionally pressure [Pa abs].
    Settings that differ between tables may be lists. freeze, prior, tie: see pair().
    """
    return Found(_found("dynamic", locals()))


@_of("joint")
def joint(
    data: Any, *, actuator: Path, load: Optional[Quantity] = None, lever: Optional[Quantity] = None,
    down: Optional[Quantity] = None, limb: Optional[Quantity] = None, limb_lever: Optional[Quantity] = None,
    rest_angle: Optional[Quantity] = None, moment_arm: Optional[Quantity] = None,
    flexor_length: Optional[Quantity] = None, extensor_length: Optional[Quantity] = None,
    keep_force: bool = False, torque_bias: bool = False, torque_gain: bool = False, moving: bool = False,
    count: Optional[int] = None, flexion: Optional[str] = None, hold_out: Any = None,
    freeze: Optional[Freeze] = None, prior: Optional[Prior] = None, tie: Optional[Tie] = None,
    model: str = "", name: str = "", joint_name: Optional[str] = None, flexor: str = "", extensor: str = "",
    base: Optional[Path] = None,
) -> Joint:  # fmt: skip
    """Return force law and moment arm of a joint's muscles from its angle, pressures and a known load.

    Columns: angle [rad], flexor_pressure or extensor_pressure [Pa abs], and optionally torque [N m] or
    load [kg]. data: a table, or several recordings. freeze, prior, tie: see pair().
    """
    return Joint(_found("joint", locals()))


@_of("pair")
def pair(
    data: Any, *, rigs: Texts = "", hold_out: Any = (), window: Optional[Quantity] = None,
    freeze: Optional[Freeze] = None, prior: Optional[Prior] = None, tie: Optional[Tie] = None,
    model: str = "", joint_name: Optional[str] = None, base: Optional[Path] = None,
) -> Found:  # fmt: skip
    """Return stiffness, friction, losses and trapped air of a sealed pair that is moved by hand or motor.

    data: a table for each recording, with columns time [s], force [N] and displacement [m], or torque [N m]
    and angle [rad], and optionally pressure_1, pressure_2 [Pa abs]. freeze: {name: value} of known
    parameters; prior: {name: (value, standard deviation)}; tie: {name: other name}; numbers are in SI.
    """
    return Found(_found("pair", locals()))


@_of("run")
def run(
    run: Path, *, fit: Texts = (), machine: Optional[Path] = None, sets: Texts = (), priors: Texts = (),
    freeze: Texts = (), hold_out: Optional[Quantity] = None, begin: Optional[Quantity] = None,
    score: Optional[Path] = None, threads: Optional[int] = None, base: Optional[Path] = None,
) -> Found:  # fmt: skip
    """Return friction, damping, dead times, volumes and leaks of a robot from one of its runs.

    score: another run, with which the identified machine is compared, see Found.score.

    The result is the same with any number of threads. A walking leg has no intervals: "intervals" in the
    report is False, "no_intervals_because" gives the reason, and "low" and "high" are None.
    """
    return Found(_found("run", locals()))


# --- single parts -------------------------------------------------------------------------------------


def geometry(data: Any, *, thread_thickness: Optional[Quantity] = None, name: Optional[str] = None) -> Found:
    """Return thread length and turns of a braid from columns length and diameter [m].

    thread_thickness [m] is subtracted from diameters that were measured over the threads.
    """
    return Found(_found("geometry", locals()))


def geometry_from_trapezoids(
    lengthwise: Union[float, int], around: Union[float, int], side: Quantity, *, name: Optional[str] = None
) -> Found:
    """Return thread length and turns of a braid from trapezoids counted on the opened mesh.

    lengthwise and around: numbers of trapezoids; side [m]: of one, between two threads. The report has no models.
    """
    return Found(_found("geometry", {"trapezoids": f"{lengthwise},{around}", "side": side, "name": name}))


@_of("sensor")
def sensor(
    data: Any, *, known: str = "", sensors: Texts = (), rest: Optional[Quantity] = None,
    bits: Optional[int] = None, full_scale: Optional[Quantity] = None, hold_out: Any = None,
    average: bool = False, base: Optional[Path] = None,
) -> Found:  # fmt: skip
    """Return scale, offset, linearity, hysteresis and noise of calibrated sensors.

    Columns: the applied quantity and the output of each sensor in volts or counts, with their units:
    {"load [kg]": ..., "gage [V]": ...}. A number for rest is in SI.
    """
    return Found(_found("sensor", locals()))


@_of("valve")
def valve(
    data: Any, *, kind: str = "", volume: Optional[Quantity] = None, conductance: Optional[Quantity] = None,
    per_volume: bool = False, added_volume: Optional[Quantities] = None, port: Optional[Quantity] = None,
    exponent: Optional[Quantity] = None, temperature: Optional[Quantity] = None,
    frequency: Optional[Quantity] = None, hold_out: Any = None, name: Optional[str] = None,
    base: Optional[Path] = None,
) -> Valve:  # fmt: skip
    """Return flow and delays of a valve from a chart, a filling, pulses, a coil's current or duties.

    Columns by kind: "chart" has upstream, downstream [Pa abs] and flow [m3/s] or mass_flow [kg/s]; "fill"
    time [s] and pressure [Pa abs]; "pulses" also command [1]; "coil" time and current [A]; "duty" duty [1],
    delivered [1] or flow, and frequency [Hz]. For "fill" and "pulses" give the chamber's volume or the
    valve's conductance, or set per_volume if their ratio is enough; or give fillings with known volumes added
    to the chamber, a table for each, with added_volume given here or in a column of that name.
    """
    return Valve(_found("valve", locals()))


@_of("force-beam")
def force_beam(
    *, length: Optional[Quantity] = None, width: Optional[Quantity] = None, height: Optional[Quantity] = None,
    gages: Optional[Quantity] = None, modulus: Optional[Quantity] = None, poisson: Optional[float] = None,
    yield_stress: Optional[Quantity] = None, concentration: Optional[float] = None, bridge: str = "poisson",
    gage_factor: Optional[float] = None, excitation: Optional[Quantity] = None, gain: Optional[float] = None,
    full_scale: Optional[Quantity] = None, bits: Optional[int] = None, load: Optional[Quantity] = None,
    sensitivity: Optional[Quantity] = None,
) -> Dict[str, Any]:  # fmt: skip
    """Return strain, safety and output of a beam with strain gages, like `sinew force-beam --json`.

    None: the thesis's value.
    """
    return dict(_sinew.force_beam(dict(locals())))
