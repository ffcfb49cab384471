"""Migration of older files: `sinew.migrate` does the same as `sinew migrate`."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import sinew
from common import WALK, Refusals


class Migrate(Refusals):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.old = self.folder / "valves.toml"
        self.text = '# ours\n[valve.inlet]   # big\nkind = "2-way"\n'
        self.old.write_text(self.text, encoding="utf-8")

    def test_a_file_without_a_format_has_it_afterwards(self) -> None:
        told = sinew.migrate(self.old, write=False)
        self.assertEqual(self.old.read_text(encoding="utf-8"), self.text)
        done = sinew.migrate(self.old)
        self.assertEqual(done, {**told, "written": str(self.old), "kept": f"{self.old}.bak"})
        self.assertEqual((told["written"], told["kept"]), ("", ""))
        self.assertEqual((done["was"], done["is"]), ("", "sinew.valves/1"))
        self.assertEqual(done["changes"], ['line 2: format = "sinew.valves/1" is added'])
        new = self.old.read_text(encoding="utf-8")
        self.assertEqual(new, self.text.replace("# ours\n", '# ours\nformat = "sinew.valves/1"\n'))
        self.assertEqual(pathlib.Path(done["kept"]).read_text(encoding="utf-8"), self.text)

    def test_it_is_what_the_program_does(self) -> None:
        done = sinew.migrate(str(self.old), folder=self.folder / "python")
        words = [os.environ["SINEW"], "migrate", str(self.old), "-o", str(self.folder / "program"), "--json"]
        told = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)[0]
        self.assertEqual(told["changes"], done["changes"])
        self.assertEqual(pathlib.Path(told["written"]).read_bytes(), pathlib.Path(done["written"]).read_bytes())

    def test_one_of_today_is_left_alone(self) -> None:
        done = sinew.migrate(WALK)
        self.assertEqual((done["changes"], done["written"], done["kept"]), ([], "", ""))

    def test_what_is_wrong_is_raised(self) -> None:
        newer = self.folder / "newer.toml"
        newer.write_text('format = "sinew.robot/2"\n', encoding="utf-8")
        with self.assertRaisesRegex(sinew.InputError, 'found "sinew.robot/2"; expected "sinew.robot/1" or older'):
            sinew.migrate(newer)
        with self.assertRaisesRegex(sinew.InputError, "no readable file"):
            sinew.migrate(self.folder / "none.toml")
        with self.assertRaises(TypeError):
            sinew.migrate(3)  # type: ignore[arg-type]


if __name__ == "__main__":
    unittest.main()
