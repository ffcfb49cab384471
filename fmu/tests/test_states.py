"""A kept, saved, reset or interleaved state continues with equal bits, also in several threads."""

import os
import pickle
import shutil
import subprocess
import sys
import threading
import unittest
from typing import Iterator, List, Tuple

from common import RIG, ROBOT, ROOT, WALK, exported, fmu
from importer import Fmu, Slave


class States(unittest.TestCase):
    """Restart, saved states, several instances and threads: for a muscle and a machine."""

    CASES = [
        ((RIG,), ["tension", "pressure"], 0.5),
        ((RIG, "--fmi", "3"), ["tension", "pressure"], 0.5),
        ((ROBOT, "--joint", "knee"), ["knee.torque"], 0.5),
        ((WALK,), ["joint.hip.angle", "true.trolley.position"], 2.0),
        ((WALK, "--fmi", "3"), ["joint.hip.angle", "true.trolley.position"], 2.0),
    ]

    names: List[str]

    def drive(self, slave: Slave, begin: int, end: int) -> "List[List[float]]":
        out = []
        for k in range(begin, end):
            for name, v in slave.fmu.variables.items():
                if v.causality == "input" and v.kind == "Boolean":
                    slave.set(name, (k // 7) % 3 == 0)
            slave.step(k * 0.0065, 0.0065)
            out.append(slave.get_reals(self.names))
        return out

    def each(self) -> "Iterator[Tuple[Fmu, int]]":
        for words, self.names, until in self.CASES:
            yield fmu(*words), int(until / 0.0065)

    def test_a_state_is_gone_back_to(self) -> None:
        for f, count in self.each():
            slave = f.instantiate().initialize()
            self.drive(slave, 0, count // 2)
            state = slave.state()
            first = self.drive(slave, count // 2, count)
            for _ in range(2):
                slave.back_to(state)
                self.assertEqual(self.drive(slave, count // 2, count), first)
            slave.free_state(state)
            slave.free()

    def test_a_saved_state_goes_on_in_another_process(self) -> None:
        for (words, self.names, until), number in zip(self.CASES, range(9)):
            count = int(until / 0.0065)
            slave = fmu(*words).instantiate().initialize()
            self.drive(slave, 0, count // 2)
            saved = slave.serialized()
            here = self.drive(slave, count // 2, count)
            slave.free()
            script = (
                "import sys, pickle; from test_states import States; from importer import Fmu\n"
                "path, names, saved, begin, end = pickle.load(sys.stdin.buffer)\n"
                "test = States('test_a_state_is_gone_back_to'); test.names = names\n"
                "slave = Fmu(path).instantiate(); slave.back_to(slave.deserialized(saved))\n"
                "pickle.dump(test.drive(slave, begin, end), sys.stdout.buffer)"
            )
            asked = pickle.dumps((exported(*words), self.names, saved, count // 2, count))
            done = subprocess.run(
                [sys.executable, "-c", script], input=asked, capture_output=True, check=False,
                cwd=f"{ROOT}/fmu/tests",
            )  # fmt: skip
            self.assertEqual(done.returncode, 0, done.stderr.decode())
            self.assertEqual(pickle.loads(done.stdout), here)

    def test_equal_states_are_equal_bytes(self) -> None:
        """States of muscles and joints contain no uninitialized memory, which is filled in between."""
        for f, count in self.each():
            if f.identifier.startswith("walk"):
                continue  # a machine's state has padding between its controllers' numbers
            saved = []
            for k in range(2):
                filling = [bytes([k + 65]) * 40000 for _ in range(200)]
                del filling
                slave = f.instantiate().initialize()
                self.drive(slave, 0, count // 4)
                saved.append(slave.serialized())
                slave.free()
            self.assertEqual(saved[0], saved[1])

    def test_goes_on_without_its_files(self) -> None:
        """An importer may remove the unpacked files once an instance exists."""
        for words, self.names, _ in self.CASES:
            f = Fmu(exported(*words))
            slave = f.instantiate()
            shutil.rmtree(os.path.join(f.folder, "resources"))
            slave.initialize()
            first = self.drive(slave, 0, 20)
            slave.call("Terminate")
            slave.call("Reset")
            slave.initialize()
            self.assertEqual(self.drive(slave, 0, 20), first)
            slave.free()

    def test_reset_begins_again(self) -> None:
        for f, count in self.each():
            slave = f.instantiate().initialize()
            first = self.drive(slave, 0, count // 2)
            slave.call("Terminate")
            slave.call("Reset")
            slave.initialize()
            self.assertEqual(self.drive(slave, 0, count // 2), first)
            slave.free()

    def test_instances_know_nothing_of_each_other(self) -> None:
        for f, count in self.each():
            alone = f.instantiate().initialize()
            expected = self.drive(alone, 0, count // 2)
            alone.free()
            three = [f.instantiate(f"slave {k}").initialize() for k in range(3)]
            for k in range(count // 2):
                for slave in three:
                    self.assertEqual(self.drive(slave, k, k + 1), expected[k : k + 1])
            for slave in three:
                slave.free()

    def test_threads_with_an_instance_each(self) -> None:
        for f, count in self.each():
            results: "List[object]" = [None, None]

            def work(k: int) -> None:
                slave = f.instantiate().initialize()
                results[k] = self.drive(slave, 0, count // 2)
                slave.free()

            threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertIsNotNone(results[0])
            self.assertEqual(results[0], results[1])

    def test_memory_does_not_grow(self) -> None:
        """Memory does not grow with resets, kept states, and instances created and freed."""

        def resident() -> int:  # [KB]
            with open("/proc/self/status", encoding="utf-8") as file:
                return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))

        for words, rounds in (((RIG,), 3000), ((WALK,), 60)):
            f, first = fmu(*words), 0
            for k in range(2 * rounds):
                slave = f.instantiate().initialize()
                slave.step(0.0, 0.01)
                slave.free_state(slave.deserialized(slave.serialized()))
                slave.call("Terminate")
                slave.call("Reset")
                slave.initialize()
                slave.free()
                if k == rounds:
                    first = resident()
            self.assertLess(resident() - first, 1000)
