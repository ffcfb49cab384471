"""Listing of files and creation of new ones, like the program."""

import os
import tempfile
import unittest

import sinew
from common import Refusals


class Files(Refusals):
    def test_what_comes_with_sinew_and_what_stands_here(self) -> None:
        with tempfile.TemporaryDirectory() as here:
            sinew.new_file("experiment", "lift", folder=here)
            listed = sinew.list_files("experiments", folder=here)
        self.assertIn("walk-test-1", " ".join(one["path"] for one in listed if one["shipped"]))
        own = [one for one in listed if not one["shipped"]]
        self.assertEqual([os.path.basename(one["path"]) for one in own], ["lift.toml"])
        self.assertEqual((own[0]["kind"], own[0]["problem"]), ("experiments", ""))

    def test_a_new_robot_moves(self) -> None:
        with tempfile.TemporaryDirectory() as here:
            (muscle,) = sinew.new_file("actuator", "mine", folder=here, metric=True)
            robot = sinew.new_file("robot", "arm", folder=here, actuator=muscle, metric=True)
            self.assertEqual([os.path.basename(path) for path in robot], ["robot.toml", "valves.toml"])
            (lift,) = sinew.new_file("experiment", "lift", folder=here, of=robot[0], metric=True)
            run = sinew.run(lift)
            self.assertLess(run.summary["joints"]["lever"]["tracking_rms_rad"], 0.12)
            with self.assertRaisesRegex(sinew.InputError, "an existing file"):
                sinew.new_file("experiment", "lift", folder=here)

    def test_what_is_wrong_is_raised(self) -> None:
        with self.assertRaisesRegex(sinew.InputError, 'found "robto"; expected .*robot'):
            sinew.new_file("robto", "x")
        with self.assertRaisesRegex(sinew.InputError, 'found "robot"'):
            sinew.list_files("robot")


if __name__ == "__main__":
    unittest.main()
