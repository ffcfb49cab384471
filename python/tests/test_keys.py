"""Keys of files: `sinew.keys` finds the same keys as `sinew keys`."""

import json
import os
import subprocess
import unittest

import sinew
from common import Refusals


class Keys(Refusals):
    def test_a_real_name_finds_the_key_with_its_unit_and_range(self) -> None:
        (damping,) = sinew.keys("joint.hip.damping")
        self.assertEqual((damping["kind"], damping["key"]), ("robot", "joint.<name>.damping"))
        self.assertEqual((damping["unit"], damping["min"], damping["required"]), ("N m s/rad", 0, True))
        self.assertEqual(damping["doc"], "viscous damping")

    def test_they_are_those_of_the_program(self) -> None:
        words = [os.environ["SINEW"], "keys", "damping", "--kind", "robot", "--json"]
        told = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
        self.assertEqual(sinew.keys("damping", kind="robot"), told)
        words = [os.environ["SINEW"], "keys", "--schema", "rig"]
        schema = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
        self.assertEqual(sinew.key_schema("rig"), schema)

    def test_without_a_word_they_are_all(self) -> None:
        every = sinew.keys()
        self.assertGreater(len(every), 400)
        self.assertLess(len(sinew.keys(kind="rig")), len(every))
        for key in every:
            self.assertTrue(key["type"] in ("table", "tables", "list") or key["required"] or "default" in key)

    def test_what_is_wrong_is_raised(self) -> None:
        with self.assertRaisesRegex(sinew.InputError, 'found "dampnig"; expected a key.*; try damping'):
            sinew.keys("dampnig")
        with self.assertRaisesRegex(sinew.InputError, 'found "robt"; expected robot, .*; try robot'):
            sinew.keys(kind="robt")
        with self.assertRaisesRegex(sinew.InputError, "schema: found"):
            sinew.key_schema("any")
        with self.assertRaises(TypeError):
            sinew.keys(3)  # type: ignore[arg-type]


if __name__ == "__main__":
    unittest.main()
