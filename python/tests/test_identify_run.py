"""Identification of a machine from a run: identify.run."""

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
            other = pathlib.Path(place) / "other"
            changed = ("joint.lever.dry_friction=0.07 N m", "seed=5", "control.stiffness.lever=9 lbf in/rad")
            sinew.run(experiment, changed, folder=other, report=False)
            scored = identify.run(folder, fit="joint.lever.dry_friction", score=other, threads=1)
            angle = scored.score[0]
            self.assertEqual((angle["quantity"], angle["unit"]), ("angle", "rad"))
            self.assertEqual(angle["parts"][0]["name"], "lever")
            self.assertLess(angle["parts"][0]["rmse"], 0.001)
            self.assertGreater(angle["all"]["correlation"], 0.9999)
            self.assertEqual(found.score, [])
            as_it_is = identify.run(other, sets="joint.lever.dry_friction=0.05 N m", hold_out=1)
            self.assertGreater(as_it_is.score[0]["all"]["rmse"], 3 * angle["all"]["rmse"])
            self.assertEqual(as_it_is.report["parameters"], [])
            with self.assertRaisesRegex(sinew.InputError, "found nothing"):
                identify.run(folder, fit="friction", score=other / "nothing")
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
