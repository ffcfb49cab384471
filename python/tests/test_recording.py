"""Recorded runs: arrays in their own memory, figures, tables."""

import gc
import html
import os
import tempfile
import unittest

import numpy

import sinew
from common import WALK, Refusals, program, program_json


class Recording(unittest.TestCase):
    def setUp(self) -> None:
        self.walk = sinew.run(WALK, {"sequence.repeat": 2})

    def test_arrays_are_not_copied_and_outlive_it(self) -> None:
        a, b = self.walk["/joint/hip/angle"], self.walk["/joint/hip/angle"]
        self.assertEqual(a.dtype, numpy.float64)
        self.assertTrue(numpy.shares_memory(a, b))
        self.assertFalse(a.flags.writeable)
        with self.assertRaises(ValueError):
            a[0] = 1.0
        with self.assertRaises(ValueError):
            a.flags.writeable = True
        kept = a.copy()
        del self.walk, b
        gc.collect()
        others = [sinew.run(WALK, {"sequence.repeat": 1}) for _ in range(3)]
        self.assertTrue(numpy.array_equal(a, kept))
        del others

    def test_times_belong_to_the_samples(self) -> None:
        for channel in self.walk.channels:
            values, times = self.walk[channel.name], self.walk.time(channel.name)
            self.assertEqual(values.shape, times.shape, channel.name)
            self.assertTrue(bool((numpy.diff(times) >= 0).all()), channel.name)
            self.assertTrue(channel.unit and channel.description, channel.name)
        # Period of the gait controller.
        steps = numpy.diff(self.walk.time("/joint/hip/angle"))
        self.assertTrue(bool(numpy.allclose(steps, 0.01)))

    def test_figures_are_the_programs(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            walk = sinew.run(WALK, folder=folder + "/run", report=False)
            self.assertEqual(walk.folder, folder + "/run")
            self.assertEqual(sorted(os.listdir(walk.folder)), program_listing(walk.folder))
            said = program_json("analyze", walk.folder, "--json")
            self.assertEqual(sinew.read_run(walk.folder).summary, said)
            self.assertEqual(walk.summary, said)
            verdicts = program_json("analyze", walk.folder, "--verdicts")
            self.assertEqual(walk.verdicts, verdicts)

    def test_what_follows_from_the_samples(self) -> None:
        derived = self.walk.derive()
        torque = derived["/joint/hip/torque"]
        self.assertEqual(len(torque), len(self.walk["/joint/hip/angle"]))
        error = derived["/joint/hip/error"]
        measured = self.walk["/joint/hip/angle"] - self.walk["/desired/joint/hip/angle"]
        self.assertLess(float(numpy.abs(error - measured).max()), 1e-9)

    def test_shows_itself_as_the_programs_page(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            walk = sinew.run(WALK, folder=folder + "/run")
            with open(walk.folder + "/report.html", encoding="utf-8") as file:
                page = file.read()
            self.assertEqual(walk.page(), page)
            self.assertEqual(sinew.read_run(walk.folder).page(), page)
        self.assertEqual(sinew.run(WALK).page(), page)
        cell = walk._repr_html_()
        assert cell is not None
        inside = html.unescape(cell[cell.index('srcdoc="') + 8 : cell.rindex('" style=')])
        self.assertEqual(inside, page)

    def test_a_run_on_the_stand_is_the_programs(self) -> None:
        stand = sinew.shipped("experiments/rig/pwm-50hz-1lb.toml")
        with tempfile.TemporaryDirectory() as folder:
            program("run", stand, "-o", folder + "/run", "--quiet", "--no-report")
            kept = sinew.read_run(folder + "/run")
            again = sinew.run(stand, folder=folder + "/again", report=False)
        here = sinew.run(stand)
        for channel in here.channels:
            self.assertEqual(here[channel.name].tobytes(), kept[channel.name].tobytes())
            self.assertEqual(here[channel.name].tobytes(), again[channel.name].tobytes())
        self.assertEqual(here.summary, kept.summary)
        heavier = sinew.run(stand, {"load.mass": 1.0})
        self.assertNotEqual(heavier.summary, here.summary)

    def test_becomes_a_table_of_pandas(self) -> None:
        table = sinew.to_pandas(self.walk)
        self.assertTrue(
            numpy.array_equal(table["/joint/hip/angle"].to_numpy(), self.walk["/joint/hip/angle"])
        )
        self.assertAlmostEqual(float(table.index[1] - table.index[0]), 0.01)
        edges = [c.name for c in self.walk.channels if c.name.startswith("/valve/")]
        self.assertFalse(set(edges) & set(table.columns))
        some = sinew.to_pandas(self.walk, ["/joint/knee/angle", edges[0]])
        self.assertEqual(list(some.columns), ["/joint/knee/angle", edges[0]])
        self.assertEqual(int(some[edges[0]].count()), len(set(self.walk.time(edges[0]))))


def program_listing(folder: str) -> "list[str]":
    """Return the names of the files that the program writes, without a page."""
    with tempfile.TemporaryDirectory() as other:
        program("run", WALK, "-o", other + "/run", "--quiet", "--no-report")
        return sorted(os.listdir(other + "/run"))


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        walk = sinew.run(WALK, {"sequence.repeat": 1})
        with tempfile.TemporaryDirectory() as folder:
            kept = folder + "/run"
            sinew.run(WALK, {"sequence.repeat": 1}, folder=kept, report=False)
            cut = folder + "/cut.mcap"
            with open(kept + "/log.mcap", "rb") as log, open(cut, "wb") as part:
                part.write(log.read()[:20000])
            file = folder + "/file"
            open(file, "w", encoding="utf-8").close()
            self.refused(
                [
                    (lambda: walk["/joint/hpi/angle"], KeyError, "/joint/hip/angle"),
                    (lambda: walk.time("x"), KeyError, "expected one of"),
                    (lambda: walk[0], TypeError, "str"),  # type: ignore[index]
                    (lambda: sinew.read_run(folder + "/none"), sinew.InputError, "none"),
                    (lambda: sinew.read_run(folder), sinew.InputError, folder),
                    (lambda: sinew.read_run(file), Exception, "file"),
                    (lambda: sinew.read_run(3), TypeError, "expected a path"),  # type: ignore[arg-type]
                    (lambda: sinew.read_run(cut), sinew.InputError, "resolved.toml"),
                    (lambda: sinew.run(WALK, folder=kept), sinew.InputError, kept),
                    (lambda: sinew.run(WALK, folder=file), sinew.InputError, "file"),
                    (lambda: sinew.run(WALK, folder=3), TypeError, "expected a path"),  # type: ignore[arg-type]
                    (lambda: sinew.run(WALK, {}, kept), TypeError, "run"),  # type: ignore[misc]
                    (lambda: sinew.run("/nowhere.toml"), sinew.InputError, "/nowhere.toml"),
                    (lambda: sinew.to_pandas(walk, ["/x"]), KeyError, "/x"),
                    (lambda: walk.derive().page(), ValueError, "expected the run itself"),
                ]
            )
            self.assertTrue(sinew.read_run(kept).complete)


if __name__ == "__main__":
    unittest.main()
