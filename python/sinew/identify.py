"""Parameters from measurements.

    import sinew.identify as identify

    found = identify.static(length, pressure, force, rest_length=0.25)
    found.model, found.report["parameters"], found.report["cross_validated"]
    found.write("my-actuator.toml")
    sinew.Actuator("my-actuator.toml").tension(0.22, 3e5)

    print(identify.check("forces.csv", rest_length="102 mm", diameter="10 mm"))

    identify.valve("fill.csv", volume="0.5 L").write("my-valve.toml")
    identify.valve({"time": t, "pressure": p}, volume=5e-4)

Each method of `sinew identify` is a function: the same report, the same file. It takes measurements as
one table, or several where it says so: a CSV file's path; a dict, pandas frame or structured array of
columns; or a Table, which says what foreign columns mean. Settings are as the program's: a number in the
SI unit that is told here, or text with a unit, "6 lb".

Functions raise RefusalError where the data support no answer, sinew.InputError for what is wrong with a
table or a setting, and TypeError for what is none. What the numbers mean, and what is refused:
docs/how-to-characterise.md and the pages of docs/theory that it names.
"""

import os
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

import numpy.typing

from sinew import _sinew
from sinew._sinew import RefusalError
from sinew._found import Checked, Found, Joint, Plan, Static, Valve
from sinew._tables import Table, held_out_of, like, tables_of

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

_Path = Union[str, "os.PathLike[str]"]
_Quantity = Union[float, int, str]
_Quantities = Union[_Quantity, Sequence[_Quantity]]
_Prior = Union[str, Sequence[_Quantity]]


def _with_unit(value: Any) -> str:
    """Return text as it is, and a number as one in the SI unit of whatever it is of."""
    return value if isinstance(value, str) else f"{float(value)!r} SI"


def _in_meters(value: Any) -> str:
    """Return text as it is, and a number as a length."""
    return value if isinstance(value, str) else f"{float(value)!r} m"


def _wishes(
    freeze: Optional[Mapping[str, _Quantity]],
    prior: Optional[Mapping[str, _Prior]],
    tie: Optional[Mapping[str, str]],
) -> "Dict[str, List[str]]":
    """Return what is known of parameters, as the program's options have it."""

    def belief(of: _Prior) -> str:
        return of if isinstance(of, str) else "±".join(_with_unit(one) for one in of)

    return {
        "freeze": [f"{name}={_with_unit(value)}" for name, value in (freeze or {}).items()],
        "prior": [f"{name}={belief(of)}" for name, of in (prior or {}).items()],
        "tie": [f"{name}={other}" for name, other in (tie or {}).items()],
    }


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
    rest_length: Optional[_Quantity] = None,
    lengths: Union[str, Sequence[str]] = (),
    actuator: Optional[_Path] = None,
    branch: str = "both",
    fit_where: Union[str, Sequence[str]] = (),
    hold_out: Any = "",
    model: str = "",
    name: str = "bpa",
    diameter: Optional[_Quantity] = None,
    anyway: bool = False,
    predict: Union[_Quantity, Sequence[_Quantity]] = (),
) -> Static:
    """Return the static law of an actuator from tables, or recordings with a column of time.

    Columns force [N] or load [kg], pressure [Pa gauge], length [m]; rest_length, branch, time where there
    are such. data: a table, or several. lengths: of files without that column, "205 mm", or "PART=205 mm"
    for those with PART in their name. actuator: a file whose braid is known. branch: "fill", "vent" or
    "both". fit_where: only rows with "NAME=VALUE,..." are fitted, the others held out. hold_out: "pressure"
    (every second), "length" or "muscle" (each once), or another table. diameter [m] without pressure, and
    anyway: as static() has them. predict: rest lengths [m] that nobody measured; their files follow those
    of the muscles that were.
    """
    unseen = [predict] if isinstance(predict, (str, float, int)) else predict
    settings = _static_settings(data, {**locals(), "predict": [_in_meters(one) for one in unseen]})
    del settings["unseen"]
    found = _sinew.identify_tables("static", tables_of("static", data), settings)
    return Static(found.report, tuple(found.text(i, "") for i in range(found.files)))


