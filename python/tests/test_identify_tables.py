"""Every method of `sinew identify` from files and from columns: the program's report and file."""

import os
import tempfile
import unittest
from typing import Any, Dict, List, Sequence

import numpy

import sinew
from common import ACTUATOR, program, program_json
from sinew import identify

DOWN = 70 * numpy.pi / 180
ROBOT = sinew.shipped("robots/leg/robot.toml")
VALVES = sinew.shipped("robots/leg/valves.toml")


def mesh() -> "Dict[str, Any]":
    """Return lengths and diameters of a braid, rounded like a caliper's readings."""
    length = numpy.linspace(0.06, 0.09, 9)
    diameter = numpy.sqrt(0.1**2 - length**2) / numpy.pi
    return {"length": length, "diameter": numpy.round(diameter, 5)}


def hold() -> "Dict[str, Any]":
    """Return a hold at one length, during which the force keeps growing."""
    time = numpy.arange(0, 600.0, 5.0)
    force = 100 + 3 * (1 - numpy.exp(-time / 90)) + 0.01 * numpy.sin(7 * time)
    return {"time": time, "force": force, "pressure": 4e5}


def swings() -> "List[Dict[str, Any]]":
    """Return free decays of two masses, measured by a potentiometer."""
    out = []
    for name in ("trapped-60-6", "trapped-80-11"):
        run = sinew.run(sinew.shipped(f"experiments/rig/{name}.toml"))
        time, length = run.time("/true/stand/length"), run["/true/stand/length"]
        some = (numpy.arange(time.size) % 5 == 0) & (time < 1.6)
        out.append({"time": time[some], "length": numpy.round(length[some], 5)})
    return out


def poses() -> "Dict[str, Any]":
    """Return poses of a knee that two actuators flex against weights on a lever."""
    i = numpy.arange(60)
    q, gauge = 0.45 * numpy.sin(2.4 * i), 150e3 + 400e3 * (i % 7) / 6.0
    length, braid = 0.083 - 0.03 * q, sinew.Robot(ACTUATOR).actuator.bpa.braid
    square = (3 * length**2 - braid.thread_length**2) / (4 * numpy.pi * braid.turns**2)
    tension = 0.9 * gauge * square
    angle = 310 * numpy.pi / 180 - q
    load = -2 * 0.03 * tension / (9.80665 * 0.15 * numpy.sin(angle - DOWN))
    return {
        "angle": angle,
        "flexor_pressure [kPa gauge]": 1e-3 * gauge,
        "load": load * (1 + 0.002 * numpy.sin(31.0 * i)),
    }


def moved_pairs() -> "List[Dict[str, Any]]":
    """Return a joint with two sealed muscles, moved by hand twice: a spring, dry friction, a zero."""
    out = []
    for phase, zero in ((0.0, 0.3), (1.0, -0.2)):
        time = numpy.arange(0, 4.0, 0.01)
        angle = 0.2 * numpy.sin(2 * time + phase) + 0.05 * numpy.sin(7 * time)
        share, held = numpy.zeros(time.size), 0.0
        for i in range(1, time.size):
            held = min(1.0, max(-1.0, held + (angle[i] - angle[i - 1]) / 0.01))
            share[i] = held
        torque = 12 * angle + 0.8 * share + zero + 0.01 * numpy.sin(977 * time)
        out.append({"time": time, "torque": torque, "angle": angle, "pressure_1": 4e5 * numpy.exp(-0.3 * angle)})
    return out


def weights() -> "Dict[str, Any]":
    """Return a calibration of a gage, up and down."""
    load = numpy.array([0.0, 2, 4, 6, 8, 10, 8, 6, 4, 2, 0])
    return {"load [kg]": load, "gage [V]": 0.5 + 0.35 * load + 0.002 * numpy.sin(5 * load)}


