"""Invalid arguments of identification are refused with messages that name them."""

import unittest
from typing import Any

import numpy

import sinew
from common import ACTUATOR, Refusals
from sinew import identify
from test_identify_tables import VALVES, chart, mesh, poses, swings, weights


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        geometry: Any = identify.geometry
        table: Any = identify.Table
        valve: Any = identify.valve
        dynamic: Any = identify.dynamic
        joint: Any = identify.joint
        sensor: Any = identify.sensor
        wrong, refusal = sinew.InputError, identify.RefusalError
        columns, swing, pose = mesh(), swings()[0], poses()
        length = columns["length"]
        short = {"length": length, "diameter": columns["diameter"][:4]}
        beam: Any = identify.force_beam
        self.refused(
            [
                (lambda: geometry("nowhere.csv"), wrong, "nowhere.csv"),
                (lambda: geometry(3), TypeError, "data: found 3"),
                (lambda: geometry([columns, columns]), wrong, "data: found 2 files; expected one"),
                (lambda: geometry({"length": length}), wrong, "diameter"),
                (lambda: geometry(short), ValueError, "diameter: found 4 numbers; expected 9"),
                (lambda: geometry({"length": length, "diameter": 1j}), TypeError, "diameter: found"),
                (lambda: geometry({"length": length, "diameter": [[1.0]]}), ValueError, "shape (1, 1)"),
                (lambda: geometry({"length": length, "diameter": numpy.nan}), wrong, "nan"),
                (lambda: geometry({"length [s]": length, "diameter": 0.02}), wrong, "length"),
                (lambda: geometry({"length": 1e3 * length, "diameter": 0.02}), wrong, "length"),
                (lambda: geometry({"length": 0.08, "diameter": [0.02] * 5}), refusal, "expected"),
                (lambda: geometry(columns, thread_thickness="1 s"), wrong, "thread_thickness: found"),
                (lambda: geometry(columns, thread_thickness=[1]), TypeError, "a number [m], or text"),
                (lambda: geometry(columns, name=3), TypeError, "name: found 3; expected text"),
                (lambda: geometry(table(columns, names={"lenght": "L"})), wrong, "lenght"),
                (lambda: geometry(table(columns, names="x")), TypeError, "names: found 'x'"),
                (lambda: geometry(table(columns, units={"m": 1})), TypeError, "units: found"),
                (lambda: geometry(table("a.csv", columns=3)), TypeError, "columns: found 3"),
                (lambda: identify.static_from(columns, hold_out="presure"), wrong, "hold_out: found"),
                (lambda: geometry(table(columns, atmosphere=-1.0)), wrong, "atmosphere: found"),
                (lambda: identify.geometry_from_trapezoids(0, 16, 1e-3), wrong, "trapezoids: found"),
                (lambda: identify.creep(swing), wrong, "force"),
                (lambda: identify.creep({"time": [1.0], "force": 1.0, "pressure": 3e5}), refusal, "12"),
                (lambda: dynamic(swing, actuator=VALVES, mass=1), wrong, "actuator"),
                (lambda: dynamic(swing, actuator=ACTUATOR, mass=[1, 2]), wrong, "mass: found 2 values"),
                (lambda: dynamic(swing, actuator=ACTUATOR, mass=-1), wrong, "mass: found"),
                (lambda: dynamic(swing, actuator=ACTUATOR, mass=1, count=0), wrong, "count: found 0"),
                (lambda: dynamic(swing, actuator=3, mass=1), TypeError, "expected a path"),
                (lambda: joint(pose, actuator=ACTUATOR, flexion="up"), wrong, "flexion: found"),
                (lambda: joint(pose, actuator=ACTUATOR, lever="1 s"), wrong, "lever: found"),
                (lambda: joint(pose, actuator=ACTUATOR, keep_force=1), TypeError, "True or False"),
                (lambda: joint(pose, actuator=ACTUATOR), refusal, "a load without a lever"),
                (lambda: sensor({"load [kg]": [0, 1], "gage": [0, 1]}), wrong, "gage"),
                (lambda: sensor(weights(), bits=40), wrong, "bits: found 40"),
                (lambda: sensor(weights(), known="mass"), wrong, "known: found"),
                (lambda: sensor(weights(), sensors=[3]), TypeError, "sensors: found 3"),
                (lambda: valve(chart(), kind="curve"), wrong, "kind: found \"curve\""),
                (lambda: valve(chart(), temperature=2e3), wrong, "temperature: found"),
                (lambda: valve(chart(), base=VALVES, name="x"), wrong, "name: found"),
                (lambda: valve({"time": [0, 1, 2], "pressure": 2e5}), refusal, "found 3 rows"),
                (lambda: beam(gages="0.8 in"), wrong, "gages: found"),
                (lambda: beam(bridge="full"), wrong, "bridge: found \"full\""),
                (lambda: beam(poisson="x"), TypeError, "poisson: found 'x'"),
            ]
        )


if __name__ == "__main__":
    unittest.main()
