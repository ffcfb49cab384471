"""What a run of a robot tells of its machine: identify.run."""

import pathlib
import tempfile
import unittest

import sinew
from sinew import identify


class Run(unittest.TestCase):
    def test_friction_that_was_changed_is_found_again(self) -> None:
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place) / "bench"
            experiment = sinew.shipped("experiments/one-joint.toml")
            sinew.run(experiment, {"joint.lever.dry_friction": "0.07 N m"}, folder=folder, report=False)
            found = identify.run(
                folder, fit="joint.lever.dry_friction", sets="joint.lever.dry_friction=0.05 N m", threads=1
            )
            (number,) = found.report["parameters"]
            self.assertEqual(number["name"], "joint.lever.dry_friction")
            self.assertLess(number["low"], 0.07)
            self.assertGreater(number["high"], 0.07)
            self.assertAlmostEqual(number["value"], 0.07, 3)
            self.assertFalse(found.report["rough"])
            self.assertTrue(found.report["intervals"])
            self.assertEqual(found.report["landings"], 0)
            with self.assertRaisesRegex((sinew.InputError, identify.RefusalError), "fit"):
                identify.run(folder, fit="joint.elbow.dry_friction")
            with self.assertRaisesRegex((sinew.InputError, identify.RefusalError), "a share of the run"):
                identify.run(folder, fit="friction", hold_out="20")
            with self.assertRaisesRegex((sinew.InputError, identify.RefusalError), "to be fitted"):
                identify.run(
                    folder, fit="joint.lever.damping", freeze="joint.lever.damping=0.04 N m s/rad"
                )


if __name__ == "__main__":
    unittest.main()
