"""Experiments: values by key with their origins; settings that override the file's."""

import copy
import os
import pathlib
import pickle
import tempfile
import unittest
from typing import Any

import sinew
from common import AIR, WALK, Refusals, program_json


class Experiment(unittest.TestCase):
    def test_values_are_those_that_the_program_shows(self) -> None:
        walk = sinew.Experiment(WALK)
        compared = 0
        for shown in program_json("show", WALK, "--json"):
            key = shown["key"]
            origin = walk.origin(key)
            self.assertEqual(origin["text"], shown["written"], key)
            self.assertEqual(origin["unit"], shown.get("unit", ""), key)
            self.assertEqual(origin["source"], shown.get("source", ""), key)
            self.assertEqual(origin["default"], shown.get("default", False), key)
            if isinstance(walk[key], float) and "si" in shown:
                self.assertEqual(walk[key], float(shown["si"].split()[0]), key)
                compared += 1
        self.assertGreater(compared, 150)

    def test_units_are_converted(self) -> None:
        walk = sinew.Experiment(WALK)
        self.assertAlmostEqual(walk["control.stiffness.hip"], 35 * 0.112984829, 6)
        self.assertAlmostEqual(walk["trolley.track_length"], 5 * 0.3048, 12)
        self.assertEqual(walk["sequence.phases"], ["swing", "foot_plant", "propulsion"])
        self.assertIs(walk["sequence.thesis_timing"], False)
        self.assertAlmostEqual(sinew.quantity("60 psi gauge", "Pa abs"), 515038.17, delta=1)
        self.assertAlmostEqual(sinew.convert(0.0254, "m", "in"), 1.0, 12)

    def test_a_number_is_in_si_and_text_has_its_unit(self) -> None:
        in_si = sinew.Experiment(WALK, {"control.stiffness.hip": 3.25, "sequence.repeat": 2})
        as_text = sinew.Experiment(WALK, {"control.stiffness.hip": "3.25 N m/rad"})
        as_list = sinew.Experiment(WALK, ["control.stiffness.hip=3.25 N m/rad"])
        for one in (in_si, as_text, as_list):
            self.assertEqual(one["control.stiffness.hip"], 3.25)
        self.assertEqual(in_si["sequence.repeat"], 2)
        both = in_si.vary({"sequence.repeat": 3, "control.stiffness.knee": 1.0})
        self.assertEqual((both["control.stiffness.hip"], both["sequence.repeat"]), (3.25, 3))
        self.assertEqual(in_si["sequence.repeat"], 2)
        self.assertEqual(both.with_seed(9).seed, 9)
        self.assertTrue(sinew.Experiment(AIR, {"ground.present": True})["ground.present"])

    def test_a_number_is_in_si_also_in_a_table_that_the_file_lacks(self) -> None:
        walk = sinew.Experiment(AIR, {"plant_steps.body": 5e-4, "control.gains.hip.angle": 3e-4})
        self.assertEqual(walk["plant_steps.body"], 5e-4)
        self.assertEqual(walk["control.gains.hip.angle"], 3e-4)
        self.assertEqual(sinew.Experiment(AIR).vary({"plant_steps.body": 5e-4})["plant_steps.body"], 5e-4)
        table = sinew.sweep(AIR, vary={"plant_steps.body": [5e-4, 1e-3]}, report=["air_used_kg"], sets=["sequence.repeat=1"])
        self.assertEqual(len(table), 2)

    def test_is_a_mapping_of_its_values(self) -> None:
        walk = sinew.Experiment(WALK)
        self.assertIn("joint.hip.damping", walk)
        self.assertNotIn("joint.hip", walk)
        self.assertEqual(list(walk), walk.keys())
        self.assertEqual(len(walk), len(walk.keys()))
        for key, value in walk.to_dict().items():
            self.assertEqual(walk[key], value, key)

    def test_is_the_same_pickled_and_copied(self) -> None:
        walk = sinew.Experiment(WALK, {"control.stiffness.hip": 3.25})
        for other in (copy.copy(walk), copy.deepcopy(walk), pickle.loads(pickle.dumps(walk))):
            self.assertEqual(other["control.stiffness.hip"], 3.25)
            self.assertEqual(
                sinew.run(other).summary, sinew.run(walk).summary, "a run of the copy"
            )
        again = pickle.loads(pickle.dumps(walk)).vary({"sequence.repeat": 2})
        self.assertEqual((again["control.stiffness.hip"], again["sequence.repeat"]), (3.25, 2))

    def test_resolved_runs_again(self) -> None:
        walk = sinew.Experiment(WALK, {"sequence.repeat": 1})
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "again.toml"
            file.write_text(walk.resolved())
            self.assertEqual(sinew.run(file).summary, sinew.run(walk).summary)


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        walk = sinew.Experiment(WALK)
        anything: Any = object()
        with tempfile.TemporaryDirectory() as folder:
            bad = os.path.join(folder, "bad.toml")
            with open(bad, "w", encoding="utf-8") as file:
                file.write('format = "sinew.experiment/2"\nrobot = 3\n')
            empty = os.path.join(folder, "empty.toml")
            open(empty, "w", encoding="utf-8").close()
            stiff = "control.stiffness.hip"
            self.refused(
                [
                    (lambda: sinew.Experiment(bad), sinew.InputError, "bad.toml:2"),
                    (lambda: sinew.Experiment(empty), sinew.InputError, "empty.toml"),
                    (lambda: sinew.Experiment(folder), sinew.InputError, folder),
                    (lambda: sinew.Experiment(b"walk"), TypeError, "expected a path"),  # type: ignore[arg-type]
                    (lambda: sinew.Experiment(WALK, anything), TypeError, "expected a dict"),
                    (lambda: sinew.Experiment(WALK, "a=1"), TypeError, "expected a dict"),
                    (lambda: sinew.Experiment(WALK, [1]), TypeError, "key=value"),  # type: ignore[list-item]
                    (lambda: sinew.Experiment(WALK, {1: 2}), TypeError, "no text"),  # type: ignore[dict-item]
                    (lambda: sinew.Experiment(WALK, {stiff: None}), TypeError, "found None"),  # type: ignore[dict-item]
                    (lambda: sinew.Experiment(WALK, {stiff: [1.0]}), TypeError, "found [1.0]"),  # type: ignore[dict-item]
                    (lambda: sinew.Experiment(WALK, {stiff: "3"}), sinew.InputError, "try"),
                    (lambda: sinew.Experiment(WALK, {stiff: "3 m"}), sinew.InputError, stiff),
                    (lambda: sinew.Experiment(WALK, {stiff: -3.0}), sinew.InputError, stiff),
                    (lambda: sinew.Experiment(WALK, {stiff: float("nan")}), sinew.InputError, stiff),
                    (lambda: sinew.Experiment(WALK, {"seed": 10**30}), sinew.InputError, "seed"),
                    (lambda: sinew.Experiment(WALK, {"seed": 1.5}), sinew.InputError, "seed"),
                    (lambda: sinew.Experiment(WALK, {"control.stif": 3}), sinew.InputError, "stif"),
                    (lambda: sinew.Experiment(WALK, ["no sign"]), sinew.InputError, "no sign"),
                    (lambda: walk["control.stiffness.hpi"], KeyError, "control.stiffness.hip"),
                    (lambda: walk.origin("x"), KeyError, "expected a key"),
                    (lambda: walk.with_seed(-1), ValueError, "expected 0 to"),
                    (lambda: walk.vary({"trolley.track_length": "5"}), sinew.InputError, "track"),
                    (lambda: sinew.quantity("3", "m"), sinew.InputError, "expected"),
                    (lambda: sinew.quantity("3 kg", "m"), sinew.InputError, "3 kg"),
                    (lambda: sinew.convert(1.0, "m", "kg"), ValueError, "kg"),
                    (lambda: sinew.convert(1.0, "furlong", "m"), ValueError, "furlong"),
                    (lambda: sinew.shipped("experiments/none.toml"), FileNotFoundError, "walk-test-1"),
                ]
            )

    def test_every_problem_is_there_with_its_parts(self) -> None:
        with self.assertRaises(sinew.InputError) as raised:
            sinew.Experiment(WALK, {"control.stiffness.hip": "3 m", "joint.hip.damping": "x"})
        problems = raised.exception.problems
        self.assertEqual(
            sorted(p.key for p in problems), ["control.stiffness.hip", "joint.hip.damping"]
        )
        for problem in problems:
            self.assertTrue(problem.found and problem.expected)
            self.assertIn(str(problem), str(raised.exception))
        self.assertIsInstance(raised.exception, ValueError)


if __name__ == "__main__":
    unittest.main()
