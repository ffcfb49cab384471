"""A muscle in a user's loop: the lesson's numbers, saved states, and refusals."""

import copy
import gc
import os
import pickle
import threading
import unittest
from typing import Any, List, Tuple

import numpy

import sinew
from common import VALVES, WALK, Refusals

LESSON = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/08-your-own-loop")
RIG = os.path.join(LESSON, "muscle.toml")
ROBOT = sinew.shipped("robots/leg-with-hoses/robot.toml")
STEP = 1e-3


def pulsed(muscle: sinew.DrivenMuscle, begin: int, end: int) -> List[Tuple[float, float]]:
    """Return tension and pressure over steps with pulses, at a length that shrinks."""
    seen = []
    for k in range(begin, end):
        muscle.inlet(k % 50 < 20)
        muscle.exhaust(k % 90 > 70)
        muscle.advance(STEP, 0.0864 - 1e-5 * (k % 300))
        seen.append((muscle.tension, muscle.pressure))
    return seen


class Lesson(unittest.TestCase):
    def test_a_lever_moves_as_in_c(self) -> None:
        """The loop of the lesson's main.cpp gives its expected.txt."""
        step, arm, inertia, weight, damping, rest = 1e-4, 0.02, 0.02, 1.2, 0.3, 0.0864
        pull = sinew.DrivenMuscle(RIG, length=rest)
        angle = rate = 0.0
        rows = []
        for k in range(8001):
            pull.inlet(angle < 0.4363 and k % 250 < 60)
            if k % 1000 == 0:
                gauge = (pull.pressure - pull.atmosphere) / 1e3
                degrees = angle * 57.29577951
                rows.append([1e3 * pull.time, degrees, gauge, pull.tension, 1e6 * pull.air_mass])
            rate += step * (arm * pull.tension - weight - damping * rate) / inertia
            if angle <= 0 and rate < 0:
                rate = 0.0
            angle += step * rate
            pull.advance(step, rest - arm * angle)
        expected = numpy.loadtxt(os.path.join(LESSON, "expected.txt"), skiprows=1)
        printed = numpy.array([1, 1e-3, 1e-2, 1e-3, 1e-3])  # the last digit of each column
        self.assertTrue(bool((numpy.abs(numpy.array(rows) - expected) <= 1.5 * printed).all()))


class Muscle(unittest.TestCase):
    def test_following_equals_single_steps(self) -> None:
        one, other = sinew.DrivenMuscle(RIG), sinew.DrivenMuscle(RIG)
        seen = pulsed(one, 0, 700)
        k = numpy.arange(700)
        tension, pressure = other.follow(
            STEP, 0.0864 - 1e-5 * (k % 300), inlet=k % 50 < 20, exhaust=k % 90 > 70
        )
        self.assertEqual(list(zip(tension, pressure)), seen)
        self.assertEqual((one.time, one.air_mass), (other.time, other.air_mass))
        held, _ = other.follow(STEP, [0.08] * 5, inlet=True)
        self.assertEqual(held.shape, (5,))

    def test_is_the_files_muscle(self) -> None:
        hip = sinew.DrivenMuscle(ROBOT, "hip_flexor")
        self.assertEqual(hip.name, "hip_flexor")
        self.assertEqual(hip.length, sinew.Robot(ROBOT).muscle.hip_flexor.mount_length)
        self.assertEqual(hip.pressure, hip.atmosphere)
        self.assertEqual((hip.time, hip.failed), (0.0, False))
        three = sinew.DrivenMuscle(ROBOT, "hip_flexor", sets={"muscle.hip_flexor.count": 3})
        for muscle in (hip, three):
            muscle.inlet(True)
            muscle.advance(0.5, muscle.length)
        self.assertAlmostEqual(three.tension / hip.tension, 1.5, 2)
        law = sinew.Actuator(sinew.shipped("robots/leg/actuator.toml"))
        at_rest = 2 * law.tension(hip.length, hip.pressure - hip.atmosphere)
        self.assertLess(abs(hip.tension / at_rest - 1), 0.1)  # each muscle has its own bladder
        walking = sinew.DrivenMuscle(WALK, "knee_flexor", pressure=3e5)
        self.assertAlmostEqual(walking.pressure, 3e5, 3)

    def test_air_is_neither_made_nor_lost(self) -> None:
        muscle = sinew.DrivenMuscle(RIG)
        begin = muscle.air_mass
        pulsed(muscle, 0, 500)
        passed = muscle.account
        self.assertGreater(passed["in"], passed["out"])
        self.assertGreater(passed["out"], 1e-5)
        self.assertEqual(passed["leak"], 0)
        self.assertLess(passed["mass"], muscle.air_mass)
        left = muscle.air_mass - begin - passed["in"] + passed["out"]
        self.assertLess(abs(left), 1e-12 * passed["in"])
        self.assertGreater(muscle.friction, 0)

    def test_a_regulator_holds_its_set_point(self) -> None:
        regulated = sinew.shipped("robots/leg-with-regulators/robot.toml")
        muscle = sinew.DrivenMuscle(regulated, "hip_flexor")
        with self.assertRaisesRegex(ValueError, "inlet: found a muscle with a pressure regulator"):
            muscle.inlet(True)
        muscle.set_point(0.6)
        muscle.advance(2.0, muscle.length)
        expected = 0.6 * sinew.quantity("100 psi diff", "Pa diff")  # share of its range
        self.assertAlmostEqual((muscle.pressure - muscle.atmosphere) / expected, 1, 3)


