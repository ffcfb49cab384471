"""Printable figures and films of kept runs."""

import math
import os
import shutil
import struct
import tempfile
import unittest
from pathlib import Path
from typing import Any, List
from unittest import mock

import sinew
from common import Refusals
from sinew._film import Options, Refusal, _video, check


def missing_for_films() -> str:
    """Return what is missing to make a GIF; empty if nothing is missing."""
    if "CHROMIUM" in os.environ:
        return "" if shutil.which(os.environ["CHROMIUM"]) else f"CHROMIUM={os.environ['CHROMIUM']} is not there"
    names = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
    return "" if any(map(shutil.which, names)) else "chromium is missing: apt-get install chromium"


def delays_of(gif: bytes) -> "List[int]":
    """Return the duration of each frame of a GIF [ms]."""
    delays: "List[int]" = []
    at = 13 + 3 * (2 << (gif[10] & 7))
    while gif[at] != 0x3B:
        image = gif[at] == 0x2C
        if not image and gif[at + 1] == 0xF9:
            delays.append(10 * struct.unpack_from("<H", gif, at + 4)[0])
        at += 11 if image else 2  # without its own colour table
        while gif[at]:
            at += gif[at] + 1
        at += 1
    return delays


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

    def test_wrong_words_are_reported(self) -> None:
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
            sinew.film(out / "nothing", out / "walk.avi")
        with self.assertRaisesRegex(sinew.InputError, "width: found 200.5; expected a whole number"):
            sinew.film(self.run_folder, out / "walk.gif", width=200.5)  # type: ignore[arg-type]
        with mock.patch.dict(os.environ, CHROMIUM="nowhere"):
            with self.assertRaisesRegex(RuntimeError, 'CHROMIUM: found "nowhere", which is no program'):
                sinew.film(self.run_folder, out / "walk.gif")
        with mock.patch.dict(os.environ, CHROMIUM="/bin/true"):
            with self.assertRaisesRegex(ValueError, "found one run; expected several"):
                sinew.film(self.run_folder, out / "walk.gif", align="correlation")
            with self.assertRaisesRegex(ValueError, 'found "luck"; expected start, sequence, event or correlation'):
                sinew.film([self.run_folder, self.run_folder], out / "walk.gif", align="luck")
            with self.assertRaisesRegex(ValueError, "found none"):
                sinew.film([], out / "walk.gif")
        self.assertFalse(os.path.exists(out))

    def test_a_film_is_refused_by_the_name_of_what_is_wrong(self) -> None:
        def refusal(file: str, **options: Any) -> str:
            try:
                check(file, Options(**options))
            except Refusal as why:
                return str(why)
            return ""

        for file in ("a/walk.gif", "walk.mp4", "walk.webm"):
            self.assertEqual(refusal(file), "")
        for file in ("walk.avi", "walk", "walk.gif.txt"):
            self.assertRegex(refusal(file), f'^output: found "{file}"; expected .*.gif, .mp4 or .webm')
        self.assertRegex(refusal("a.gif", start=3, stop=2), "^from: found 3 s; expected a time before")
        self.assertRegex(refusal("a.gif", width=10), "^width: found 10; expected 100 to 3840 pixels")
        self.assertRegex(refusal("a.gif", height=100000), "^height: ")
        self.assertRegex(refusal("a.gif", fps=60), "^fps: found 60; expected 1 to 50")
        self.assertEqual(refusal("a.mp4", fps=60), "")
        self.assertRegex(refusal("a.mp4", width=881), "even number of pixels")
        self.assertEqual(refusal("a.gif", width=881), "")
        for speed in (0.0, -1.0, 1e9, math.nan):
            self.assertRegex(refusal("a.gif", speed=speed), "^speed: ")

    def test_the_maker_of_a_video_is_ended_with_its_film(self) -> None:
        browser = mock.Mock(**{"evaluate.side_effect": RuntimeError("the browser ended")})
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(RuntimeError, "the browser ended"):
            list(_video(browser, [0.0], Path("a.mp4"), "tail -f /dev/null", Path(folder) / "words"))
        with self.assertRaises(ChildProcessError):
            os.waitpid(-1, os.WNOHANG)

    @unittest.skipIf(missing_for_films(), missing_for_films())
    def test_a_film_is_a_gif_of_so_many_frames(self) -> None:
        file = Path(self.folder.name) / "walk.gif"
        try:
            frames = sinew.film(self.run_folder, file, start=0.5, stop=0.9, fps=20, width=320, height=240)
        except RuntimeError as why:
            if "built without its page" in str(why):
                self.skipTest(str(why))
            raise
        self.assertEqual(frames, 8)
        gif = file.read_bytes()
        self.assertEqual((gif[:6], *struct.unpack_from("<HH", gif, 6)), (b"GIF89a", 320, 240))
        self.assertEqual(delays_of(gif), [50] * 8)
        with self.assertRaisesRegex(sinew.InputError, "force"):
            sinew.film(self.run_folder, file)
        # Another run over it is another film.
        both = Path(self.folder.name) / "both.gif"
        measured = Path(self.folder.name) / "measured"
        other = {"joint.lever.damping": "0.7 lbf in s/rad"}
        sinew.run(sinew.shipped("experiments/one-joint.toml"), folder=measured, sets=other)
        runs = [self.run_folder, measured]
        frames = sinew.film(
            runs, both, start=0.5, stop=0.9, fps=20, width=320, height=240, align="correlation", fit_clock=True
        )
        self.assertEqual(frames, 8)
        self.assertEqual(delays_of(both.read_bytes()), [50] * 8)
        self.assertNotEqual(both.read_bytes(), gif)


if __name__ == "__main__":
    unittest.main()
