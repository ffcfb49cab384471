"""Measurements that move: creep, losses, joints, sealed pairs, and runs of a whole machine."""

from typing import Any, Dict, Mapping, Optional, Sequence, Union

from sinew import _sinew
from sinew._found import Found, Joint
from sinew._identify_settings import Path, Prior, Quantities, Quantity, wishes
from sinew._tables import held_out_of, like, tables_of


def creep(data: Any) -> Found:
    """Return shares and times of creep from force that goes on growing at one length.

    Columns time [s], force [N], pressure [Pa gauge]. What was found is in report["creep"]; there is no
    file: it belongs into an actuator's [creep].
    """
    return Found(_sinew.identify_tables("creep", tables_of("creep", data), {}))


def dynamic(
    data: Any,
    *,
    actuator: Path,
    mass: Quantities,
    pressure: Optional[Quantities] = None,
    external_volume: Quantities = 0.0,
    exponent: Optional[Quantity] = None,
    count: int = 1,
    hold_out: Any = (),
    freeze: Optional[Mapping[str, Quantity]] = None,
    prior: Optional[Mapping[str, Prior]] = None,
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
        **wishes(freeze, prior, tie),
        "model": model,
    }
    return Found(_sinew.identify_tables("dynamic", tables_of("dynamic", data), settings))


def joint(
    data: Any,
    *,
    actuator: Path,
    load: Optional[Quantity] = None,
    lever: Quantity = 0.0,
    down: Quantity = "270 deg",
    limb: Quantity = 0.0,
    limb_lever: Quantity = 0.0,
    rest_angle: Quantity = 0.0,
    moment_arm: Optional[Quantity] = None,
    flexor_length: Optional[Quantity] = None,
    extensor_length: Optional[Quantity] = None,
    keep_force: bool = False,
    torque_bias: bool = False,
    torque_gain: bool = False,
    moving: bool = False,
    count: int = 1,
    flexion: str = "raises angle",
    hold_out: Any = None,
    freeze: Optional[Mapping[str, Quantity]] = None,
    prior: Optional[Mapping[str, Prior]] = None,
    tie: Optional[Mapping[str, str]] = None,
    model: str = "",
    name: str = "",
    joint_name: str = "joint",
    flexor: str = "",
    extensor: str = "",
    base: Optional[Path] = None,
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
        **wishes(freeze, prior, tie),
        "model": model,
        "base": base,
    }
    return Joint(_sinew.identify_tables("joint", tables_of("joint", data), settings))


def pair(
    data: Any,
    *,
    rigs: Union[str, Sequence[str]] = "",
    hold_out: Any = (),
    window: Quantity = 0.02,
    freeze: Optional[Mapping[str, Quantity]] = None,
    prior: Optional[Mapping[str, Prior]] = None,
    tie: Optional[Mapping[str, str]] = None,
    model: str = "",
    joint_name: str = "joint",
    base: Optional[Path] = None,
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
        **wishes(freeze, prior, tie),
        "model": model,
        "joint": joint_name,
        "base": base,
    }
    return Found(_sinew.identify_tables("pair", tables_of("pair", data), settings))


def run(
    run: Path,
    *,
    fit: Union[str, Sequence[str]] = (),
    machine: Optional[Path] = None,
    sets: Union[str, Sequence[str]] = (),
    priors: Union[str, Sequence[str]] = (),
    freeze: Union[str, Sequence[str]] = (),
    hold_out: str = "20 %",
    begin: Quantity = 0.0,
    threads: int = 0,
    base: Optional[Path] = None,
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