class Save(unittest.TestCase):
    def test_goes_on_with_the_same_bits(self) -> None:
        for muscle in (sinew.DrivenMuscle(RIG), sinew.DrivenMuscle(ROBOT, "knee_extensor", 0.0864)):
            pulsed(muscle, 0, 123)  # while a valve is moving
            saved = muscle.save()
            others = [
                copy.copy(muscle),
                copy.deepcopy(muscle),
                muscle.copy(),
                pickle.loads(pickle.dumps(muscle)),
            ]
            seen = pulsed(muscle, 123, 400)
            for other in others:
                self.assertEqual(other.name, muscle.name)
                self.assertEqual(pulsed(other, 123, 400), seen)
            muscle.restore(saved)
            self.assertEqual(pulsed(muscle, 123, 400), seen)

    def test_outlives_its_file(self) -> None:
        made = pickle.dumps(sinew.DrivenMuscle(ROBOT, "hip_flexor", sets={"muscle.hip_flexor.count": 4}))
        again = pickle.loads(made)
        del made
        gc.collect()
        again.inlet(True)
        again.advance(0.2, again.length)
        self.assertGreater(again.tension, 0)

    def test_one_thread_at_a_time(self) -> None:
        muscle = sinew.DrivenMuscle(RIG)
        worker = threading.Thread(target=lambda: muscle.follow(1.0, [0.08] * 400))
        worker.start()
        told: "List[str]" = []
        while worker.is_alive() and not told:
            try:
                muscle.tension
            except RuntimeError as error:
                told.append(str(error))
        worker.join()
        self.assertIn("muscle: another thread", told[0])
        self.assertEqual(muscle.time, 400)


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        made: Any = sinew.DrivenMuscle
        muscle: Any = made(RIG)
        nan = float("nan")
        saved = muscle.save()
        tight = {"element.external_volume": 0.0}
        other = made(RIG, sets={"element.count": 2})
        self.refused(
            [
                (lambda: made("nowhere.toml"), sinew.InputError, "nowhere.toml"),
                (lambda: made(VALVES), sinew.InputError, "a rig, robot or experiment file"),
                (lambda: made(ROBOT), sinew.InputError, "hip_flexor"),
                (lambda: made(ROBOT, "hip"), sinew.InputError, "found \"hip\""),
                (lambda: made(RIG, "hip"), sinew.InputError, "found \"hip\""),
                (lambda: made(RIG, sets={"element.cont": 2}), sinew.InputError, "element.cont"),
                (lambda: made(3), TypeError, "expected a path"),
                (lambda: made(RIG, length=-1.0), ValueError, "length: found -1 m"),
                (lambda: made(RIG, length=86.4e3), ValueError, "length: found 86400 m"),
                (lambda: made(RIG, pressure=0.0), ValueError, "an absolute pressure above 0"),
                (lambda: made(RIG, pressure=nan), ValueError, "pressure: found nan"),
                (lambda: made(RIG, length=0.15, sets=tight), ValueError, "no room for air"),
                (lambda: made(RIG, length="80 mm"), TypeError, "incompatible"),
                (lambda: muscle.advance(0.0, 0.08), ValueError, "step: found 0 s"),
                (lambda: muscle.advance(-1e-3, 0.08), ValueError, "step: found -0.001 s"),
                (lambda: muscle.advance(1e4, 0.08), ValueError, "at most 10 s"),
                (lambda: muscle.advance(1e-3, nan), ValueError, "length: found nan m"),
                (lambda: muscle.advance(1e-3, 0.0), ValueError, "length: found 0 m"),
                (lambda: muscle.set_point(1.5), ValueError, "share: found 1.5"),
                (lambda: muscle.inlet("on"), TypeError, "incompatible"),
                (lambda: muscle.set_point(0.5), ValueError, "set_point: found a muscle with on-off"),
                (lambda: muscle.follow(1e-3, 0.08), ValueError, "lengths: found an array of shape ()"),
                (lambda: muscle.follow(1e-3, [0.08, nan]), ValueError, "length: found nan"),
                (lambda: muscle.follow(1e-3, "long"), TypeError, "lengths: found 'long'"),
                (lambda: muscle.follow(1e-3, [0.08], inlet=[1, 0]), ValueError, "inlet: found an array"),
                (lambda: muscle.follow(1e-3, [0.08], exhaust=0.5), ValueError, "exhaust: found 0.5"),
                (lambda: muscle.restore(b"none"), ValueError, "too few bytes"),
                (lambda: muscle.restore(saved[:-1]), ValueError, "cut off or spoilt"),
                (lambda: other.restore(saved), ValueError, "another muscle"),
            ]
        )
        self.assertEqual(muscle.save(), saved)


if __name__ == "__main__":
    unittest.main()
