"""Preparation of measurements: columns, tables to fill in, and plans."""

import os
import tempfile
import unittest
from typing import Any

import numpy

import sinew
from common import program_json
from sinew import identify


class Inputs(unittest.TestCase):
    def test_columns_are_those_of_the_program(self) -> None:
        for method in ("static", "valve", "sensor"):
            self.assertEqual(identify.columns(method), program_json("identify", "columns", method, "--json"))
        with self.assertRaisesRegex(sinew.InputError, 'method: found "statik"'):
            identify.columns("statik")

    def test_a_template_is_read_by_its_method(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write(identify.template("geometry"))
            self.assertGreater(identify.geometry(path).report["thread_length_m"], 0.255)
        self.assertIn("upstream [bar abs]", identify.template("valve", "chart"))
        with self.assertRaisesRegex(sinew.InputError, "kind"):
            identify.template("valve", "nonsense")


class Planned(unittest.TestCase):
    def test_a_plan_is_the_program_s_and_its_table_has_a_row_for_each_reading(self) -> None:
        plan = identify.plan(rest_length=0.25, diameter="12 mm", pressure="600 kPa gauge", error=0.015)
        said = program_json("identify", "plan", "--rest-length", "0.25 m", "--diameter", "12 mm",
                            "--pressure", "600 kPa gauge", "--error", "1.5 %", "--json")
        self.assertEqual(plan.report["mounts"], said["mounts"])
        self.assertEqual(plan.table.count(",,"), plan.report["readings"])
        self.assertAlmostEqual(plan.minutes, said["time_s"] / 60)
        with self.assertRaisesRegex(sinew.InputError, "error: found"):
            identify.plan(rest_length=0.25, diameter=0.012, pressure=6e5, error=0.001)

    def test_data_say_what_is_next(self) -> None:
        length, pressure = (x.ravel() for x in numpy.meshgrid([0.2, 0.215, 0.23], numpy.linspace(1e5, 6e5, 8)))
        force = numpy.maximum(0, (pressure - 4e4) * (3 * length**2 - 0.28**2) / 40)
        data: Any = {"length": length, "pressure": pressure, "force": force}
        plan = identify.plan(data, rest_length=0.25, error=0.02)
        self.assertEqual(plan.report["measured_readings"], 24)
        self.assertLess(plan.report["after"]["rms_percent"], plan.report["before"]["rms_percent"])
        self.assertGreater(plan.report["mounts"][0]["length_m"], 0.23)


class Fillings(unittest.TestCase):
    def test_two_with_a_known_volume_joined_tell_conductance_and_volume(self) -> None:
        def filling(larger: float) -> "Any":
            # ISO 6358 with C/V = 2e-5/larger and b = 0.3, isothermal, from 7 bar.
            time, pressure, p = [], [], 1.013e5
            for i in range(8000):
                if i % 50 == 0:
                    time.append(1e-4 * larger * i)
                    pressure.append(p)
                x = max(0.0, (p / 7e5 - 0.3) / 0.7)
                if i > 400:
                    p += 1e-4 * 287 * 293.15 * 2e-5 * 1.185 * 7e5 * max(0.0, 1 - x * x) ** 0.5
            return {"time": time, "pressure": pressure}

        found = identify.valve([filling(1), filling(2)], added_volume=[0, 5e-4], exponent=1)
        values = {one["name"]: one["value"] for one in found.report["parameters"]}
        self.assertAlmostEqual(values["sonic_conductance"] / 1e-8, 1, 1)
        self.assertAlmostEqual(values["volume"] / 5e-4, 1, 1)
        self.assertEqual(found.refused, "")


if __name__ == "__main__":
    unittest.main()
