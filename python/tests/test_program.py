"""`python3 -m sinew` is the program."""

import subprocess
import sys
import tempfile
import unittest

import sinew
from common import program


class Program(unittest.TestCase):
    def run_module(self, *words: str) -> "subprocess.CompletedProcess[str]":
        command = [sys.executable, "-m", "sinew", *words]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_says_and_does_the_same(self) -> None:
        done = self.run_module("--version")
        self.assertEqual(done.stdout, f"sinew {sinew.__version__}\n")
        words = ("kinematics", sinew.shipped("robots/leg/robot.toml"), "--angles", "300 deg, 292 deg")
        self.assertEqual(self.run_module(*words).stdout, program(*words))

    def test_ends_as_the_program_does(self) -> None:
        self.assertEqual(self.run_module("rnu").returncode, 2)
        self.assertEqual(self.run_module("run", "nowhere.toml").returncode, 1)
        self.assertIn("try run", self.run_module("rnu").stderr)

    def test_a_missing_one_is_reported(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            import shutil

            import sinew.__main__ as module

            shutil.copy(module.__file__, folder)
            command = [sys.executable, f"{folder}/__main__.py"]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("found no program bin/sinew above", done.stderr)