def run(
    run: _Path,
    *,
    fit: Union[str, Sequence[str]] = (),
    machine: Optional[_Path] = None,
    sets: Union[str, Sequence[str]] = (),
    priors: Union[str, Sequence[str]] = (),
    freeze: Union[str, Sequence[str]] = (),
    hold_out: str = "20 %",
    begin: _Quantity = 0.0,
    threads: int = 0,
    base: Optional[_Path] = None,
) -> Found:
    """Return friction, damping, dead times, volumes and leaks of a robot from a run of it.

    run: its folder or log; an imported recording's too. fit: keys, and groups of them: "friction",
    "damping", "dead-time", "volume", "leak"; else all groups. machine: what was run, in place of the
    folder's. sets: "KEY=VALUE", where the search begins or what is known; priors: "KEY=VALUE +- DEVIATION".
    freeze: "KEY=VALUE", what is known and not fitted. hold_out: share of the run, at its end, that scores and
    is not fitted; begin [s]: what is before is not compared. threads: simulations at once, 0: one for each
    processor; the result is the same. base: the robot's file that the written one adds to.

    A leg that walks has no intervals: "intervals" of the report is False, "no_intervals_because" says why, and
    "low" and "high" are None.
    """
    settings = {
        "run": run,
        "fit": fit,
        "machine": machine,
        "sets": sets,
        "priors": priors,
        "freeze": freeze,
        "hold_out": hold_out,
        "from": begin,
        "threads": threads,
        "base": base,
    }
    return Found(_sinew.identify_tables("run", [], settings))


def scale(
    file: _Path,
    rest_length: _Quantity,
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
    rest_length: Optional[_Quantity] = None,
    lengths: Union[str, Sequence[str]] = (),
    actuator: Optional[_Path] = None,
    branch: str = "both",
    fit_where: Union[str, Sequence[str]] = (),
    hold_out: Any = "",
    diameter: Optional[_Quantity] = None,
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
    rest_length: Optional[_Quantity] = None,
    diameter: Optional[_Quantity] = None,
    actuator: Optional[_Path] = None,
    pressure: Optional[_Quantity] = None,
    noise: Optional[_Quantity] = None,
    length_error: _Quantity = 1e-4,
    law_error: _Quantity = 0.01,
    error: _Quantity = 0.02,
    mount_time: _Quantity = 600.0,
    step_time: _Quantity = 30.0,
    shortest: Optional[_Quantity] = None,
    longest: Optional[_Quantity] = None,
    lowest: Optional[_Quantity] = None,
    criterion: str = "mean",
    most: int = 12,
    lengths: Union[str, Sequence[str]] = (),
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
        "lengths": lengths,
        "branch": branch,
    }
    report, table = _sinew.identify_plan([] if data is None else tables_of("static", data), settings)
    return Plan(report, table)


def geometry(data: Any, *, thread_thickness: _Quantity = 0.0, name: str = "bpa") -> Found:
    """Return thread length and turns of a braid from columns length and diameter [m].

    thread_thickness [m] is taken off diameters that were measured outside the threads.
    """
    settings = {"thread_thickness": thread_thickness, "name": name}
    return Found(_sinew.identify_tables("geometry", tables_of("geometry", data), settings))


def geometry_from_trapezoids(
    lengthwise: Union[float, int], around: Union[float, int], side: _Quantity, *, name: str = "bpa"
) -> Found:
    """Return thread length and turns of a braid from trapezoids counted on the opened mesh.

    lengthwise and around: how many; side [m] of one between two threads. The report has no models.
    """
    settings = {"trapezoids": f"{lengthwise},{around}", "side": side, "name": name}
    return Found(_sinew.identify_tables("geometry", [], settings))


def creep(data: Any) -> Found:
    """Return shares and times of creep from force that goes on growing at one length.

    Columns time [s], force [N], pressure [Pa gauge]. What was found is in report["creep"]; there is no
    file: it belongs into an actuator's [creep].
    """
    return Found(_sinew.identify_tables("creep", tables_of("creep", data), {}))


def dynamic(
    data: Any,
    *,
    actuator: _Path,
    mass: _Quantities,
    pressure: Optional[_Quantities] = None,
    external_volume: _Quantities = 0.0,
    exponent: Optional[_Quantity] = None,
    count: int = 1,
    hold_out: Any = (),
    freeze: Optional[Mapping[str, _Quantity]] = None,
    prior: Optional[Mapping[str, _Prior]] = None,
    tie: Optional[Mapping[str, str]] = None,
    model: str = "",
    name: str = "",
) -> Found:
    """Return viscous loss and dry friction of an actuator from a mass that swings on trapped air.

    data: a table for each swing, with columns time [s], length [m], and pressure [Pa abs] where it was
    measured. actuator: file with braid, tension and ends, a start; name: which one in it. mass [kg] that
    moves, pressure [Pa abs] of the air as it hangs (None: the measured one) and external_volume [m3] of
    hose and fittings up to the shut valve: one, or one for each table. exponent of the trapped air (None:
    from the pressure, else 1.4). count: actuators in parallel. hold_out: tables that score the laws and
    are not fitted; else each table in turn, or the last third of the only one. freeze, prior, tie: of
    parameters, as pair() has them. model: that law alone.
    """
    others = [like(data, one) for one in (hold_out if isinstance(hold_out, (list, tuple)) else [hold_out])]
    settings = {
        "actuator": actuator,
        "name": name,
        "mass": mass,
        "pressure": pressure,
        "external_volume": external_volume,
        "exponent": exponent,
        "count": count,
        "held_out": tables_of("dynamic", others, "held out arrays of Python"),
        **_wishes(freeze, prior, tie),
        "model": model,
    }
    return Found(_sinew.identify_tables("dynamic", tables_of("dynamic", data), settings))


