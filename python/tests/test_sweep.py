"""Sweeps: the program's rows, on any number of threads."""

import os
import signal
import tempfile
import threading
import unittest
from typing import Any, List, Tuple

import numpy

import sinew
from common import AIR, WALK, Refusals, program_json

GAIN = "joint.hip.angle_gain"
ERROR = "joints.hip.tracking_rms_rad"


class Sweep(unittest.TestCase):
    def test_rows_are_the_programs(self) -> None:
        said = program_json(
            "sweep", AIR, "--vary", f"{GAIN}=0.02:0.1:5 %/count", "--vary",
            "joint.knee.enabled=true,false", "--report", ERROR, "--quiet", "--json",
        )  # fmt: skip
        vary = [f"{GAIN}=0.02:0.1:5 %/count", "joint.knee.enabled=true,false"]
        for threads in (1, 3):
            rows = sinew.sweep(AIR, vary, report=ERROR, threads=threads, device="cpu")
            self.assertEqual(rows, said["rows"], threads)

    def test_arrays_are_in_si(self) -> None:
        gains = numpy.linspace(2e-4, 1e-3, 4)
        rows = sinew.sweep(AIR, {GAIN: gains, "seed": [1, 2]}, report=[ERROR])
        self.assertEqual(len(rows), 8)
        self.assertEqual([row[f"{GAIN} [1/count]"] for row in rows[::2]], list(gains))
        alone = sinew.run(AIR, {GAIN: float(gains[2]), "seed": 2})
        self.assertEqual(
            rows[5]["joints.hip.tracking_rms [rad]"],
            alone.summary["joints"]["hip"]["tracking_rms_rad"],
        )

    def test_refused_runs_are_rows_with_their_reason(self) -> None:
        rows = sinew.sweep(AIR, {GAIN: [-1.0, -2.0]}, report=ERROR)
        self.assertEqual([row["joints.hip.tracking_rms [rad]"] for row in rows], [None, None])
        for row in rows:
            self.assertIn("expected at least 0", row["status"])

    def test_progress_is_reported_and_may_end_it(self) -> None:
        told: List[Tuple[int, int]] = []
        sinew.sweep(AIR, {"seed": range(1, 40)}, report=ERROR, progress=lambda n, of: told.append((n, of)))
        self.assertEqual(told[-1], (39, 39))
        self.assertEqual(sorted(told), told)

        def tired(done: int, of: int) -> None:
            raise KeyError("enough")

        with self.assertRaisesRegex(KeyError, "enough"):
            sinew.sweep(WALK, {"seed": range(1, 2000)}, report="trolley.distance_m", progress=tired)

    def test_ctrl_c_ends_it(self) -> None:
        # A process started in the background by a shell ignores Ctrl-C.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            sinew.sweep(WALK, {"seed": range(1, 5000)}, report="trolley.distance_m")


class Ensemble(unittest.TestCase):
    def test_rows_are_those_of_run(self) -> None:
        ensemble = sinew.Ensemble(AIR, [GAIN, "seed"], [ERROR, "air_used_kg", "no.such_figure"])
        self.assertEqual(ensemble.units, ["1/count", ""])
        values = numpy.array([[4e-4, 1], [6e-4, 2], [6e-4, 3]])
        for threads in (1, 3):
            figures = ensemble(values, threads=threads, device="cpu")
            self.assertEqual(figures.shape, (3, 3))
            self.assertTrue(numpy.isnan(figures[:, 2]).all())
            for row, (gain, seed) in zip(figures, values):
                alone = sinew.run(AIR, {GAIN: float(gain), "seed": int(seed)}).summary
                self.assertEqual(row[0], alone["joints"]["hip"]["tracking_rms_rad"])
                self.assertEqual(row[1], alone["air_used_kg"])

    def test_an_element_of_a_list_is_a_parameter(self) -> None:
        key = "actuator.bpa.effectiveness.polynomial[1]"
        ensemble = sinew.Ensemble(AIR, [key], [ERROR])
        self.assertEqual(ensemble.units, ["1/Pa"])
        figures = ensemble([[7e-8], [8e-8], [7e-8]])
        for row, text in zip(figures, ("7e-08 1/Pa", "8e-08 1/Pa")):
            alone = sinew.run(AIR, [f"{key}={text}"]).summary
            self.assertEqual(row[0], alone["joints"]["hip"]["tracking_rms_rad"])
        self.assertNotEqual(figures[0], figures[1])
        self.assertEqual(figures[0], figures[2])
        with self.assertRaisesRegex(sinew.InputError, "a number of the experiment"):
            sinew.Ensemble(AIR, ["actuator.bpa.effectiveness.polynomial[9]"], [ERROR])

    def test_a_refused_run_is_nan_with_its_reason(self) -> None:
        told: List[Tuple[int, int]] = []
        ensemble = sinew.Ensemble(AIR, [GAIN], [ERROR])
        figures, status = ensemble.run(
            [[4e-4], [-1.0]], progress=lambda n, of: told.append((n, of))
        )
        self.assertEqual(status[0], "ok")
        self.assertIn("expected at least 0", status[1])
        self.assertTrue(numpy.isnan(figures[1, 0]))
        self.assertEqual(told[-1], (2, 2))

    def test_wrong_inputs_are_refused(self) -> None:
        with self.assertRaisesRegex(sinew.InputError, "joint.hip.angle_gian"):
            sinew.Ensemble(AIR, ["joint.hip.angle_gian"], [ERROR])
        with self.assertRaisesRegex(sinew.InputError, "a number of the experiment"):
            sinew.Ensemble(AIR, ["title"], [ERROR])
        misspelt = sinew.Ensemble(AIR, [GAIN], ["joints.hip.trakcing_rms_rad"])
        with self.assertRaisesRegex(sinew.InputError, 'try "joints.hip.tracking_rms_rad"'):
            misspelt([[4e-4]])
        with self.assertRaisesRegex(sinew.InputError, 'try "joints.hip.tracking_rms_rad"'):
            sinew.Ensemble(AIR, [GAIN], ["joints.hip.trakcing_rms_rad"])([[-1.0]])  # none runs
        with self.assertRaisesRegex(sinew.InputError, 'found "seed" twice'):
            sinew.Ensemble(AIR, ["seed", GAIN, "seed"], [ERROR])
        ensemble = sinew.Ensemble(AIR, [GAIN], [ERROR])
        with self.assertRaisesRegex(ValueError, "one row for each run"):
            ensemble([1e-4, 2e-4])
        with self.assertRaisesRegex(TypeError, "expected real numbers"):
            ensemble([["4 m"]])


