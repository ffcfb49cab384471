"""Units in which numbers are shown."""

import os
import unittest
from unittest import mock

import numpy as np
import sinew
from common import Refusals


class ShownUnits(Refusals):
    def setUp(self) -> None:
        # No user's own settings are read.
        patch = mock.patch.dict(os.environ, {"XDG_CONFIG_HOME": os.path.join(os.sep, "nowhere")})
        patch.start()
        self.addCleanup(patch.stop)
        os.environ.pop("SINEW_UNITS", None)

    def test_a_value_is_shown_in_the_units_of_a_set(self) -> None:
        self.assertEqual(sinew.shown(0.08, "m"), "0.08 m")
        self.assertEqual(sinew.shown(0.08, "m", "metric"), "80 mm")
        self.assertEqual(sinew.shown(0.08128, "m", "thesis"), "3.2 in")
        self.assertEqual(sinew.shown(0.08, "m", "metric,length=cm"), "8 cm")
        self.assertEqual(sinew.shown(1 / 3, "1", digits=2), "0.33")

    def test_what_is_shown_reads_back(self) -> None:
        pascals = sinew.quantity("4.2 bar gauge", "Pa abs")
        self.assertEqual(sinew.shown(pascals, "Pa", "metric"), "4.2 bar gauge")

    def test_arrays_come_with_the_name_of_their_unit(self) -> None:
        numbers, label = sinew.in_units(np.array([0.0, 0.0254]), "m", "thesis")
        np.testing.assert_allclose(numbers, [0, 1])
        self.assertEqual(label, "in")
        self.assertEqual(sinew.in_units(1e5, "Pa diff", "metric"), (1, "bar"))

    def test_the_environment_applies_where_the_call_does_not(self) -> None:
        os.environ["SINEW_UNITS"] = "metric"
        self.assertEqual(sinew.shown(0.08, "m"), "80 mm")
        self.assertEqual(sinew.shown(0.08, "m", "length=cm"), "8 cm")
        os.environ["SINEW_UNITS"] = "inches"
        with self.assertRaisesRegex(sinew.InputError, 'SINEW_UNITS: found "inches"; expected si, thesis or metric'):
            sinew.shown(0.08, "m")

    def test_wrong_words_are_named(self) -> None:
        with self.assertRaisesRegex(sinew.InputError, 'units: found "mertic"; .*; try "metric"'):
            sinew.shown(0.08, "m", "mertic")
        with self.assertRaisesRegex(ValueError, "digits: found 0; expected 1 to 17"):
            sinew.shown(0.08, "m", digits=0)


if __name__ == "__main__":
    unittest.main()
