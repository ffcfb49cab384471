"""Comparison and replay of kept runs."""

import os
import tempfile
import unittest

import sinew
from common import Refusals, program_json

BENCH = sinew.shipped("experiments/one-joint.toml")
DAMPED = "joint.lever.damping=1.6 lbf in s/rad"


class Compare(Refusals):
    def setUp(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.a = os.path.join(self.folder.name, "a")
        self.b = os.path.join(self.folder.name, "b")
        self.run_a = sinew.run(BENCH, folder=self.a, report=False)
        sinew.run(BENCH, [DAMPED], folder=self.b, report=False)

    def test_is_what_the_program_prints(self) -> None:
        found = sinew.compare([self.a, self.b], align="correlation", clock="fit")
        printed = program_json(
            "compare", self.a, self.b, "--align", "correlation", "--clock", "fit", "--json"
        )
        self.assertEqual(found, printed)
        self.assertLess(abs(found["runs"][1]["alignment"]["rate"]), 0.01)
        keys = [parameter["key"] for parameter in found["parameters"]]
        self.assertEqual(keys, ["joint.lever.damping"])

    def test_takes_recordings_that_are_kept(self) -> None:
        same = sinew.compare([self.run_a, self.a], align="correlation")
        self.assertTrue(same["runs"][1]["alignment"]["same"])

    def test_replays_either_half(self) -> None:
        self.assertTrue(sinew.replay(self.a)["agrees"])
        self.assertTrue(sinew.replay(self.a, of="plant")["agrees"])
        kept = os.path.join(self.folder.name, "c")
        other = sinew.replay(self.a, of="plant", sets=[DAMPED], folder=kept)
        self.assertFalse(other["agrees"])
        self.assertIsNotNone(other["channels"][0]["parts_at_s"])
        self.assertIn("/true/joint/lever/angle", [c.name for c in sinew.read_run(kept).channels])

    def test_says_what_is_wrong(self) -> None:
        both = [self.a, self.b]
        self.refused(
            [
                (lambda: sinew.compare([self.a]), ValueError, "2 to 8"),
                (lambda: sinew.compare(both, align="middle"), ValueError, "start, sequence, event"),
                (lambda: sinew.compare(both, clock="fast"), ValueError, "none or fit"),
                (
                    lambda: sinew.compare(both, align="event", event="/joint/lever/angle"),
                    sinew.InputError,
                    "without > or <",
                ),
                (lambda: sinew.replay(self.a, of="robot"), ValueError, "controller or plant"),
                (lambda: sinew.replay("nowhere"), sinew.InputError, "nowhere"),
            ]
        )


if __name__ == "__main__":
    unittest.main()
