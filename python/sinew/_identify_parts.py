"""Parts one by one: a braid that is counted, valves, sensors, a beam that reads force."""

from typing import Any, Dict, Optional, Sequence, Union

from sinew import _sinew
from sinew._found import Found, Valve
from sinew._identify_settings import Path, Quantities, Quantity
from sinew._tables import held_out_of, tables_of


def geometry(data: Any, *, thread_thickness: Quantity = 0.0, name: str = "bpa") -> Found:
    """Return thread length and turns of a braid from columns length and diameter [m].

    thread_thickness [m] is taken off diameters that were measured outside the threads.
    """
    settings = {"thread_thickness": thread_thickness, "name": name}
    return Found(_sinew.identify_tables("geometry", tables_of("geometry", data), settings))


def geometry_from_trapezoids(
    lengthwise: Union[float, int], around: Union[float, int], side: Quantity, *, name: str = "bpa"
) -> Found:
    """Return thread length and turns of a braid from trapezoids counted on the opened mesh.

    lengthwise and around: how many; side [m] of one between two threads. The report has no models.
    """
    settings = {"trapezoids": f"{lengthwise},{around}", "side": side, "name": name}
    return Found(_sinew.identify_tables("geometry", [], settings))


def sensor(
    data: Any,
    *,
    known: str = "",
    sensors: Union[str, Sequence[str]] = (),
    rest: Optional[Quantity] = None,
    bits: int = 12,
    full_scale: Quantity = 5.0,
    hold_out: Any = None,
    average: bool = False,
    base: Optional[Path] = None,
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
    volume: Optional[Quantity] = None,
    conductance: Optional[Quantity] = None,
    per_volume: bool = False,
    added_volume: Optional[Quantities] = None,
    port: Optional[Quantity] = None,
    exponent: Optional[Quantity] = None,
    temperature: Quantity = "20 degC",
    frequency: Optional[Quantity] = None,
    hold_out: Any = None,
    name: str = "valve",
    base: Optional[Path] = None,
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
    length: Optional[Quantity] = None,
    width: Optional[Quantity] = None,
    height: Optional[Quantity] = None,
    gages: Optional[Quantity] = None,
    modulus: Optional[Quantity] = None,
    poisson: Optional[float] = None,
    yield_stress: Optional[Quantity] = None,
    concentration: Optional[float] = None,
    bridge: str = "poisson",
    gage_factor: Optional[float] = None,
    excitation: Optional[Quantity] = None,
    gain: Optional[float] = None,
    full_scale: Optional[Quantity] = None,
    bits: Optional[int] = None,
    load: Optional[Quantity] = None,
    sensitivity: Optional[Quantity] = None,
) -> Dict[str, Any]:
    """Return strain, safety and output of a beam with strain gages, as `sinew force-beam --json` prints.

    length [m] from the load to the mount, width, height [m], gages [m]: from the load to their middle;
    modulus and yield_stress [Pa], concentration of stress at the mount; bridge: "quarter", "half", "poisson"
    or "bending"; excitation and full_scale [V]; load [N]; sensitivity [V/N] that is wanted tells where the
    gages must be. None: the thesis's.
    """
    return dict(_sinew.force_beam(dict(locals())))
