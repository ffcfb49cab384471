"""Import of laboratory recordings as runs."""

import os
import tempfile
import unittest

import numpy

import sinew
from common import WALK


class Import(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def put(self, name: str, text: str) -> str:
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_a_table_becomes_a_run(self) -> None:
        rows = "".join(f"{i / 100};{300 - i / 10};{20 + i}\n" for i in range(100)).replace(".", ",")
        path = self.put("rig.csv", "Zeit [s];Hüfte [deg];Raum\n" + rows)
        mapping = os.path.join(self.folder, "rig.toml")
        run = sinew.import_recording(
            path,
            WALK,
            map={"/joint/hip/angle": "Hüfte"},
            units={"Raum": "1"},
            time="Zeit",
            keep_others=True,
            save_mapping=mapping,
            folder=os.path.join(self.folder, "run"),
        )
        angle = run["/joint/hip/angle"]
        self.assertTrue(bool(numpy.allclose(angle[:3], numpy.radians([300, 299.9, 299.8]))))
        self.assertEqual(len(run["/sensor/hip_angle/count"]), 100)
        self.assertEqual(run["/recorded/Raum"][3], 23)
        self.assertTrue(any("counts by the robot's scales" in note for note in run.warnings))
        again = sinew.import_recording(
            [path], WALK, mapping=mapping, folder=os.path.join(self.folder, "again")
        )
        self.assertTrue(numpy.array_equal(again["/joint/hip/angle"], angle))
        self.assertEqual(sinew.read_run(again.folder).summary, again.summary)

    def test_what_is_wrong_is_reported(self) -> None:
        path = self.put("rig.csv", "time [s],a [deg]\n0,1\n1,2\n")
        with self.assertRaisesRegex(sinew.InputError, "hip/angle"):
            sinew.import_recording(path, WALK, map={"/joint/hipp/angle": "a"})
        with self.assertRaisesRegex(ValueError, "join"):
            sinew.import_recording(path, WALK, join="both")
        self.assertFalse(os.path.exists("runs"))


if __name__ == "__main__":
    unittest.main()
