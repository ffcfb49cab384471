"""Design of a joint and life of its muscles: the leg's own actuator, as C++ and the program do."""

import os
import tempfile
import unittest

import sinew
import sinew.design as design

MUSCLE = sinew.shipped("robots/leg/actuator.toml")
TASK = {"actuator": MUSCLE, "angles": "40 deg", "pressure": "100 psi gauge", "moment_arm": "1 in"}


class Joint(unittest.TestCase):
    """`sinew design joint` as a function."""

    def test_a_torque_is_a_number_in_si_or_a_text(self) -> None:
        """Both give the same design."""
        self.assertEqual(design.joint(**TASK, torque=1.5).report, design.joint(**TASK, torque="1.5 N m").report)

    def test_the_file_is_a_robot_over_its_base(self) -> None:
        """The joint of the written robot has the arm and the lengths of the report."""
        base = sinew.shipped("robots/one-joint/robot.toml")
        made = design.joint(**TASK, torque="5 lbf in", base=base, joint_name="lever")
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "robot.toml")
            made.write(file)
            with self.assertRaises(FileExistsError):
                made.write(file)
            experiment = sinew.Experiment(sinew.shipped("experiments/one-joint.toml"), {"robot": file})
            self.assertAlmostEqual(experiment["joint.lever.moment_arm"], made.report["moment_arm_m"], 12)
            self.assertAlmostEqual(experiment["muscle.flexor.mount_length"], made.report["mount_length_m"], 9)

    def test_without_a_design_the_reason_is_in_words(self) -> None:
        """A torque beyond that of all muscles gives a refusal."""
        self.assertIn("side by side reach", design.joint(**TASK, torque="500 N m").refused)


class Life(unittest.TestCase):
    """`sinew design life` as a function."""

    def test_what_is_unknown_is_none(self) -> None:
        """A life has two bounds, and no value between them."""
        report = design.life(actuator=MUSCLE, contraction=0.2, cycles=0.4, muscles=8).report
        self.assertIsNone(report["cycles"])
        self.assertLess(report["cycles_low"], report["cycles_high"])


if __name__ == "__main__":
    unittest.main()
