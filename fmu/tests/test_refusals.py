"""Faults are refused with a message, change nothing and never end the importer's process: in calls,
in the unpacked files, and in the program."""

import ctypes
import itertools
import os
import shutil
import subprocess
import sys
import unittest
from ctypes import byref, c_double, c_int, c_size_t, c_uint, c_void_p
from typing import Any, Callable, List, Tuple

from common import ACTUATOR, RIG, ROBOT, ROOT, WALK, WORK, exported, fmu, program
from importer import DISCARD, ERROR, Failed, Fmu

NAN, INFINITE = float("nan"), float("inf")


class Interface(unittest.TestCase):
    def refused(self, cases: "List[Tuple[Callable[[], Any], str]]") -> None:
        for number, (call, words) in enumerate(cases):
            with self.subTest(number=number, words=words):
                with self.assertRaises(Failed) as raised:
                    call()
                self.assertIn(words, str(raised.exception))

    def test_instances_that_cannot_be_made(self) -> None:
        for version in "23":
            f = fmu(RIG, "--fmi", version)
            nowhere = os.path.join(WORK, "nowhere")

            def made(**other: Any) -> Callable[[], Any]:
                return lambda: f.instantiate(**other)

            cases = [
                (made(token="{another}"), "found the token {another}; expected"),
                (made(token=None), "found no "),
                (made(name=None), "found no name"),
                (made(name=""), "found no name"),
                (made(resources=None), "found no place of resources"),
                (made(resources=nowhere), "found no file"),
                (made(resources="https://example.org/x"), "expected a file: URI"),
                (made(resources=f.binary), "found no file"),
            ]
            self.refused(cases)
            if version == "2":
                self.refused([(made(kind=0), "expected co-simulation")])

    def test_an_importer_without_a_log_hears_nothing(self) -> None:
        for version in "23":
            f = fmu(RIG, "--fmi", version)
            with self.assertRaises(Failed):
                f.instantiate(token="x", logger=False)
            slave = f.instantiate(logger=False)
            with self.assertRaises(Failed):
                slave.step(0.0, 0.1)
            slave.free()

    def test_values_and_times(self) -> None:
        for version in "23":
            f = fmu(RIG, "--fmi", version)
            slave = f.instantiate()
            v = f.variables
            length, inlet = v["length"].reference, v["inlet"].reference
            self.refused(
                [
                    (lambda: slave.get("tension"), "an output is read at the wrong time"),
                    (lambda: slave.step(0.0, 0.1), "a step is made at the wrong time"),
                    (lambda: slave.call("ExitInitializationMode"), "at the wrong time"),
                    (lambda: slave.call("Terminate"), "at the wrong time"),
                    (lambda: slave.raw("Get", "Real", [10**6], [0]), "value reference: found 1000000"),
                    (lambda: slave.raw("Get", "Real", [2**32 - 1], [0]), "value reference"),
                    (lambda: slave.raw("Get", "Real", [inlet], [0]), "is a Boolean"),
                    (lambda: slave.raw("Get", "Boolean", [length], [0]), "is a real number"),
                    (lambda: slave.raw("Set", "Integer", [length], [1]), "is a real number"),
                    (lambda: slave.set("tension", 1.0), "is no input and no parameter"),
                    (lambda: slave.set("time", 1.0), "is no input and no parameter"),
                    (lambda: slave.set("length", NAN), "length: found nan; expected 0 to"),
                    (lambda: slave.set("length", INFINITE), "length: found inf"),
                    (lambda: slave.set("length", -0.1), "length: found -0.1; expected 0 to inf"),
                    (lambda: slave.set("count", 0), "count: found 0; expected 1 to 100"),
                    (lambda: slave.set("initial_pressure", 0.0), "initial_pressure: found 0"),
                    (lambda: slave.set("air.polytropic_exponent", 3.0), "found 3; expected 1 to"),
                ]
            )
            slave.initialize()
            self.refused(
                [
                    (lambda: slave.enter(), "at the wrong time"),
                    (lambda: slave.set("count", 2), "a parameter is set at the wrong time"),
                    (lambda: slave.step(0.5, 0.1), "communication point: found 0.5 s; expected 0 s"),
                    (lambda: slave.step(NAN, 0.1), "communication point"),
                    (lambda: slave.step(0.0, 0.0), "step: found 0 s; expected more than 0"),
                    (lambda: slave.step(0.0, -0.1), "step: found -0.1 s"),
                    (lambda: slave.step(0.0, NAN), "step: found nan"),
                    (lambda: slave.step(0.0, INFINITE), "step: found inf"),
                    (lambda: slave.step(0.0, 1e300), "at most 1e+05"),
                ]
            )
            before = slave.get("pressure")
            slave.step(0.0, 0.1)  # refused calls have changed nothing
            self.assertAlmostEqual(slave.get("pressure"), before, delta=1.0)
            slave.call("Terminate")
            self.refused([(lambda: slave.step(0.1, 0.1), "at the wrong time")])
            slave.free()

    def test_parameters_that_do_not_go_together(self) -> None:
        """The message is that of the file's reader."""
        for version in "23":
            slave = fmu(RIG, "--fmi", version).instantiate()
            slave.set("actuator.effectiveness.valid[0]", 5e5)
            slave.set("actuator.effectiveness.valid[1]", 1e5)
            slave.enter()
            self.refused(
                [
                    (lambda: slave.call("ExitInitializationMode"), "no range of pressures"),
                    (lambda: slave.get("tension"), "no range of pressures"),
                ]
            )
            slave.set("actuator.effectiveness.valid[1]", 7e5)
            slave.call("ExitInitializationMode")
            slave.free()

    def test_states(self) -> None:
        for version in "23":
            slave = fmu(RIG, "--fmi", version).instantiate().initialize()
            other = fmu(ROBOT, "--muscle", "hip_flexor", "--fmi", version).instantiate().initialize()
            saved = slave.serialized()
            spoilt = bytearray(saved)
            spoilt[len(saved) // 2] ^= 1

            def back(to: bytes) -> Callable[[], Any]:
                return lambda: slave.back_to(slave.deserialized(to))

            self.refused(
                [
                    (back(saved[:40]), "a saved state is cut off"),
                    (back(saved[:-1]), "cut off or spoilt"),
                    (back(bytes(spoilt)), "cut off or spoilt"),
                    (back(b"nothing of the kind " * 10), "cut off or spoilt"),
                    (back(other.serialized()), "of another FMU or of another version"),
                    (lambda: slave.back_to(c_void_p()), "found no state"),
                ]
            )
            state, size = slave.state(), c_size_t()
            name = "FMUstate" if version == "2" else "FMUState"
            room = ctypes.create_string_buffer(10)
            self.refused(
                [
                    (lambda: slave.call("Get" + name, None), "found no place"),
                    (lambda: slave.call(f"Serialized{name}Size", state, None), "found no place"),
                    (lambda: slave.call(f"Serialize{name}", state, room, c_size_t(10)), "room for 10"),
                ]
            )
            slave.call(f"Serialized{name}Size", state, byref(size))
            self.assertEqual(size.value, len(saved))
            slave.free_state(state)
            slave.call("Free" + name, None)  # freeing null is allowed
            slave.free()
            other.free()

    def test_null_pointers_and_what_is_not_provided(self) -> None:
        slave = fmu(RIG).instantiate().initialize()
        one, vr = c_size_t(1), (c_uint * 1)(1)
        order, no_order, value = (c_int * 1)(2), (c_int * 1)(0), (c_double * 1)(1.0)
        out = (c_uint * 1)(fmu(RIG).variables["tension"].reference)
        self.refused(
            [
                (lambda: slave.call("GetReal", None, one, None), "found no array"),
                (lambda: slave.call("SetReal", vr, one, None), "found no array"),
                (lambda: slave.call("GetString", vr, one, None), "no text variables"),
                (lambda: slave.call("SetRealInputDerivatives", vr, one, no_order, value), "of order 0"),
                (lambda: slave.call("SetRealInputDerivatives", out, one, order, value), "of an input"),
                (lambda: slave.call("GetRealOutputDerivatives", vr, one, order, value), "no deriv"),
                (lambda: slave.call("CancelStep"), "no step can be cancelled"),
                (lambda: slave.call("GetStatus", 0, byref(c_int())), "ever pending"),
                (lambda: slave.call("GetRealStatus", 0, None), "expected fmi2LastSuccessfulTime"),
                (lambda: slave.call("GetRealStatus", 2, None), "found no place for the time"),
                (
                    lambda: slave.call("GetDirectionalDerivative", vr, one, vr, one, value, value),
                    "no directional derivatives",
                ),
            ]
        )
        slave.free()
        entry = slave.lib.fmi2DoStep
        entry.restype = c_int
        self.assertEqual(entry(None, c_double(0), c_double(1), 1), 3)  # no instance: error

    def test_derivative_of_the_length_is_its_rate(self) -> None:
        """An importer may also set derivatives that the model does not use."""
        f = fmu(RIG)
        slave = f.instantiate().initialize()
        vr = (c_uint * 3)(*[f.variables[name].reference for name in ("length", "rate", "length")])
        orders, values = (c_int * 3)(1, 1, 2), (c_double * 3)(-0.2, 5.0, 7.0)
        slave.call("SetRealInputDerivatives", vr, c_size_t(3), orders, values)
        self.assertEqual(slave.get("rate"), -0.2)
        slave.free()

    def test_lengths_that_no_muscle_has_are_refused_before_a_step(self) -> None:
        """Messages name the value and its range; then the run continues."""
        for version in "23":
            muscle = fmu(RIG, "--fmi", version).instantiate().initialize()
            muscle.set("rate", 100.0)
            before = muscle.get("pressure")
            with self.assertRaises(Failed) as raised:
                muscle.step(0.0, 0.01)
            self.assertEqual(raised.exception.status, DISCARD)
            self.assertIn("length + rate x step: found 1.08", str(raised.exception))
            muscle.set("rate", 0.0)
            muscle.step(0.0, 0.01)
            self.assertAlmostEqual(muscle.get("pressure"), before, delta=1.0)
            muscle.free()
            joint = fmu(ROBOT, "--joint", "hip", "--fmi", version).instantiate()
            joint.set("hip.angle", 50.0)  # a value in degrees
            with self.assertRaises(Failed) as raised:
                joint.initialize()
            self.assertIn("which are in rad", str(raised.exception))
            joint.free()
        tube = fmu(ACTUATOR).instantiate().initialize(length=1.0)
        with self.assertRaises(Failed) as raised:
            tube.get("tension")
        self.assertIn("length: found 1 m; expected more than 0 m", str(raised.exception))
        tube.free()

    def test_what_an_importer_may_do_otherwise_is_discarded(self) -> None:
        for version in "23":
            slave = fmu(RIG, "--fmi", version).instantiate().initialize()
            with self.assertRaises(Failed) as raised:
                slave.set("rate", 200.0)
            self.assertEqual(raised.exception.status, DISCARD)
            with self.assertRaises(Failed) as raised:
                slave.step(0.0, -1.0)
            self.assertEqual(raised.exception.status, DISCARD)
            with self.assertRaises(Failed) as raised:
                slave.step(1.0, 0.1)
            self.assertEqual(raised.exception.status, ERROR)
            slave.free()

    def test_a_plan_comes_to_its_end(self) -> None:
        """A step ends where the plan ends and reports it; the next step is discarded."""
        for version in "23":
            f = fmu(f"{ROOT}/experiments/one-joint.toml", "--fmi", version)
            end = f.root.find("DefaultExperiment")
            assert end is not None
            stop = float(end.get("stopTime", "0"))
            slave = f.instantiate().initialize()
            slave.step(0.0, stop - 0.5)
            state = slave.state()
            if version == "3":
                self.assertTrue(slave.step(stop - 0.5, 1.0))
            else:
                with self.assertRaises(Failed) as raised:
                    slave.step(stop - 0.5, 1.0)
                self.assertEqual(raised.exception.status, DISCARD)
                ended, last = c_int(), c_double()
                slave.call("GetBooleanStatus", 3, byref(ended))
                slave.call("GetRealStatus", 2, byref(last))
                self.assertEqual((ended.value, last.value), (1, slave.get("time")))
            reached = slave.get("time")  # the last phase is over a little before the run's last tick
            self.assertTrue(stop - 0.02 < reached <= stop)
            with self.assertRaises(Failed) as raised:
                slave.step(reached, 1.0)
            self.assertEqual(raised.exception.status, DISCARD)
            slave.back_to(state)  # before the end, where it can continue
            slave.step(stop - 0.5, 0.25)
            slave.free_state(state)
            slave.free()

    def test_a_step_past_a_defined_stop_time_is_an_error(self) -> None:
        """For tube, muscle, joint and machine, steps up to the stop time itself are accepted."""
        for words, version in itertools.product(
            ((ACTUATOR,), (RIG,), (ROBOT, "--joint", "hip"), (WALK,)), "23"
        ):
            with self.subTest(words=words, version=version):
                slave = fmu(*words, "--fmi", version).instantiate().initialize(start=2.0, stop=2.1)
                for k in range(10):
                    slave.step(2.0 + k * 0.01, 0.01)
                saved = slave.serialized()
                other = fmu(*words, "--fmi", version).instantiate()  # the state includes the stop time
                other.back_to(other.deserialized(saved))
                for one in (slave, other):
                    with self.assertRaises(Failed) as raised:
                        one.step(2.1, 0.001)
                    self.assertEqual(raised.exception.status, ERROR)
                    self.assertIn("expected at most 2.1 s, the stop time", str(raised.exception))
                other.free()
                slave.call("Reset")
                with self.assertRaises(Failed):
                    slave.enter(start=1.0, stop=0.5)
                slave.initialize()  # without a stop time
                slave.step(0.0, 0.3)
                slave.free()

    def test_a_long_step_is_a_plan_to_its_end(self) -> None:
        for version in "23":
            f = fmu(f"{ROOT}/experiments/one-joint.toml", "--fmi", version)
            slave = f.instantiate().initialize()
            try:
                slave.step(0.0, 9e4)
            except Failed as failed:
                self.assertEqual(failed.status, DISCARD)
            end = f.root.find("DefaultExperiment")
            assert end is not None
            self.assertAlmostEqual(slave.get("time"), float(end.get("stopTime", "0")), delta=0.02)
            slave.free()

    def test_a_machine_that_fails_reports_why(self) -> None:
        """The supervisor trips: the FMU returns an error with the run's message at each further call."""
        path = f"{ROOT}/experiments/faults/valve-stuck-open.toml"
        slave = fmu(path).instantiate().initialize()
        at, status = 0.0, 0
        while at < 60.0 and status == 0:
            try:
                slave.step(at, 0.05)
            except Failed as failed:
                status = failed.status
                self.assertGreater(len(str(failed)), 20)
            at += 0.05
        self.assertNotEqual(status, 0)
        slave.free()


class Files(unittest.TestCase):
    """An unpacked FMU whose files were changed: refused at once, with the file's name."""

    def changed(self, words: "Tuple[str, ...]", name: str, change: Callable[[bytes], bytes]) -> str:
        f = Fmu(exported(*words))
        path = os.path.join(f.folder, "resources", name)
        with open(path, "rb") as file:
            text = file.read()
        with open(path, "wb") as file:
            file.write(change(text))
        with self.assertRaises(Failed) as raised:
            f.instantiate()
        return str(raised.exception)

    def test_that_are_damaged(self) -> None:
        cases = [
            (lambda t: t.replace(b"turns = 2.3125", b"turns = 2.4"), "was changed by hand"),
            # Cut within a key, and between two lines.
            (lambda t: t[: t.index(b" = ", len(t) // 2)], "the file is damaged"),
            (lambda t: t[: t.index(b"\n", len(t) // 2) + 1], "the file is cut off"),
            (lambda t: b"", "is empty"),
            (lambda t: b"\x00\xff" * 100, "expected \"sinew fmu 1\""),
            (lambda t: t.replace(b"fmu 1", b"fmu 9", 1), "expected \"sinew fmu 1\""),
            (lambda t: t.replace(b" = ", b" ", 1), "is no \"key = value\""),
            (lambda t: t + b"more = 1\n", "the file is damaged"),
        ]
        for number, (change, words) in enumerate(cases):
            with self.subTest(number=number):
                self.assertIn(words, self.changed((RIG,), "model.txt", change))
        said = self.changed((WALK,), "machine.toml", lambda t: t.replace(b"hip", b"hop"))
        self.assertIn("machine.toml: the file is cut off or was changed", said)

    def test_that_are_gone(self) -> None:
        f = Fmu(exported(RIG))
        shutil.rmtree(os.path.join(f.folder, "resources"))
        with self.assertRaises(Failed) as raised:
            f.instantiate()
        self.assertIn("found no file", str(raised.exception))


class Killed(unittest.TestCase):
    def test_an_importer_may_unload_and_load_it(self) -> None:
        script = (
            "import sys, _ctypes; from importer import Fmu\n"
            "for _ in range(20):\n"
            "    f = Fmu(sys.argv[1]); s = f.instantiate().initialize(); s.step(0.0, 0.1); s.free()\n"
            "    _ctypes.dlclose(f.library._handle)\n"
            "print('unloaded')"
        )
        done = subprocess.run(
            [sys.executable, "-c", script, exported(RIG)], capture_output=True, text=True,
            cwd=f"{ROOT}/fmu/tests", check=False,
        )  # fmt: skip
        self.assertEqual(done.stdout.strip(), "unloaded", done.stderr)