TUNING = """
format     = "sinew.tuning/1"
title      = "A hip that tracks"
experiment = "EXPERIMENT"
tune       = ["joint.hip.angle_gain=0.02:0.15 %/count log"]
minimize   = ["joints.hip.tracking_rms_rad [deg]"]
population = 6
generations = 4
"""


class Tune(unittest.TestCase):
    def test_is_the_programs(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = folder + "/hip.toml"
            with open(file, "w", encoding="utf-8") as text:
                text.write(TUNING.replace("EXPERIMENT", AIR))
            said = program_json("tune", file, "--results", folder + "/a.db", "--quiet", "--json")
            told: List[Tuple[int, int]] = []
            tuned = sinew.tune(
                file, folder + "/b.db", progress=lambda n, of: told.append((n, of)), threads=2
            )
            self.assertEqual(tuned, said)
            self.assertEqual(sinew.tune(file, folder + "/b.db"), said)  # nothing is run again
            with self.assertRaises(sinew.InputError):
                sinew.tune(AIR, folder + "/c.db")
            with self.assertRaisesRegex(TypeError, "with a unit"):
                sinew.tune(file, folder + "/c.db", sets={"joint.hip.damping": 1.0})  # type: ignore[dict-item]


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        anything: Any = object()

        def swept(*words: Any, **more: Any) -> Any:
            call: Any = sinew.sweep
            return call(AIR, *words, **{"report": ERROR, **more})

        self.refused(
            [
                (lambda: sinew.sweep("nowhere.toml"), sinew.InputError, "nowhere.toml"),
                (lambda: swept(anything), TypeError, "vary: found"),
                (lambda: swept([1]), TypeError, "vary: found [1]"),
                (lambda: swept("x"), sinew.InputError, "x"),
                (lambda: swept({"joint.hpi.angle_gain": [1.0]}), sinew.InputError, "hip"),
                (lambda: swept({GAIN: []}), ValueError, "found no values"),
                (lambda: swept({GAIN: [None]}), TypeError, "expected real numbers"),
                (lambda: swept({GAIN: ["1 m"]}), sinew.InputError, "1 m"),
                (lambda: swept({"seed": "1:2:3"}), sinew.InputError, "found seed: 1.5"),
                (lambda: swept(sets=["seed=1", "seed=2"]), ValueError, "second value of this key"),
                (lambda: swept({GAIN: [float("nan")]}), sinew.InputError, "nan"),
                (lambda: swept({}, report="joints.hpi.x"), sinew.InputError, "joints.hpi.x"),
                (lambda: swept({}, report=3), TypeError, "report: found 3"),
                (lambda: swept({}, seeds=-1), ValueError, "seeds: found -1"),
                (lambda: swept({}, threads=-2), ValueError, "threads: found -2"),
                (lambda: swept({}, threads="all"), TypeError, "threads"),
                (lambda: swept({}, device="tpu"), sinew.InputError, "expected auto, cpu, gpu or gpu:N"),
                (lambda: swept({}, device="gpu:99"), RuntimeError, "found no graphics card"),
                (lambda: swept({}, points=-1), ValueError, "points: found -1"),
                (lambda: swept({}, where="x <"), sinew.InputError, "where"),
                (lambda: swept({}, largest="x"), sinew.InputError, "largest"),
                (lambda: swept({}, ranges="x"), sinew.InputError, "range"),
                (lambda: swept({}, sets={"x": 1}), sinew.InputError, "x"),
                (lambda: swept({}, progress=3), TypeError, "callable"),
            ]
        )


if __name__ == "__main__":
    unittest.main()
