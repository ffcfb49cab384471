"""Format settings of tables of measurements, and the types that may hold their columns."""

import importlib
import os
import tempfile
import unittest
from typing import Any, Callable, Dict, List, Tuple

import numpy

import sinew
from common import ACTUATOR, program_json
from sinew import identify
from test_identify_tables import hold, mesh, swings, written


def settling() -> "Dict[str, Any]":
    """Return a step of pressure at one length; a part of the force follows a minute later."""
    time = numpy.arange(0, 600.0, 5.0)
    gauge = numpy.where(time < 15, 1e5, 4e5)
    late = numpy.where(time < 15, 1e5, 4e5 - 3e5 * numpy.exp(-(time - 12.5) / 60))
    force = 3e-4 * (gauge - 2e4 + 0.05 * (late - 2e4)) + 0.01 * numpy.sin(7 * time)
    return {"time": time, "force": force, "pressure": gauge}


def same_creep(found: "Dict[str, Any]", expected: "Dict[str, Any]", apart: float) -> None:
    """Check that the shares and times of two creeps differ at most by a fraction."""
    for key in ("share", "time_s"):
        numpy.testing.assert_allclose(found[key], expected[key], rtol=apart)


class Columns(unittest.TestCase):
    def test_any_holder_of_columns_will_do(self) -> None:
        pandas: Any = importlib.import_module("pandas")
        plain = identify.geometry(mesh()).report["parameters"]
        columns = mesh()
        frame = pandas.DataFrame(columns)
        records = numpy.zeros(9, dtype=[(name, float) for name in columns])
        for name, values in columns.items():
            records[name] = values
        inches = {f"{name} [in]": values / 0.0254 for name, values in columns.items()}
        foreign = identify.Table(
            {"L": columns["length"], "D": columns["diameter"], "phase": ["up"] * 8 + ["down"]},
            names={"length": "L", "diameter": "D"},
            where={"phase": "up, down"},
        )
        for data in (frame, records, foreign, [columns]):
            self.assertEqual(identify.geometry(data).report["parameters"], plain)
        value = identify.geometry(inches).report["parameters"][0]["value"]
        self.assertAlmostEqual(value, plain[0]["value"], 9)

    def test_values_and_offsets_stand_for_what_a_table_lacks(self) -> None:
        """A testing machine writes extensions, one file per pressure; missing columns are given."""
        length, diameter = mesh().values()
        extension = {"length": length - 0.06, "diameter": diameter}
        found = identify.geometry(identify.Table(extension, offsets={"length": "60 mm"})).report["parameters"]
        for one, other in zip(found, identify.geometry(mesh()).report["parameters"]):
            self.assertAlmostEqual(one["value"] / other["value"], 1, 9)
        with self.assertRaisesRegex(sinew.InputError, "values: found \"lenght\".*length"):
            identify.geometry(identify.Table(mesh(), values={"lenght": "205 mm"}))
        with self.assertRaisesRegex(sinew.InputError, "and the value \"205 mm\" for the whole file"):
            identify.geometry(identify.Table(mesh(), values={"length": "205 mm"}))
        with self.assertRaisesRegex(identify.RefusalError, "length: found 0.205 m throughout"):
            identify.geometry(identify.Table({"diameter": diameter}, values={"length": "205 mm"}))
        with self.assertRaisesRegex(TypeError, "values: found 'a:length'; expected the name of a column"):
            identify.geometry(identify.Table(mesh(), values={"a:length": "205 mm"}))
        gauge = {name: hold()[name] for name in ("time", "force")}
        by_value = identify.creep(identify.Table(gauge, values={"pressure": "4 bar gauge"}))
        same_creep(by_value.report["creep"], identify.creep(hold()).report["creep"], 1e-9)

    def test_what_is_held_out_has_the_same_columns(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            swing = {"t [s]": swings()[0]["time"], "x [m]": swings()[0]["length"]}
            one, other = (written(folder, f"{name}.csv", swing, {}) for name in "ab")
            names = {"time": "t", "length": "x"}
            settings: Any = {"actuator": ACTUATOR, "mass": "6 lb", "pressure": "60 psi gauge"}
            settings.update(external_volume="0.114 in3", model="viscous")
            found = identify.dynamic(identify.Table(one, names=names), hold_out=other, **settings)
            said = program_json(
                "identify", "dynamic", one, "--hold-out", other, "--map", "time=t,length=x",
                "--actuator", ACTUATOR, "--mass", "6 lb", "--pressure", "60 psi gauge",
                "--external-volume", "0.114 in3", "--model", "viscous", "--json", "--quiet",
            )  # fmt: skip
            self.assertEqual(found.report, said)
            bare = os.path.join(folder, "bare.csv")
            numpy.savetxt(bare, numpy.column_stack(list(mesh().values())), delimiter=",")
            header = "length [m], diameter [m]"
            for columns in (header, header.split(", ")):
                table = identify.Table(bare, columns=columns)
                self.assertAlmostEqual(identify.geometry(table).report["thread_length_m"], 0.1, 3)

    def test_what_a_file_leaves_open_is_stated(self) -> None:
        """Each usual number format gives the braid of the plain table."""
        plain = identify.geometry(mesh()).report["parameters"]
        length, diameter = mesh().values()
        heads = ("L [µm]", "D [µm]")

        def text(mark: str, number: "Callable[[float], str]") -> str:
            rows = [heads] + [(number(1e6 * a), number(1e6 * b)) for a, b in zip(length, diameter)]
            return "\n".join(mark.join(row) for row in rows) + "\n"

        def german(value: float) -> str:
            return f"{value:,.6f}".translate(str.maketrans(",.", ".,"))

        cases: "List[Tuple[str, str, str, Dict[str, Any]]]" = [
            ("latin1", "latin1", text(";", german), {"encoding": "latin1", "decimal": ",", "thousands": "."}),
            ("tabs", "utf-8", text("\t", german), {"decimal": ",", "thousands": "."}),
            ("utf16", "utf-16", text(";", lambda v: f"{v:.6f}"), {"decimal": "."}),
            ("swiss", "utf-8", text(";", lambda v: f"{v:,.6f}".replace(",", "'")), {"thousands": "'", "decimal": "."}),
            ("spaces", "utf-8", text(";", lambda v: f"{v:,.6f}".replace(",", " ")), {"thousands": " ", "decimal": "."}),
        ]
        with tempfile.TemporaryDirectory() as folder:
            for name, encoding, words, settings in cases:
                file = os.path.join(folder, f"{name}.csv")
                with open(file, "w", encoding=encoding, newline="") as out:
                    out.write(words)
                table = identify.Table(file, names={"length": "L", "diameter": "D"}, **settings)
                with self.subTest(name=name):
                    found = identify.geometry(table).report["parameters"]
                    for one, other in zip(found, plain):
                        self.assertAlmostEqual(one["value"] / other["value"], 1, 6)

    def test_times_by_a_rate_and_times_that_rows_share(self) -> None:
        one = settling()
        plain = identify.creep(one).report["creep"]
        self.assertAlmostEqual(sum(plain["share"]), 0.05, 2)
        bare = {name: one[name] for name in ("force", "pressure")}
        coarse = dict(one, time=numpy.floor(one["time"] / 20) * 20)  # four rows share each
        for table in (identify.Table(bare, rate="0.2 Hz"), identify.Table(coarse, spread_times=True)):
            same_creep(identify.creep(table).report["creep"], plain, 1e-6)

    def test_one_of_several_recordings_in_a_file(self) -> None:
        one = settling()
        plain = identify.creep(one).report["creep"]
        names = ("time", "force", "pressure")
        rows = ["%r,%r,%r\n" % tuple(float(one[name][i]) for name in names) for i in range(one["time"].size)]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "two.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write("time [s],force [N],pressure [Pa gauge]\n" + "".join(rows[:9] + rows))
            with self.assertRaisesRegex(sinew.InputError, "2 recordings one after the other.*part=1"):
                identify.creep(path)
            same_creep(identify.creep(identify.Table(path, part=2)).report["creep"], plain, 1e-6)

    def test_dates_are_read_as_stated(self) -> None:
        one = settling()
        days = numpy.arange(one["time"].size) * 5 / 86400
        plain = identify.creep(one).report["creep"]
        with tempfile.TemporaryDirectory() as folder:

            def file_of(name: str, stamp: "Callable[[int], str]") -> str:
                path = os.path.join(folder, name)
                with open(path, "w", encoding="utf-8") as out:
                    out.write("date;force [N];pressure [Pa gauge]\n")
                    for i, (force, gauge) in enumerate(zip(one["force"], one["pressure"])):
                        out.write(f"{stamp(i)};{force!r};{gauge!r}\n")
                return path

            def clock(i: int) -> str:
                return f"{10 + i // 720:02}:{i * 5 // 60 % 60:02}:{i * 5 % 60:02}"

            ways: "List[Tuple[str, str, Callable[[int], str]]]" = [
                ("day", "day first", lambda i: f"03/04/2026 {clock(i)}"),
                ("month", "month first", lambda i: f"04/03/2026 {clock(i)}"),
                ("excel", "excel", lambda i: f"{46000 + days[i]:.10f}"),
            ]
            for name, dates, stamp in ways:
                with self.subTest(name=name):
                    table = identify.Table(file_of(name, stamp), names={"time": "date"}, dates=dates, decimal=".")
                    same_creep(identify.creep(table).report["creep"], plain, 1e-4)

    def test_what_is_ambiguous_or_unknown_is_refused_with_its_setting(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "open.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write("L [mm];D [mm]\n60,000;25,500\n70,000;22,700\n80,000;19,100\n")
            names = {"length": "L", "diameter": "D"}
            refusals: "List[Tuple[Dict[str, Any], str]]" = [
                ({}, "decimal"),
                ({"encoding": "klingon"}, "encoding"),
                ({"decimal": "x"}, "decimal"),
                ({"thousands": "x"}, "thousands"),
                ({"dates": "whenever"}, "dates"),
            ]
            for settings, words in refusals:
                with self.subTest(settings=settings), self.assertRaises(sinew.InputError) as raised:
                    identify.geometry(identify.Table(path, names=names, **settings))
                self.assertIn(words, str(raised.exception))

        bare = {name: settling()[name] for name in ("force", "pressure")}
        with self.assertRaisesRegex(sinew.InputError, "rate"):
            identify.creep(identify.Table(bare, rate="often"))

    def test_rows_without_numbers_are_left_out_if_requested(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "gaps.csv")
            length, diameter = mesh().values()
            with open(path, "w", encoding="utf-8") as file:
                file.write("length [m],diameter [m]\n0.05,\n")
                for a, b in zip(length, diameter):
                    file.write(f"{a!r},{b!r}\n")
            plain = identify.geometry(mesh()).report["parameters"]
            with self.assertRaisesRegex(sinew.InputError, "diameter"):
                identify.geometry(identify.Table(path))
            found = identify.geometry(identify.Table(path, drop_incomplete=True)).report["parameters"]
            self.assertEqual(found, plain)


if __name__ == "__main__":
    unittest.main()