def chart() -> "Dict[str, Any]":
    """Return the flow through a valve of C = 3e-8 m3/(s Pa) and b = 0.3, from 7 bar."""
    down = numpy.array([1.0, 2, 3, 4, 5, 6, 6.5])
    x = numpy.maximum(0, (down / 7 - 0.3) / 0.7)
    flow = 60 * 3 * 7 * numpy.sqrt(1 - x * x)
    return {"upstream [bar abs]": 7.0, "downstream [bar abs]": down, "flow [L/min]": flow}


def filling() -> "Dict[str, Any]":
    """Return a chamber that fills from 7 bar, isothermal, C/V = 2 1/(s bar), b = 0.3."""
    step, p, seen = 5e-5, 1.013e5, []
    for i in range(20000):
        if i % 100 == 0:
            seen.append((step * i, p - 1.01325e5))
        x = max(0.0, (p / 7e5 - 0.3) / 0.7)
        if i > 2000:
            p += step * 287 * 293.15 * 2e-5 * 1.185 * 7e5 * max(0.0, 1 - x * x) ** 0.5
    table = numpy.array(seen)
    return {"time": table[:, 0], "pressure [Pa gauge]": table[:, 1]}


def duties() -> "Dict[str, Any]":
    """Return the delivery of a valve with 40 ms periods that opens 4 ms and shuts 1.2 ms late."""
    duty = numpy.arange(0, 1.0, 0.005)
    delivered = numpy.clip(duty - (4e-3 - 1.2e-3) / 0.04, 0, 1)
    return {"duty [1]": duty, "delivered [1]": delivered}


def written(folder: str, name: str, columns: "Dict[str, Any]", units: "Dict[str, str]") -> str:
    """Write columns as a CSV file, independently of the package."""
    names = list(columns)
    full = numpy.broadcast_arrays(*columns.values())
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        heads = [n if "[" in n else f"{n} [{units[n]}]" for n in names]
        file.write(",".join(heads) + "\n")
        for row in zip(*full):
            file.write(",".join(f"{float(one)!r}" for one in row) + "\n")
    return path


UNITS = {
    "length": "m",
    "diameter": "m",
    "time": "s",
    "force": "N",
    "pressure": "Pa gauge",
    "angle": "rad",
    "load": "kg",
    "torque": "N m",
    "pressure_1": "Pa abs",
}