def joint(
    data: Any,
    *,
    actuator: _Path,
    load: Optional[_Quantity] = None,
    lever: _Quantity = 0.0,
    down: _Quantity = "270 deg",
    limb: _Quantity = 0.0,
    limb_lever: _Quantity = 0.0,
    rest_angle: _Quantity = 0.0,
    moment_arm: Optional[_Quantity] = None,
    flexor_length: Optional[_Quantity] = None,
    extensor_length: Optional[_Quantity] = None,
    keep_force: bool = False,
    torque_bias: bool = False,
    torque_gain: bool = False,
    moving: bool = False,
    count: int = 1,
    flexion: str = "raises angle",
    hold_out: Any = None,
    freeze: Optional[Mapping[str, _Quantity]] = None,
    prior: Optional[Mapping[str, _Prior]] = None,
    tie: Optional[Mapping[str, str]] = None,
    model: str = "",
    name: str = "",
    joint_name: str = "joint",
    flexor: str = "",
    extensor: str = "",
    base: Optional[_Path] = None,
) -> Joint:
    """Return force law and moment arm of a joint's muscles from its angle, pressures and a known load.

    Columns angle [rad], flexor_pressure or extensor_pressure [Pa abs], and torque [N m] or load [kg]
    where there is one. actuator: file with the braid, a start; name: which one in it; count: actuators in
    parallel. load [kg] at the lever [m], which points straight down at the angle down [rad]; limb [kg] at
    limb_lever [m]. moment_arm, flexor_length, extensor_length [m] at rest_angle [rad], where they are
    known; keep_force: the actuator's effectiveness is right. data: a table, or several recordings;
    torque_bias: the torque of each has a zero of its own; torque_gain: and a gain; moving: the joint moves
    over time [s], and friction, damping and the torque's delay are found as well. flexion: what a shorter flexor does, "raises
    angle" or "lowers angle". hold_out: a table that scores the models; else every third row. freeze,
    prior, tie: of parameters, as pair() has them. joint_name, flexor, extensor: in the robot's file; base:
    that file, which the written one adds to.
    """
    settings: Dict[str, Any] = {
        "actuator": actuator,
        "name": name,
        "count": count,
        "joint": joint_name,
        "flexor": flexor,
        "extensor": extensor,
        "flexion": flexion,
        "rest_angle": rest_angle,
        "load": load,
        "lever": lever,
        "down": down,
        "limb": limb,
        "limb_lever": limb_lever,
        "moment_arm": moment_arm,
        "flexor_length": flexor_length,
        "extensor_length": extensor_length,
        "keep_force": keep_force,
        "torque_bias": torque_bias,
        "torque_gain": torque_gain,
        "moving": moving,
        "held_out": held_out_of("joint", data, hold_out),
        **_wishes(freeze, prior, tie),
        "model": model,
        "base": base,
    }
    return Joint(_sinew.identify_tables("joint", tables_of("joint", data), settings))


def pair(
    data: Any,
    *,
    rigs: Union[str, Sequence[str]] = "",
    hold_out: Any = (),
    window: _Quantity = 0.02,
    freeze: Optional[Mapping[str, _Quantity]] = None,
    prior: Optional[Mapping[str, _Prior]] = None,
    tie: Optional[Mapping[str, str]] = None,
    model: str = "",
    joint_name: str = "joint",
    base: Optional[_Path] = None,
) -> Found:
    """Return stiffness, friction, losses and trapped air of a sealed pair that is moved by hand or motor.

    data: a table for each recording, with columns time [s], force [N] and displacement [m], or torque [N m]
    and angle [rad], and pressure_1, pressure_2 [Pa abs] where they were measured. rigs: of each table;
    recordings of one have delay and gain in common. hold_out: times that score the laws and are not
    fitted, "7 s..14 s" or "7 s..", or tables. window [s] of the parabolas that give rates. freeze: {name:
    value} of parameters that are known; prior: {name: (value, standard deviation)}; tie: {name: other
    name}; numbers in SI. model: that law alone. joint_name: in the robot's file; base: that file, which the
    written one adds to.
    """
    times = hold_out if isinstance(hold_out, str) and ".." in hold_out else ""
    tables = [] if times else hold_out if isinstance(hold_out, (list, tuple)) else [hold_out]
    settings = {
        "rigs": rigs if isinstance(rigs, str) else ",".join(rigs),
        "hold_out": times,
        "held_out": tables_of("pair", [like(data, one) for one in tables], "held out arrays of Python"),
        "window": window,
        **_wishes(freeze, prior, tie),
        "model": model,
        "joint": joint_name,
        "base": base,
    }
    return Found(_sinew.identify_tables("pair", tables_of("pair", data), settings))


