"""A simulation gives the same bits if it is split, copied, pickled, forked or observed."""

import copy
import multiprocessing
import os
import pickle
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from typing import Any, List

import numpy

import sinew
import sinew.gym
from common import AIR, WALK, Refusals, program


def values(simulation: sinew.Simulation) -> List[float]:
    return [simulation.read(i) for i in range(len(simulation.channels))]


def end_of(saved: bytes) -> List[float]:
    """Continue a saved simulation in another process."""
    simulation = pickle.loads(saved)
    simulation.advance(1.0)
    return values(simulation)


class Simulation(unittest.TestCase):
    def test_is_the_programs_run_to_the_last_bit(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            program("run", WALK, "-o", folder + "/run", "--quiet", "--no-report")
            kept = sinew.read_run(folder + "/run")
        here = sinew.run(WALK)
        self.assertEqual([c.name for c in here.channels], [c.name for c in kept.channels])
        for channel in here.channels:
            for mine, theirs in (
                (here[channel.name], kept[channel.name]),
                (here.time(channel.name), kept.time(channel.name)),
            ):
                self.assertEqual(mine.tobytes(), theirs.tobytes(), channel.name)
        self.assertEqual(here.summary, kept.summary)
        self.assertTrue(all(v["is"] for v in here.verdicts))

    def test_a_stand_is_stepped_as_a_robot_is(self) -> None:
        stand = sinew.shipped("experiments/rig/feedback.toml")
        whole = sinew.run(stand, {"duration": 2.0})["/true/stand/length"]
        here = sinew.Simulation(stand)
        self.assertEqual(here.read("/true/stand/length"), whole[0])
        here.advance(1.0)
        saved = here.save()
        here.advance(1.0)
        self.assertEqual(here.read("/true/stand/length"), whole[-1])
        here.restore(saved)
        self.assertEqual(here.read("/true/stand/length"), whole[1000])
        self.assertEqual(list(here.settings), [])

    def test_cuts_saves_and_copies_leave_no_trace(self) -> None:
        dice = random.Random(5)
        straight = sinew.Simulation(WALK)
        straight.advance(4.0)
        cut = sinew.Simulation(WALK)
        while cut.tick < 40000:
            cut.advance_to(min(40000, cut.tick + dice.randint(0, 3000)))
            values(cut)
            way = dice.randint(0, 4)
            if way == 0:
                saved = cut.save()
                cut.advance(0.3)
                cut.restore(saved)
            elif way == 1:
                cut = copy.copy(cut)
            elif way == 2:
                cut = copy.deepcopy(cut)
            elif way == 3:
                cut = pickle.loads(pickle.dumps(cut))
        self.assertEqual(values(cut), values(straight))

    def test_goes_on_in_other_processes(self) -> None:
        here = sinew.Simulation(WALK, {"control.stiffness.hip": 2.5})
        here.advance(1.7)
        here.change("control.stiffness.knee", 1.0)
        saved = pickle.dumps(here)
        here.advance(1.0)
        for method in ("fork", "spawn"):
            with multiprocessing.get_context(method).Pool(2) as pool:
                for there in pool.map(end_of, [saved, saved]):
                    self.assertEqual(there, values(here), method)

    def test_is_as_before_after_a_fork(self) -> None:
        here = sinew.Simulation(WALK)
        here.advance(1.0)
        child = os.fork()
        if child == 0:
            here.advance(1.0)
            os._exit(0 if here.time == 2.0 else 1)
        _, status = os.waitpid(child, 0)
        self.assertEqual(os.waitstatus_to_exitcode(status), 0)
        self.assertEqual(here.time, 1.0)

    def test_change_is_obeyed_until_it_is_released(self) -> None:
        leg = sinew.Simulation(AIR)
        leg.advance(1.0)
        plan = leg.setting("control.stiffness.hip")
        leg.change("control.stiffness.hip", 1.25)
        leg.advance(0.02)
        self.assertEqual(leg.setting("control.stiffness.hip"), 1.25)
        self.assertEqual(leg.read("/desired/joint/hip/stiffness"), 1.25)
        leg.release("control.stiffness.hip")
        leg.advance(0.02)
        self.assertEqual(leg.setting("control.stiffness.hip"), plan)

    def test_ends_with_its_plan(self) -> None:
        leg = sinew.Simulation(AIR, {"sequence.repeat": 1})
        leg.advance(1e6)
        self.assertTrue(leg.ended)
        self.assertAlmostEqual(leg.time, leg.duration, delta=0.011)
        self.assertAlmostEqual(leg.experiment.duration, leg.duration, 9)
        ended = leg.time
        leg.advance(1.0)
        self.assertEqual(leg.time, ended)

    def test_one_that_fails_reports_the_cause(self) -> None:
        leg = sinew.Simulation(WALK, {"muscle.knee_extensor.bladder_stiffness": 1e8})
        with self.assertRaises(sinew.RunError) as raised:
            leg.advance(20.0)
        self.assertIn("plant_steps.body", str(raised.exception))
        with self.assertRaises(sinew.RunError):
            sinew.run(WALK, {"muscle.knee_extensor.bladder_stiffness": 1e8})


class Threads(unittest.TestCase):
    def test_two_at_one_simulation_are_distinguished(self) -> None:
        leg = sinew.Simulation(WALK, {"sequence.repeat": 30000})
        told: List[str] = []

        def advance() -> None:
            try:
                leg.advance(2000.0)
            except RuntimeError as error:
                told.append(str(error))

        worker = threading.Thread(target=advance)
        worker.start()
        deadline = time.monotonic() + 20
        while not told and worker.is_alive() and time.monotonic() < deadline:
            try:
                leg.read("/joint/hip/angle")
            except RuntimeError as error:
                told.append(str(error))
        worker.join()
        self.assertIn("try a copy for each thread", told[0])
        leg.advance(0.01)  # and nothing is lost

    def test_others_go_on_while_one_runs(self) -> None:
        leg = sinew.Simulation(WALK, {"sequence.repeat": 30000})
        worker = threading.Thread(target=lambda: leg.advance(3000.0))
        worker.start()
        seen_at_it = 0
        while worker.is_alive():
            try:
                leg.read("/joint/hip/angle")
            except RuntimeError:  # the other thread uses it, and this one continues
                seen_at_it += 1
        worker.join()
        self.assertGreater(seen_at_it, 10)

    def test_ctrl_c_ends_what_takes_long(self) -> None:
        pull = f"sinew.DrivenMuscle({WALK!r}, 'hip_flexor').follow(10.0, [0.08] * 100000)"
        for work in ("leg.advance(1e5)", "sinew.run(leg.experiment)", pull):
            code = (
                "import signal, sinew, sys\n"
                # What is started in the background by a shell ignores Ctrl-C.
                "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
                f"leg = sinew.Simulation({WALK!r}, {{'sequence.repeat': 30000}})\n"
                "print('begun', flush=True)\n"
                f"try:\n    {work}\nexcept KeyboardInterrupt:\n    sys.exit(7)\n"
            )
            child = subprocess.Popen(
                [sys.executable, "-c", code], stdout=subprocess.PIPE, text=True
            )
            assert child.stdout is not None
            self.assertEqual(child.stdout.readline(), "begun\n")
            time.sleep(0.3)
            child.send_signal(signal.SIGINT)
            self.assertEqual(child.wait(20), 7, work)
            child.stdout.close()

    def test_one_that_is_killed_leaves_nothing(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            code = (
                f"import sinew\nprint('begun', flush=True)\n"
                f"sinew.run({WALK!r}, {{'sequence.repeat': 3000}}, folder={folder!r} + '/run')\n"
            )
            child = subprocess.Popen(
                [sys.executable, "-c", code], stdout=subprocess.PIPE, text=True
            )
            assert child.stdout is not None
            child.stdout.readline()
            time.sleep(0.3)
            child.kill()
            child.wait()
            child.stdout.close()
            again = sinew.run(WALK, {"sequence.repeat": 1}, folder=folder + "/run", force=True)
            self.assertTrue(sinew.read_run(again.folder).complete)


class Loop(unittest.TestCase):
    def test_is_change_advance_and_read(self) -> None:
        by_loop, by_hand = sinew.Simulation(WALK), sinew.Simulation(WALK)
        keys = ["control.stiffness.hip", "control.angle.knee"]
        names = ["/joint/hip/angle", "/true/trolley/position"]
        loop = sinew.Loop(by_loop, keys, names)
        dice = numpy.random.default_rng(3)
        for _ in range(200):
            wanted = dice.uniform([1, 4], [5, 5.5])
            wanted[1] = numpy.nan if dice.uniform() < 0.5 else wanted[1]
            got = loop.step(wanted)
            for key, value in zip(keys, wanted):
                if not numpy.isnan(value):
                    by_hand.change(key, value)
            by_hand.advance(0.01)
            self.assertEqual(list(got), [by_hand.read(n) for n in names])
        self.assertEqual(list(loop.read()), list(got))
        self.assertEqual(values(by_loop), values(by_hand))

    def test_many_go_as_one_alone(self) -> None:
        def made() -> sinew.Loop:
            return sinew.Loop(sinew.Simulation(WALK), ["control.stiffness.hip"], ["/joint/hip/angle"])

        together, alone = [made() for _ in range(3)], [made() for _ in range(3)]
        for k in range(60):
            wanted = numpy.array([[1.0 + k % 3], [2.0], [numpy.nan]])
            got = sinew.step_all(together, wanted)
            for row, loop, one in zip(got, alone, wanted):
                self.assertEqual(list(row), list(loop.step(one)))


class Wrong(Refusals):
    def test_what_no_run_in_a_folder_accepts_is_refused_everywhere(self) -> None:
        for wrong, words in (
            ("phase.propulsion.y.polynomial[0]=-16 in", "a path out of reach"),
            ('log.channels=["/jiont/*"]', 'try "/joint/*"'),
        ):
            with tempfile.TemporaryDirectory() as folder:
                self.refused(
                    [
                        (lambda: sinew.run(WALK, [wrong], folder=folder), sinew.InputError, words),
                        (lambda: sinew.run(WALK, [wrong]), sinew.InputError, words),
                        (lambda: sinew.Simulation(WALK, [wrong]), sinew.InputError, words),
                    ]
                )
        many = sinew.gym.VectorEnv(
            "walk", 2, parameters=["phase.propulsion.y.polynomial[0]"], values=[-16 * 0.0254]
        )
        with self.assertRaisesRegex(sinew.InputError, "a path out of reach"):
            many.reset(seed=1)

    def test_inputs_are_refused_in_words(self) -> None:
        leg = sinew.Simulation(WALK)
        other = sinew.Simulation(AIR)
        loop = sinew.Loop(leg, ["control.stiffness.hip"], ["/joint/hip/angle"])
        nothing: Any = None
        hip = "control.stiffness.hip"
        self.refused(
            [
                (lambda: sinew.Simulation("nowhere.toml"), sinew.InputError, "nowhere.toml"),
                (lambda: sinew.Simulation(nothing), TypeError, "expected a path, or an Experiment"),
                (lambda: sinew.Simulation(3), TypeError, "expected a path, or an Experiment"),  # type: ignore[arg-type]
                (lambda: leg.advance(-1.0), ValueError, "found -1; expected a time from 0"),
                (lambda: leg.advance(float("nan")), ValueError, "found nan"),
                (lambda: leg.advance(float("inf")), ValueError, "found inf"),
                (lambda: leg.advance("1 s"), TypeError, "advance"),  # type: ignore[arg-type]
                (lambda: leg.advance_to(-5), ValueError, "where the simulation stands"),
                (lambda: leg.read("/joint/hpi/angle"), ValueError, "/joint/hpi/angle"),
                (lambda: leg.read(10**6), IndexError, "expected 0 to"),
                (lambda: leg.read(-1), IndexError, "found -1"),
                (lambda: leg.read(10**30), IndexError, "expected 0 to"),
                (lambda: leg.read(1.5), TypeError, "channel: found 1.5"),  # type: ignore[arg-type]
                (lambda: leg.read(None), TypeError, "channel: found None"),  # type: ignore[arg-type]
                (lambda: leg.change(hip, -1.0), ValueError, "expected 0 to 1e6 N m/rad"),
                (lambda: leg.change(hip, float("nan")), ValueError, "N m/rad"),
                (lambda: leg.change("control.stiffness.toe", 1.0), ValueError, "expected one of"),
                (lambda: leg.change(hip, 1.0, "left"), ValueError, "one leg alone"),
                (lambda: leg.restore(b"abc"), ValueError, "too few bytes"),
                (lambda: leg.restore(leg.save()[:-9]), ValueError, "cut off or spoilt"),
                (lambda: leg.restore(other.save()), ValueError, "another experiment"),
                (lambda: loop.step([1.0, 2.0]), ValueError, "shape (2,); expected (1,)"),
                (lambda: loop.step(["a"]), TypeError, "values: found ['a']"),
                (lambda: loop.step([-1.0]), ValueError, "expected 0 to 1e6"),
                (lambda: sinew.Loop(nothing, [], []), TypeError, "Simulation"),
                (lambda: sinew.Loop(leg, [], [], 0), ValueError, "a tick, 0.1 ms, at least"),
                (lambda: sinew.Loop(leg, ["x"], []), ValueError, "expected one of control.angle"),
                (lambda: sinew.Loop(leg, [], ["/x"]), ValueError, "/x"),
                (lambda: sinew.step_all([], [[1.0]]), ValueError, "expected one at least"),
                (lambda: pickle.loads(pickle.dumps(leg)[:-20]), Exception, ""),
            ]
        )


if __name__ == "__main__":
    unittest.main()
