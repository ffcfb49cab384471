"""Robots as objects: attributes are the files' values, a change is checked at once."""

import copy
import unittest

import sinew
from common import ACTUATOR, VALVES, WALK, Refusals, program_json

LEG = sinew.shipped("robots/leg/robot.toml")


class Robot(unittest.TestCase):
    def test_attributes_are_the_values_that_the_program_shows(self) -> None:
        for path in (LEG, WALK, ACTUATOR, VALVES, sinew.shipped("experiments/rig/pwm-50hz-1lb.toml")):
            robot = sinew.Robot(path)
            shown = program_json("show", path, "--json")
            self.assertEqual(robot.keys(), [s["key"] for s in shown])
            for one in shown:
                part: object = robot
                for name in one["key"].split("."):
                    assert isinstance(part, sinew.Part)
                    self.assertIn(name, dir(part))
                    part = part[name]
                if isinstance(part, float) and "si" in one:
                    self.assertEqual(part, float(one["si"].split()[0]), one["key"])
        leg = sinew.Robot(LEG)
        self.assertAlmostEqual(leg.joint.hip.damping, 2.07 * 0.112984829, 6)
        self.assertEqual(list(leg.joint), ["hip", "knee"])
        self.assertEqual(leg.joint.hip.origin("damping")["unit"], "N m s/rad")

    def test_a_change_is_a_setting(self) -> None:
        leg = sinew.Robot(LEG)
        leg.joint.hip.damping = 0.1
        leg.muscle["hip_flexor"]["mount_length"] = "3.2 in"
        self.assertEqual(leg.joint.hip.damping, 0.1)
        self.assertAlmostEqual(leg.muscle.hip_flexor.mount_length, 3.2 * 0.0254, 12)
        there = sinew.Experiment(WALK, leg.changes)
        self.assertEqual(there["joint.hip.damping"], 0.1)
        self.assertAlmostEqual(there["muscle.hip_flexor.mount_length"], 3.2 * 0.0254, 12)
        self.assertNotEqual(sinew.Robot(LEG).joint.hip.damping, 0.1)
        self.assertEqual(copy.copy(leg.joint.hip).damping, 0.1)


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        leg = sinew.Robot(LEG)
        hip = leg.joint.hip
        self.refused(
            [
                (lambda: sinew.Robot("nowhere.toml"), sinew.InputError, "nowhere.toml"),
                (lambda: sinew.Robot(LEG, {"joint.hip.damping": -1.0}), sinew.InputError, "damping"),
                (lambda: leg.joint.hpi, AttributeError, "expected one of hip, knee"),
                (lambda: leg.joint["hpi"], KeyError, "expected one of hip, knee"),
                (lambda: setattr(hip, "dampin", 1.0), AttributeError, "damping"),
                (lambda: setattr(hip, "damping", -1.0), sinew.InputError, "at least 0"),
                (lambda: setattr(hip, "damping", "x"), sinew.InputError, "damping"),
                (lambda: setattr(hip, "damping", "1 m"), sinew.InputError, "1 m"),
                (lambda: setattr(hip, "damping", None), TypeError, "found None"),
                (lambda: hip.origin("x"), KeyError, "expected one of"),
                (lambda: hip.__setitem__("x", 1.0), KeyError, "expected one of"),
            ]
        )
        self.assertEqual(leg.changes, {})  # refused changes are not kept


if __name__ == "__main__":
    unittest.main()
