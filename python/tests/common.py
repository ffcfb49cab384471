"""Helpers of the tests: files shipped with Sinew, and the installed program."""

import json
import os
import subprocess
import unittest
from typing import Any, Callable, List, Tuple, Type

import sinew

WALK = sinew.shipped("experiments/walk-test-1.toml")
AIR = sinew.shipped("experiments/leg-in-air.toml")
ACTUATOR = sinew.shipped("robots/leg/actuator.toml")
VALVES = sinew.shipped("robots/leg/valves.toml")
PROGRAM = os.environ.get("SINEW", "sinew")


def program(*words: str) -> str:
    """Return the output of the program."""
    done = subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True)
    return done.stdout


def program_json(*words: str) -> Any:
    """Return the JSON output of the program."""
    return json.loads(program(*words))


class Refusals(unittest.TestCase):
    """Invalid inputs, each with its exception and a part of its message."""

    def refused(self, cases: "List[Tuple[Callable[[], Any], Type[BaseException], str]]") -> None:
        """Check that each call raises its exception with this text."""
        for number, (call, kind, words) in enumerate(cases):
            with self.subTest(number=number, words=words):
                with self.assertRaises(kind) as raised:
                    call()
                self.assertIn(words, str(raised.exception))
