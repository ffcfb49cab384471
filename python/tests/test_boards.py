"""Runs on a board: an emulated one gives the simulation's bits; missing data are reported."""

import os
import shutil
import tempfile
import unittest
from typing import Any

import sinew
from common import AIR, PROGRAM, WALK, Refusals

IMAGE = os.path.join(
    os.path.dirname(PROGRAM), "../tests/firmware/images/firmware/lock-step.elf"
)
MISSING = not os.path.exists(IMAGE) or shutil.which("qemu-system-arm") is None


@unittest.skipIf(MISSING, "needs qemu-system-arm, and the emulated board's program of tests/firmware")
class LockStep(unittest.TestCase):
    def test_the_board_gives_the_simulations_bits(self) -> None:
        simulated = sinew.run(AIR)
        board = sinew.run(AIR, port=f"lock-step:{IMAGE}")
        self.assertEqual(simulated.board, "")
        self.assertIn("lock-step", board.board)
        names = [c.name for c in simulated.channels if not c.name.startswith("/true/")]
        self.assertGreater(len(names), 10)  # a board does not have the rest
        for name in names:
            self.assertEqual(simulated[name].tobytes(), board[name].tobytes(), name)
        with tempfile.TemporaryDirectory() as folder:
            kept = sinew.run(AIR, folder=folder + "/run", port=f"lock-step:{IMAGE}", report=False)
            self.assertEqual(kept.board, board.board)
            again = sinew.read_run(folder + "/run")
        angle = "/joint/hip/angle"
        self.assertEqual(again[angle].tobytes(), simulated[angle].tobytes())


class Wrong(Refusals):
    def test_missing_files_are_reported(self) -> None:
        run: Any = sinew.run
        rig = sinew.shipped("experiments/rig/pwm-50hz-1lb.toml")
        self.refused(
            [
                (lambda: run(WALK, port="foo:x"), ValueError, "port: found \"foo:x\"; expected simulated"),
                (lambda: run(WALK, port="serial:"), ValueError, "port: found"),
                (lambda: run(WALK, port="serial:/dev/nowhere"), sinew.BoardError, "/dev/nowhere"),
                (lambda: run(WALK, port="serial:/dev/null@1"), sinew.BoardError, "1 bits/s"),
                (lambda: run(WALK, port="serial:/dev/null"), sinew.BoardError, "/dev/null"),
                (lambda: run(WALK, port="lock-step:no.elf"), sinew.BoardError, "no such program"),
                (lambda: run(WALK, port="emulated:no.elf"), sinew.BoardError, "no such program"),
                (lambda: run(WALK, port=f"lock-step:{WALK}"), sinew.BoardError, ""),
                (lambda: run(WALK, port=3), TypeError, "incompatible"),
                (lambda: run(rig, port="serial:/dev/nowhere"), sinew.InputError, "expected at least one"),
            ]
        )
        self.assertEqual(run(AIR, port="simulated").board, "")


if __name__ == "__main__":
    unittest.main()