class SameAsTheProgram(unittest.TestCase):
    """The report of files is the program's JSON, and the file its bytes; columns give the same values."""

    def setUp(self) -> None:
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = kept.name

    def compare(
        self,
        method: str,
        tables: "Sequence[Dict[str, Any]]",
        ask: Any,
        *options: str,
        file: str = "checked",
    ) -> Any:
        """Compare the program, Python with the files, and Python with the columns."""
        files = [
            written(self.folder, f"{method}-{n}.csv", table, UNITS) for n, table in enumerate(tables)
        ]
        theirs = os.path.join(self.folder, f"{method}.toml")
        more = ["-o", theirs, "--no-report"] if file else []
        said = program_json("identify", method, *files, *options, "--json", "--quiet", *more)
        found = ask(files if len(files) > 1 else files[0])
        self.assertEqual(found.report, said)
        self.assertEqual(found.model, said.get("chosen", found.model))
        if file:
            mine = os.path.join(self.folder, f"{method}-python.toml")
            found.write(mine)
            with open(mine, "rb") as one, open(theirs, "rb") as other:
                self.assertEqual(one.read(), other.read())
            self.assertRaises(FileExistsError, found.write, mine)
            found.write(mine, force=True)
            if file == "checked":
                program("check", mine)
        columns = ask(list(tables) if len(tables) > 1 else tables[0])
        values = [[p["value"] for p in r["parameters"]] for r in (columns.report, said)]
        self.assertEqual(values[0], values[1])
        return found

    def test_geometry(self) -> None:
        def ask(data: Any) -> Any:
            return identify.geometry(data, thread_thickness="0.2 mm", name="mine")

        found = self.compare(
            "geometry", [mesh()], ask, "--thread-thickness", "0.2 mm", "--name", "mine"
        )
        self.assertAlmostEqual(found.report["thread_length_m"], 0.1, 3)
        if found._repr_html_() is None:
            self.skipTest("built without npm: no page")
        page = os.path.join(self.folder, "page.html")
        program(
            "identify", "geometry", os.path.join(self.folder, "geometry-0.csv"), "--report", page,
            "--thread-thickness", "0.2 mm", "--name", "mine", "--quiet",
        )  # fmt: skip
        with open(page, encoding="utf-8") as file:
            self.assertEqual(file.read(), found.page())

    def test_geometry_from_trapezoids(self) -> None:
        said = program_json("identify", "geometry", "--trapezoids", "37,16", "--side", "0.057 in", "--json")
        found = identify.geometry_from_trapezoids(37, 16, "0.057 in")
        self.assertEqual(found.report, said)
        self.assertIn("37 x 16 trapezoids", found.text())
        self.assertIsNone(found._repr_html_())
        self.assertRaises(ValueError, found.page)

    def test_creep(self) -> None:
        found = self.compare("creep", [hold()], identify.creep, file="")
        self.assertEqual(len(found.report["creep"]["share"]), 2)
        self.assertRaises(IndexError, found.text)

    def test_dynamic(self) -> None:
        def ask(data: Any) -> Any:
            return identify.dynamic(
                data,
                actuator=ACTUATOR,
                mass=["6 lb", "11 lb"],
                pressure="60 psi gauge,80 psi gauge",
                external_volume="0.114 in3",
                model="secant",
            )

        found = self.compare(
            "dynamic", swings(), ask, "--actuator", ACTUATOR, "--mass", "6 lb,11 lb", "--pressure",
            "60 psi gauge,80 psi gauge", "--external-volume", "0.114 in3", "--model", "secant",
        )  # fmt: skip
        self.assertEqual(len(found.report["records"]), 2)

    def test_joint(self) -> None:
        def ask(data: Any) -> Any:
            return identify.joint(
                data, actuator=ACTUATOR, count=2, flexion="lowers angle", rest_angle="310 deg",
                lever=0.15, down="70 deg", joint_name="knee", base=ROBOT, moment_arm=0.03,
            )  # fmt: skip

        found = self.compare(
            "joint", [poses()], ask, "--actuator", ACTUATOR, "--count", "2", "--flexion",
            "lowers angle", "--rest-angle", "310 deg", "--lever", "0.15 m", "--down", "70 deg",
            "--joint", "knee", "--base", ROBOT, "--moment-arm", "0.03 m", "--actuator-out",
            os.path.join(self.folder, "theirs.toml"),
        )  # fmt: skip
        self.assertAlmostEqual(found.report["flexor_length_m"] / 0.083, 1, 1)
        found.write_actuator(os.path.join(self.folder, "mine.toml"))
        with open(os.path.join(self.folder, "theirs.toml"), encoding="utf-8") as file:
            self.assertEqual(file.read(), found.actuator_text())

    def test_pair(self) -> None:
        def ask(data: Any) -> Any:
            return identify.pair(
                data, model="spring_bristle", freeze={"delay": 0.0}, prior={"friction": (0.8, "0.1 N m")},
                hold_out="3 s..", joint_name="knee", base=ROBOT,
            )  # fmt: skip

        found = self.compare(
            "pair", moved_pairs(), ask, "--model", "spring_bristle", "--freeze", "delay=0 s", "--prior",
            "friction=0.8 N m ± 0.1 N m", "--hold-out", "3 s..", "--joint", "knee", "--base", ROBOT,
        )  # fmt: skip
        named = {one["name"]: one for one in found.report["parameters"]}
        self.assertAlmostEqual(named["friction"]["value"], 0.8, 1)
        self.assertEqual(named["delay"]["known"], "frozen")
        self.assertEqual(len(found.report["air"]["muscles"]), 1)
        self.assertRaises(ValueError, identify.pair, moved_pairs(), model="none")

    def test_sensor(self) -> None:
        def ask(data: Any) -> Any:
            return identify.sensor(data, bits=10, full_scale="5 V", rest=0.0)

        found = self.compare(
            "sensor", [weights()], ask, "--bits", "10", "--full-scale", "5 V", "--rest", "0 N",
            file="a part",
        )  # fmt: skip
        self.assertEqual(len(found.report["sensors"]), 1)

    def test_valve_from_a_chart(self) -> None:
        def ask(data: Any) -> Any:
            return identify.valve(data, name="mine")

        found = self.compare("valve", [chart()], ask, "--name", "mine")
        self.assertEqual(found.model, "iso6358")
        self.assertEqual(found.refused, "")
        self.assertRaises(identify.RefusalError, found.timing)

    def test_valve_from_a_filling(self) -> None:
        def ask(data: Any) -> Any:
            return identify.valve(data, volume=5e-4, port="7 bar abs", exponent=1.0)

        self.compare(
            "valve", [filling()], ask, "--volume", "0.0005 m3", "--port", "7 bar abs", "--exponent", "1"
        )
        alone = identify.valve(filling())  # determines only C/V
        self.assertIn("one curve does not separate C from V", alone.refused)
        self.assertEqual(alone.report["refused"], alone.refused)
        with self.assertRaises(identify.RefusalError) as raised:
            alone.write(os.path.join(self.folder, "none.toml"))
        self.assertEqual(str(raised.exception), alone.refused)

    def test_timing_of_a_map_of_duties(self) -> None:
        path = written(self.folder, "duty.csv", duties(), {})
        theirs = os.path.join(self.folder, "predict.dat")
        said = program_json(
            "identify", "valve", path, "--frequency", "25 Hz", "--predict-dat", theirs, "--json", "--quiet"
        )
        found = identify.valve(path, frequency=25.0)
        self.assertEqual(found.report, said)
        with open(theirs, encoding="utf-8") as file:
            self.assertEqual(found.timing(), file.read())
        with self.assertRaises(identify.RefusalError):  # delays, but no flow
            found.write(os.path.join(self.folder, "valve.toml"))

    def test_static_from_a_table_with_foreign_columns(self) -> None:
        data = os.path.join(
            os.path.dirname(os.path.abspath(__file__)),
            "../../data/martens_boblan_2017/DMSP-10-250_force_map.csv",
        )
        theirs = os.path.join(self.folder, "static.toml")
        said = program_json(
            "identify", "static", data, "--map", "force=F_N,pressure=P_gauge_Pa,length=L_m", "--unit",
            "F_N=N", "--unit", "P_gauge_Pa=Pa gauge", "--unit", "L_m=m", "--hold-out", "length",
            "--json", "--quiet", "-o", theirs, "--no-report",
        )  # fmt: skip
        table = identify.Table(
            data,
            names={"force": "F_N", "pressure": "P_gauge_Pa", "length": "L_m"},
            units={"F_N": "N", "P_gauge_Pa": "Pa gauge", "L_m": "m"},
        )
        found = identify.static_from(table, hold_out="length")
        self.assertEqual(found.report, said)
        with open(theirs, encoding="utf-8") as file:
            self.assertEqual(found.files[0], file.read())

    def test_force_beam(self) -> None:
        self.assertEqual(identify.force_beam(), program_json("force-beam", "--json"))
        said = program_json(
            "force-beam", "--load", "20 lbf", "--gain", "400", "--bridge", "half", "--sensitivity",
            "0.1 V/lbf", "--json",
        )  # fmt: skip
        mine = identify.force_beam(load="20 lbf", gain=400, bridge="half", sensitivity="0.1 V/lbf")
        self.assertEqual(mine, said)


if __name__ == "__main__":
    unittest.main()
