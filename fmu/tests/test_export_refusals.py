"""Faults on the command line of `sinew fmu export` are refused with a message; no file is lost."""

import os
import unittest
from typing import List, Tuple

from common import ACTUATOR, RIG, ROBOT, ROOT, WALK, WORK, program


class Program(unittest.TestCase):
    def test_wrong_words(self) -> None:
        rig_of_cylinder = f"{ROOT}/experiments/rig/sealed-cylinder.toml"
        out = os.path.join(WORK, "wrong.fmu")
        cases: "List[Tuple[List[str], int, str]]" = [
            (["nowhere.toml"], 1, "nowhere.toml"),
            ([ROOT], 1, "folder"),
            ([f"{ROOT}/robots/leg/valves.toml"], 1, "an actuator, rig, robot or experiment file"),
            ([ROBOT, "--muscle", "hip"], 1, "hip_flexor"),
            ([ROBOT, "--joint", "ankle"], 1, "which the robot has not"),
            ([ROBOT, "--joint", "hip", "--muscle", "hip_flexor"], 1, "expected one of them"),
            ([ROBOT, "--input", "control.stiffness.hip"], 1, "expected an experiment"),
            ([ROBOT, "--without-valves"], 1, "no muscle whose valves"),
            ([ROBOT, "--joint", "hip", "--without-valves"], 1, "joints without valves"),
            ([ROBOT, "--actuator", "bpa"], 1, "expected an actuator file"),
            ([ROBOT, "--fmi", "4"], 2, "--fmi"),
            ([ROBOT, "--set", "joint.hip.moment_arm=-1 in"], 2, "moment_arm"),
            ([ROBOT, "--set", "air.supply.kind=tank", "--set", "air.supply.volume=10 L",
              "--set", "air.supply.initial_pressure=200 psi abs"], 1, "empty together"),
            ([ACTUATOR, "--muscle", "x"], 1, "expected a robot"),
            ([ACTUATOR, "--actuator", "x"], 1, "x"),
            ([RIG, "--joint", "hip"], 1, "a rig"),
            ([rig_of_cylinder], 1, "an air cylinder"),
            ([WALK, "--input", "control.stiffness.ankle"], 1, "control.stiffness.hip"),
            ([WALK, "--output", "/joint/ankle/angle"], 1, "/joint/ankle/angle"),
            ([WALK, "--parameter", "joint.hip.dampin"], 1, "try \"joint.hip.damping\""),
            ([WALK, "--parameter", "title"], 1, "expected the key of a number"),
            ([WALK, "--parameter", "phase.swing.joint_angles.hip"], 1, "parameter: found"),
            ([WALK, "--output", "/joint/hip/angle", "--output", "/joint/hip/angle"], 1, "twice"),
            ([WALK, "--input", "control.stiffness.hip", "--parameter", "control.stiffness.hip"],
             1, "twice"),
            ([ROBOT, "--joint", "hip", "--joint", "hip"], 1, "twice"),
            ([ROBOT, "--name", "a\x01b"], 1, "a name in plain letters"),
            ([ROBOT, "--name", "  "], 1, "a name in plain letters"),
            ([], 2, "FILE"),
        ]  # fmt: skip
        for words, code, said in cases:
            with self.subTest(words=words):
                done = program("fmu", "export", *words, "-o", out)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertIn(said, done.stderr + done.stdout)
                self.assertFalse(os.path.exists(out))

    def test_nothing_is_overwritten_silently(self) -> None:
        out = os.path.join(WORK, "kept.fmu")
        with open(out, "w", encoding="utf-8") as file:
            file.write("mine")
        export = ("fmu", "export", ACTUATOR, "-o", out)
        for words in ("", "--force"):  # a file that is no FMU stays
            refused = program(*export, *words.split())
            self.assertEqual(refused.returncode, 1)
            with open(out, encoding="utf-8") as file:
                self.assertEqual(file.read(), "mine")
        os.remove(out)
        self.assertEqual(program(*export).returncode, 0)
        self.assertEqual(program(*export).returncode, 1)
        self.assertEqual(program(*export, "--force").returncode, 0)
        for target in (ACTUATOR, WORK, os.path.join(WORK, "no", "folder.fmu")):
            refused = program("fmu", "export", ACTUATOR, "-o", target, "--force")
            self.assertEqual(refused.returncode, 1, refused.stdout)
