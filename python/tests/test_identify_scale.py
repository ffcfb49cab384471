"""Muscles that were not measured: identify.scale and static_from(predict=...)."""

import pathlib
import tempfile
import unittest

import sinew
from sinew import identify

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAP = identify.Table(
    ROOT / "data/martens_boblan_2017/DMSP-10-250_force_map.csv",
    names={"force": "F_N", "pressure": "P_gauge_Pa", "length": "L_m"},
    units={"F_N": "N", "P_gauge_Pa": "Pa gauge", "L_m": "m"},
)


class Scale(unittest.TestCase):
    folder: "tempfile.TemporaryDirectory[str]"
    file: pathlib.Path
    found: identify.Static

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory()
        cls.file = pathlib.Path(cls.folder.name) / "muscle.toml"
        cls.found = identify.static_from(MAP, rest_length=0.25, model="saturating", predict=0.18)
        cls.found.write(cls.file)

    @classmethod
    def tearDownClass(cls) -> None:
        cls.folder.cleanup()

    def test_one_muscle_does_not_determine_the_error_for_others(self) -> None:
        short = identify.scale(self.file, 0.18)
        self.assertEqual(short.report["rest_length_m"], 0.18)
        self.assertIsNone(short.report["half_95_N"])
        self.assertEqual(short.report["corrected_by"], 1)

    def test_predicted_muscles_follow_those_that_were_fitted(self) -> None:
        self.assertEqual(len(self.found.files), 2)
        self.assertIn("of another rest length", self.found.files[1])
        self.assertTrue(any("180 mm" in text for text in self.found.report["warnings"]))

    def test_a_reading_corrects_the_law(self) -> None:  # four fifths of the way, where it pulls most
        plain = identify.scale(self.file, "180 mm")
        force = 0.5 * plain.report["largest_force_N"]
        strong = identify.scale(self.file, 0.18, reading=(0.18, 6.5e5, 1.1 * 2 * force))
        self.assertAlmostEqual(strong.report["corrected_by"], 1.08, 6)
        self.assertAlmostEqual(strong.report["largest_force_N"], 2.16 * force, 3)

    def test_what_is_refused(self) -> None:
        with self.assertRaisesRegex(identify.RefusalError, "prediction.rest_length"):
            identify.scale(ROOT / "robots/leg/actuator.toml", 0.1)
        with self.assertRaisesRegex(identify.RefusalError, "reading: found"):
            identify.scale(self.file, 0.18, reading=(0.18, 6.5e5, 5000))
        with self.assertRaisesRegex(sinew.InputError, "two commas"):
            identify.scale(self.file, 0.18, reading="115 mm, 400 kPa gauge")
        with self.assertRaisesRegex(sinew.InputError, "rest_length"):
            identify.scale(self.file, -1.0)
        with self.assertRaisesRegex(sinew.InputError, "predict"):
            identify.static_from(MAP, rest_length=0.25, model="ideal", predict="length=3 mm")


if __name__ == "__main__":
    unittest.main()
