"""Identification from arrays: the program's law, its file, and refusals."""

import csv
import os
import signal
import tempfile
import threading
import time
import unittest
from typing import Any, Callable, Tuple

import numpy

import sinew
import sinew.identify
from common import ACTUATOR, Refusals, program_json

MAP = os.path.join(
    os.path.dirname(os.path.abspath(__file__)),
    "../../data/martens_boblan_2017/DMSP-10-250_force_map.csv",
)


def measured() -> Tuple[Any, Any, Any]:
    """Return lengths, pressures and forces of a public muscle."""
    with open(MAP, encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row and row[0][:1].isdigit()]
    table = numpy.array(rows, float)
    return table[:, 1], table[:, 0], table[:, 2]


class Interrupted(unittest.TestCase):
    def seconds_to_stop(self, work: Callable[[], object]) -> float:
        """Return the time until the work ends after a Ctrl-C in its first second."""
        # A process started in the background by a shell ignores Ctrl-C.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        sent = []

        def interrupt() -> None:
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        threading.Timer(0.7, interrupt).start()
        with self.assertRaises(KeyboardInterrupt):
            work()
        return time.monotonic() - sent[0]

    def test_ctrl_c_ends_a_static_law_at_once(self) -> None:
        # Some seconds of work: six muscles with a law that no model has.
        random = numpy.random.default_rng(1)
        rest = random.choice(numpy.arange(0.1, 0.4, 0.05), 3000)
        length = rest * random.uniform(0.8, 1, 3000)
        pressure = random.uniform(1e5, 6e5, 3000)
        force = pressure * 1e-3 * (length / rest - 0.7) * (1 + 0.05 * random.standard_normal(3000))
        static = sinew.identify.static
        took = self.seconds_to_stop(lambda: static(length, pressure, force, rest_length=rest, anyway=True))
        self.assertLess(took, 0.5)

    def test_ctrl_c_ends_a_method_that_reads_tables(self) -> None:
        random = numpy.random.default_rng(1)
        time_s = numpy.arange(20000) * 0.01
        pressure = 3e5 + 1e5 * numpy.sin(time_s / 5) + 1e3 * random.standard_normal(20000)
        force = 1e-3 * pressure + 5 * random.standard_normal(20000)
        table = {"time [s]": time_s, "pressure [Pa gauge]": pressure, "force [N]": force}
        took = self.seconds_to_stop(lambda: sinew.identify.creep(table))
        self.assertLess(took, 0.5)


