"""Figures for print and films of runs that are kept."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

import sinew
from common import Refusals


class Figures(Refusals):
    folder: tempfile.TemporaryDirectory[str]
    run_folder: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.run_folder = Path(cls.folder.name) / "run"
        sinew.run(sinew.shipped("experiments/one-joint.toml"), folder=cls.run_folder)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.folder.cleanup()

    def test_they_are_csv_files_and_an_index(self) -> None:
        out = Path(self.folder.name) / "own"
        told = sinew.figures(self.run_folder, out, formats=[], channels=["/joint/*/angle"], units="metric")
        (figure,) = told["figures"]
        self.assertEqual(told["warnings"], [])
        self.assertEqual({curve["y"][-5:] for curve in figure["curves"]}, {"[deg]"})
        for curve in figure["curves"]:
            self.assertIn(curve["y"], (out / curve["file"]).read_text().split("\n", 1)[0])

    @unittest.skipUnless(shutil.which("gnuplot"), "needs gnuplot")
    def test_two_runs_stand_in_the_same_axes(self) -> None:
        out = Path(self.folder.name) / "both"
        told = sinew.figures(
            [self.run_folder, self.run_folder], out, formats=["pdf"], only=["tension"], names=["a", "b"], width="84 mm"
        )
        self.assertTrue((out / told["figures"][0]["pdf"]).read_bytes().startswith(b"%PDF"))
        self.assertTrue(any(curve["curve"].endswith("b") for curve in told["figures"][0]["curves"]))

    def test_runs_are_laid_on_each_other(self) -> None:
        late = Path(self.folder.name) / "late"
        sinew.run(sinew.shipped("experiments/one-joint.toml"), sets={"start.settle": "2 s"}, folder=late)
        out = Path(self.folder.name) / "laid"
        told = sinew.figures([self.run_folder, late], out, formats=[], only=["joint-angles"], align="event")
        curves = {curve["curve"]: curve for curve in told["figures"][0]["curves"]}
        times = {name: (out / curves[name]["file"]).read_text().splitlines()[1] for name in ("run", "late")}
        self.assertLess(float(times["late"].split(",")[0]), -0.5)
        with self.assertRaisesRegex(ValueError, "start, event or correlation"):
            sinew.figures([self.run_folder, late], out, align="phase")

    def test_wrong_words_are_told(self) -> None:
        out = Path(self.folder.name) / "none"
        with self.assertRaisesRegex(sinew.InputError, "nearest|joint"):
            sinew.figures(self.run_folder, out, formats=[], channels=["/joint/*/angel"])
        with self.assertRaisesRegex(sinew.InputError, "width"):
            sinew.figures(self.run_folder, out, width="3 m")
        with self.assertRaisesRegex(ValueError, "pdf, svg or png"):
            sinew.figures(self.run_folder, out, formats=["eps"])
        with self.assertRaisesRegex(ValueError, "names or overlay"):
            sinew.figures([self.run_folder, self.run_folder], out)
        with self.assertRaisesRegex(sinew.InputError, "gif, .mp4 or .webm"):
            sinew.film(self.run_folder, out / "walk.avi")
        self.assertFalse(os.path.exists(out))


if __name__ == "__main__":
    unittest.main()
