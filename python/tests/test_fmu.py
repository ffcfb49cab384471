"""Export of FMUs from Python: the program's bytes, and refusals. fmu/tests tests the contents."""

import os
import tempfile
import unittest
from typing import Any, Callable

import sinew
from common import ACTUATOR, WALK, Refusals, program

LEG = sinew.shipped("robots/leg/robot.toml")


class Exported(unittest.TestCase):
    def test_is_the_programs(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            cases: "list[tuple[str, list[str], dict[str, Any]]]" = [
                (ACTUATOR, [], {}),
                (LEG, ["--muscle", "hip_flexor", "--fmi", "3"], {"muscle": "hip_flexor", "fmi": 3}),
                (LEG, ["--joint", "knee"], {"joints": ["knee"]}),
                (
                    WALK,
                    ["--input", "control.stiffness.hip", "--set", "joint.hip.damping=0.5 N m s/rad"],
                    {"inputs": ["control.stiffness.hip"], "sets": {"joint.hip.damping": 0.5}},
                ),
            ]
            for file, words, settings in cases:
                with self.subTest(words=words):
                    here, there = os.path.join(folder, "here"), os.path.join(folder, "there")
                    told = sinew.export_fmu(file, here, force=True, **settings)
                    program("fmu", "export", file, *words, "-o", there, "--force")
                    with open(here, "rb") as one, open(there, "rb") as other:
                        self.assertEqual(one.read(), other.read())
                    self.assertEqual(told["variables"][0]["name"], "time")


class Wrong(Refusals):
    def test_what_is_requested(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.fmu")

            def made(file: Any, where: Any = path, **other: Any) -> Callable[[], Any]:
                return lambda: sinew.export_fmu(file, where, **other)

            self.refused(
                [
                    (made("nowhere.toml"), sinew.InputError, "nowhere.toml"),
                    (made(3), TypeError, "path"),
                    (made(LEG, None), TypeError, "path"),
                    (made(LEG, folder), sinew.InputError, "a folder"),
                    (made(LEG, os.path.join(folder, "no", "x")), sinew.InputError, "no folder"),
                    (made(LEG, LEG, force=True), sinew.InputError, "what this command reads"),
                    (made(LEG, muscle="x"), sinew.InputError, "hip_flexor"),
                    (made(LEG, muscle=3), TypeError, "muscle"),
                    (made(LEG, joints="hip"), TypeError, "joints"),
                    (made(LEG, joints=["ankle"]), ValueError, "which the robot has not"),
                    (made(LEG, joints=["hip"], muscle="hip_flexor"), ValueError, "one of them"),
                    (made(LEG, inputs=["control.stiffness.hip"]), ValueError, "an experiment"),
                    (made(LEG, without_valves=True), ValueError, "no muscle"),
                    (made(LEG, fmi=4), ValueError, "expected 2 or 3"),
                    (made(LEG, fmi="2"), TypeError, "fmi"),
                    (made(LEG, sets={"joint.hip.moment_arm": -1.0}), sinew.InputError, "moment_arm"),
                    (made(LEG, sets=3), TypeError, "settings"),
                    (made(WALK, inputs=["x"]), ValueError, "expected one of"),
                    (made(WALK, outputs=["/x"]), ValueError, "/x"),
                    (made(WALK, parameters=["x"]), ValueError, "the key of a number"),
                    (made(ACTUATOR, muscle="x"), ValueError, "expected a robot"),
                ]
            )
            self.assertFalse(os.path.exists(path))
            sinew.export_fmu(ACTUATOR, path)
            self.refused([(made(ACTUATOR), sinew.InputError, "an unused name")])