class Static(unittest.TestCase):
    def test_a_length_that_cannot_be_and_a_mask_are_refused(self) -> None:
        length, pressure, force = measured()
        for wrong in (-1.0, 0.0, float("inf")):
            with self.assertRaisesRegex(ValueError, "rest_length: found"):
                sinew.identify.static(length, pressure, force, rest_length=wrong)
        held = numpy.asarray(force)
        masked: Any = numpy.ma.MaskedArray(held, mask=held < 10)  # type: ignore[no-untyped-call]
        with self.assertRaisesRegex(ValueError, "force: found a masked array"):
            sinew.identify.static(length, pressure, masked)
        # In a table a masked element is a cell without a number, which may be left out.
        columns = {"length [m]": length, "pressure [Pa gauge]": pressure, "force [N]": masked}
        table = sinew.identify.Table(columns, drop_incomplete=True)
        with self.assertRaisesRegex(ValueError, "nan"):
            sinew.identify.static_from(columns)
        few = {name: numpy.asarray(one)[held >= 10] for name, one in columns.items()}
        left = sinew.identify.static_from(table, model="ideal").report["parameters"]
        self.assertEqual(left, sinew.identify.static_from(few, model="ideal").report["parameters"])

    def test_is_the_programs(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            theirs = folder + "/theirs.toml"
            said = program_json(
                "identify", "static", MAP, "--map", "force=F_N,pressure=P_gauge_Pa,length=L_m",
                "--unit", "F_N=N", "--unit", "P_gauge_Pa=Pa gauge", "--unit", "L_m=m",
                "--hold-out", "length", "--json", "--quiet", "-o", theirs,
            )  # fmt: skip
            length, pressure, force = measured()
            found = sinew.identify.static(length, pressure, force, hold_out="length")
            self.assertEqual(found.model, said["chosen"])
            self.assertEqual(found.report["parameters"], said["parameters"])
            self.assertEqual(found.report["held_out"], said["held_out"])
            mine = folder + "/mine.toml"
            found.write(mine)
            with self.assertRaises(FileExistsError):
                found.write(mine)
            found.write(mine, force=True)
            grid = numpy.linspace(0.2, 0.245, 9)[:, None], numpy.linspace(1e5, 6e5, 6)
            self.assertEqual(
                sinew.Actuator(mine).tension(*grid).tobytes(),
                sinew.Actuator(theirs).tension(*grid).tobytes(),
            )

    def test_points_that_repeat_count_once(self) -> None:
        length, pressure, force = measured()
        once = sinew.identify.static(length, pressure, force, model="threshold").report
        many = [numpy.tile(each, 20) for each in (length, pressure, force)]
        again = sinew.identify.static(*many, model="threshold").report
        self.assertEqual(once["parameters"], again["parameters"])
        self.assertIn("rows repeat earlier ones", again["notes"][0])

    def test_the_law_that_made_the_forces_comes_back(self) -> None:
        truth = sinew.Actuator(ACTUATOR)
        ends = 1.02 * truth.shortest_length, 0.97 * truth.greatest_length
        length = numpy.repeat(numpy.linspace(*ends, 12), 6)
        pressure = numpy.tile(numpy.linspace(1e5, 5e5, 6), 12)
        noise = numpy.random.default_rng(4).normal(0, 0.05, length.size)
        found = sinew.identify.static(
            length, pressure, truth.tension(length, pressure) + noise,
            rest_length=truth.greatest_length,
        )  # fmt: skip
        with tempfile.TemporaryDirectory() as folder:
            found.write(folder + "/again.toml")
            again = sinew.Actuator(folder + "/again.toml").tension(length, pressure)
        error = again - truth.tension(length, pressure)
        self.assertLess(float(numpy.sqrt((error**2).mean())), 0.2)


class Checks(unittest.TestCase):
    def test_are_the_programs(self) -> None:
        table = sinew.identify.Table(
            MAP,
            names={"force": "F_N", "pressure": "P_gauge_Pa", "length": "L_m"},
            units={"F_N": "N", "P_gauge_Pa": "Pa gauge", "L_m": "m"},
        )
        said = program_json(
            "identify", "check", MAP, "--map", "force=F_N,pressure=P_gauge_Pa,length=L_m",
            "--unit", "F_N=N", "--unit", "P_gauge_Pa=Pa gauge", "--unit", "L_m=m",
            "--rest-length", "250 mm", "--diameter", "10 mm", "--json",
        )  # fmt: skip
        found = sinew.identify.check(table, rest_length=0.25, diameter="10 mm")
        self.assertEqual(found.report, said)
        self.assertFalse(found.red)
        self.assertEqual(found.lights()["force unit"], "green")
        self.assertEqual(found.lights()["both ways"], "yellow")
        self.assertIn("yellow: both ways: ", str(found))
        self.assertIn("grey: zero of force: ", str(found))
        self.assertEqual(len(found.report["recognised"]["mounts"]), 5)
        wrong = sinew.identify.check(table, rest_length=0.23, hold_out="pressure")
        self.assertTrue(wrong.red)
        self.assertEqual(wrong.lights()["rest length"], "red")

    def test_red_is_refused_unless_it_is_to_be_fitted_anyway(self) -> None:
        length, pressure, force = measured()
        columns = {"length": length, "pressure": pressure, "force": force}
        static, tables = sinew.identify.static, sinew.identify.static_from
        refusal = sinew.identify.RefusalError
        told = "(?s)rest length: The longest mount.*anyway=true"
        with self.assertRaisesRegex(refusal, told):
            static(length, pressure, force, rest_length=0.23)
        with self.assertRaisesRegex(refusal, told):
            tables(columns, rest_length=0.23)
        for found in (
            static(length, pressure, force, rest_length=0.23, model="saturating", anyway=True),
            tables(columns, rest_length=0.23, model="saturating", anyway=True),
        ):
            warning, air = found.report["warnings"]
            self.assertIn("108.7 %", warning)
            self.assertIn("by the force alone", air)
            self.assertLess(found.report["air_at_rest"]["low_m3"], found.report["air_at_rest"]["volume_m3"])
        with self.assertRaisesRegex(refusal, "force unit"):
            static(length, pressure, force, rest_length=0.25, diameter=0.04)
        with self.assertRaisesRegex(ValueError, "diameter: found -1"):
            static(length, pressure, force, diameter=-1.0)


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        length, pressure, force = measured()
        few = slice(0, 3)
        nan = force.copy()
        nan[4] = numpy.nan
        static: Any = sinew.identify.static
        refusal = sinew.identify.RefusalError
        self.refused(
            [
                (lambda: static(length[few], pressure[few], force[few]), refusal, "expected"),
                (lambda: static(length, 3e5, force), refusal, "pressure"),
                (lambda: static([], [], []), refusal, "no rows"),
                (lambda: static(length[:5], pressure, force), ValueError, "length: found an array"),
                (lambda: static(length, pressure[:5], force), ValueError, "pressure: found"),
                (lambda: static(length, pressure, nan), ValueError, "found nan in place 4"),
                (lambda: static(length, pressure, "many"), TypeError, "expected real numbers"),
                (lambda: static(length, pressure, None), TypeError, "force: found None"),
                (lambda: static(length[:, None], pressure, force), ValueError, "85 numbers"),
                (lambda: static(-length, pressure, force), Exception, "length"),
                (lambda: static(length, pressure, force, model="x"), refusal, "expected one of ideal"),
                (lambda: static(length, pressure, force, hold_out="x"), ValueError, "hold_out"),
                (lambda: static(length, pressure, force, fitted=[True] * 3), ValueError, "fitted"),
                (lambda: static(length, pressure, force, rest_length="x"), TypeError, "rest_length"),
                (lambda: static(length, pressure, force, fitted=False), refusal, "expected"),
            ]
        )
        with self.assertRaises(IndexError):
            static(length, pressure, force).write("/nowhere/x.toml", muscle=7)


if __name__ == "__main__":
    unittest.main()