def sensor(
    data: Any,
    *,
    known: str = "",
    sensors: Union[str, Sequence[str]] = (),
    rest: Optional[_Quantity] = None,
    bits: int = 12,
    full_scale: _Quantity = 5.0,
    hold_out: Any = None,
    average: bool = False,
    base: Optional[_Path] = None,
) -> Found:
    """Return scale, offset, linearity, hysteresis and noise of calibrated sensors.

    Columns: what was set, and what each sensor made of it, with their units: {"load [kg]": ..., "gage [V]":
    ...}; volts, or counts. known: the column that was set, where there are several. sensors: columns to
    calibrate; else all. rest: the known value at rest, in SI. bits and full_scale [V] of the converter.
    hold_out: another calibration; else each known value is predicted from the others. average: the
    controller believes in one scale for all of them. base: the robot's file whose sensors these are.
    """
    settings = {
        "known": known,
        "sensors": sensors,
        "rest": rest,
        "bits": bits,
        "full_scale": full_scale,
        "held_out": held_out_of("sensor", data, hold_out),
        "average": average,
        "base": base,
    }
    return Found(_sinew.identify_tables("sensor", tables_of("sensor", data), settings))


def valve(
    data: Any,
    *,
    kind: str = "",
    volume: Optional[_Quantity] = None,
    conductance: Optional[_Quantity] = None,
    per_volume: bool = False,
    added_volume: Optional[_Quantities] = None,
    port: Optional[_Quantity] = None,
    exponent: Optional[_Quantity] = None,
    temperature: _Quantity = "20 degC",
    frequency: Optional[_Quantity] = None,
    hold_out: Any = None,
    name: str = "valve",
    base: Optional[_Path] = None,
) -> Valve:
    """Return flow and delays of a valve from a chart, a filling, pulses, a coil's current or duties.

    kind, by its columns where it is empty: "chart" has upstream, downstream [Pa abs] and flow [m3/s] or
    mass_flow [kg/s]; "fill" time [s] and pressure [Pa abs]; "pulses" command [1] beside; "coil" time and
    current [A]; "duty" duty [1], delivered [1] or flow, and frequency [Hz]. Of a filling or pulses: the
    chamber's volume [m3], or the valve's conductance [m3/(s Pa)], or per_volume where their ratio is
    enough; or fillings with known volumes joined to the chamber, a table for each, whose added_volume [m3]
    is told here or in a column of that name: then both come out. port: pressure on the valve's other side
    [Pa abs], fitted without; exponent of the chamber, tried without. temperature [K] of the air. frequency
    [Hz] of the pulses of a map of duties. hold_out: a table that scores the model of a filling. name: of
    the valve; base: a valves file with it, whose values stay where none was found.
    """
    settings = {
        "name": name,
        "base": base,
        "kind": kind,
        "volume": volume,
        "conductance": conductance,
        "per_volume": per_volume,
        "added_volume": added_volume,
        "port": port,
        "exponent": exponent,
        "temperature": temperature,
        "frequency": frequency,
        "held_out": held_out_of("valve", data, hold_out),
    }
    return Valve(_sinew.identify_tables("valve", tables_of("valve", data), settings))


def force_beam(
    *,
    length: Optional[_Quantity] = None,
    width: Optional[_Quantity] = None,
    height: Optional[_Quantity] = None,
    gages: Optional[_Quantity] = None,
    modulus: Optional[_Quantity] = None,
    poisson: Optional[float] = None,
    yield_stress: Optional[_Quantity] = None,
    concentration: Optional[float] = None,
    bridge: str = "poisson",
    gage_factor: Optional[float] = None,
    excitation: Optional[_Quantity] = None,
    gain: Optional[float] = None,
    full_scale: Optional[_Quantity] = None,
    bits: Optional[int] = None,
    load: Optional[_Quantity] = None,
    sensitivity: Optional[_Quantity] = None,
) -> Dict[str, Any]:
    """Return strain, safety and output of a beam with strain gages, as `sinew force-beam --json` prints.

    length [m] from the load to the mount, width, height [m], gages [m]: from the load to their middle;
    modulus and yield_stress [Pa], concentration of stress at the mount; bridge: "quarter", "half", "poisson"
    or "bending"; excitation and full_scale [V]; load [N]; sensitivity [V/N] that is wanted tells where the
    gages must be. None: the thesis's.
    """
    return dict(_sinew.force_beam(dict(locals())))
