"""Environments: they pass Gymnasium's checker and give the results of the simulated runs."""

import copy
import dataclasses
import os
import subprocess
import sys
import tempfile
import unittest
from typing import Any, List, Tuple

import numpy

import sinew
import sinew.gym
import sinew.gym.env
from common import WALK, Refusals


def episode(env: sinew.gym.Env, actions: Any, seed: int) -> Tuple[List[Any], float]:
    """Return the observations of an episode, and the sum of its rewards."""
    seen, _ = env.reset(seed=seed)
    out, rewards, over = [seen], 0.0, False
    while not over:
        seen, reward, terminated, truncated, _ = env.step(actions(len(out)))
        out.append(seen)
        rewards += reward
        over = terminated or truncated
    return out, rewards


class Env(unittest.TestCase):
    def test_has_gymnasiums_shape(self) -> None:
        for name in sinew.gym.names:
            with self.subTest(task=name):
                env = sinew.gym.Env(name)
                seen, info = env.reset(seed=3)
                self.assertEqual(info["seed"], 3)
                env.action_space.seed(1)
                for _ in range(30):
                    self.assertTrue(env.observation_space.contains(seen))
                    action = env.action_space.sample()
                    self.assertTrue(env.action_space.contains(action))
                    seen, reward, terminated, truncated, info = env.step(action)
                    self.assertIsInstance(reward, float)
                    self.assertIsInstance(terminated, bool)
                    self.assertIsInstance(truncated, bool)
                    self.assertIsInstance(info, dict)
                self.assertIsNone(env.render())
                env.close()

    def test_no_action_is_the_plan_to_the_last_bit(self) -> None:
        for name in sinew.gym.names:
            env = sinew.gym.Env(name)
            zero = numpy.zeros(env.action_space.shape)
            episode(env, lambda k: zero, 4)
            task = env.task
            plain = sinew.Simulation(
                sinew.Experiment(task.experiment, dict(task.sets)).with_seed(4)
            )
            plain.advance_to(env.simulation.tick)
            for channel in plain.channels:
                self.assertEqual(
                    env.simulation.read(channel.name), plain.read(channel.name), channel.name
                )

    def test_a_seed_and_actions_give_the_same_bits(self) -> None:
        def actions(k: int) -> Any:
            return numpy.random.default_rng(k).uniform(-1, 1, 4)

        first, again = sinew.gym.Env("walk"), sinew.gym.Env("walk")
        a, b = episode(first, actions, 7), episode(again, actions, 7)
        self.assertEqual(numpy.array(a[0]).tobytes(), numpy.array(b[0]).tobytes())
        self.assertEqual(a[1], b[1])
        c = episode(again, actions, 8)
        self.assertNotEqual(numpy.array(a[0]).tobytes(), numpy.array(c[0]).tobytes())
        # Without a seed: new ones, derived from the last one given.
        seeds = [first.reset()[1]["seed"] for _ in range(3)]
        again.reset(seed=7)
        self.assertEqual(seeds, [again.reset()[1]["seed"] for _ in range(3)])
        self.assertEqual(len(set(seeds)), 3)

    def test_a_copy_goes_on_alike_and_apart(self) -> None:
        env = sinew.gym.Env("walk")
        env.reset(seed=3)
        action = numpy.full(env.action_space.shape, 0.3)
        for _ in range(20):
            env.step(action)
        for other in (copy.copy(env), copy.deepcopy(env)):
            apart = copy.deepcopy(env)
            apart.step(-action)
            mine = copy.deepcopy(env)
            for _ in range(10):
                one, two = mine.step(action), other.step(action)
                numpy.testing.assert_array_equal(one[0], two[0])
                self.assertEqual(one[1:4], two[1:4])
            self.assertEqual(mine.reset()[1], other.reset()[1])

    def test_an_action_has_its_stated_effect(self) -> None:
        env = sinew.gym.Env("walk")
        plan = sinew.Simulation(WALK, dict(env.task.sets))
        keys = ("control.angle.hip", "control.stiffness.hip")
        for action in ([1.0, 0.0, 0.5, 0.0], [-9.0, 0.0, -1.0, 0.0]):
            env.reset(seed=1)
            env.step(action)
            plan.restore(sinew.Simulation(WALK, dict(env.task.sets)).save())
            plan.advance_to(env.simulation.tick)
            offset = 0.2 * max(-1, action[0])
            self.assertAlmostEqual(
                env.simulation.setting(keys[0]), plan.setting(keys[0]) + offset, 12
            )
            self.assertAlmostEqual(
                env.simulation.setting(keys[1]), plan.setting(keys[1]) * 2.0 ** action[2], 12
            )

    def test_reports_what_it_clips(self) -> None:
        env = sinew.gym.Env("walk")
        env.reset(seed=1, options={})
        self.assertNotIn("clipped", env.step([1.0, -1.0, 0.0, 1.0])[4])
        found = env.step([1.5, -1.0, 0.0, -2.0])[4]["clipped"]
        self.assertEqual(found.tolist(), [True, False, False, True])
        many = sinew.gym.VectorEnv("walk", 2)
        many.reset(seed=1)
        found = many.step([[0.0, 0.0, 3.0, 0.0], [0.0] * 4])[4]["clipped"]
        self.assertEqual(found.tolist(), [[False, False, True, False], [False] * 4])
        self.assertEqual(many.step(numpy.zeros((2, 4)))[4], {})

    def test_channels_without_a_value_are_zero_and_marked(self) -> None:
        task = dataclasses.replace(
            sinew.gym.task("walk"),
            observations=[
                sinew.gym.Observation("/joint/hip/angle"),
                sinew.gym.Observation("/desired/foot/position.x"),
            ],
        )
        env = sinew.gym.Env(task)
        seen, info = env.reset(seed=1)
        marks = []
        for _ in range(40):
            marks.append(bool(info["missing"][1]) if "missing" in info else False)
            self.assertTrue(numpy.isfinite(seen).all())
            self.assertEqual(seen[1] == 0.0, marks[-1])
            seen, _, _, _, info = env.step(numpy.zeros(4))
        self.assertIn(True, marks)
        many = sinew.gym.VectorEnv(task, 2)
        rows, info = many.reset(seed=1)
        self.assertTrue(numpy.isfinite(rows).all())
        self.assertEqual(info["missing"].tolist(), [[False, marks[0]]] * 2)

    def test_refuses_options(self) -> None:
        envs: List[Any] = [sinew.gym.Env("walk"), sinew.gym.VectorEnv("walk", 2)]
        for env in envs:
            with self.assertRaisesRegex(ValueError, "options: found 'mass'; expected no options"):
                env.reset(seed=1, options={"mass": 1.0})

    def test_examples_of_its_texts_run(self) -> None:
        import sinew.gym.env
        import sinew.gym.spaces
        import sinew.gym.tasks

        for module in (sinew.gym, sinew.gym.env, sinew.gym.spaces, sinew.gym.tasks):
            lines = (module.__doc__ or "").splitlines()
            code = "\n".join(line[4:] for line in lines if line.startswith("    "))
            exec(code, {"dataclasses": dataclasses, "sinew": sinew})

    def test_walks_reward_is_the_way(self) -> None:
        env = sinew.gym.Env("walk")
        _, rewards = episode(env, lambda k: numpy.zeros(4), 1)
        self.assertAlmostEqual(rewards, env.simulation.read("/true/trolley/position"), 6)
        self.assertGreater(rewards, 1.5)

    def test_a_failure_terminates(self) -> None:
        task = dataclasses.replace(
            sinew.gym.task("walk"), failed=lambda measured: bool(measured[0] > 0.1)
        )
        env = sinew.gym.Env(task)
        env.reset(seed=1)
        over = truncated = False
        while not over:
            _, _, over, truncated, _ = env.step(numpy.zeros(4))
        self.assertFalse(truncated)
        with self.assertRaises(RuntimeError):
            env.step(numpy.zeros(4))
        env.reset()

    def test_pictures_show_the_machine(self) -> None:
        env = sinew.gym.Env("walk", render_mode="rgb_array")
        env.reset(seed=1)
        first = env.render()
        self.assertEqual((first.shape, first.dtype), ((320, 480, 3), numpy.uint8))
        for _ in range(20):
            env.step(numpy.zeros(4))
        self.assertGreater(int((first != env.render()).sum()), 1000)
        words = sinew.gym.Env("kick", render_mode="ansi")
        words.reset(seed=1)
        self.assertIn("hip", words.render())

    def test_the_drawn_foot_is_the_true_one(self) -> None:
        from sinew.gym.drawing import Drawing

        leg = sinew.Simulation(WALK)
        drawing = Drawing(leg.experiment)
        for _ in range(20):
            leg.advance(0.3)
            x, y = drawing.points(leg)[-1]
            self.assertAlmostEqual(x, leg.read("/true/foot/position.x"), 9)
            self.assertAlmostEqual(y, leg.read("/true/foot/position.y"), 9)


STAND_IN = """
class Env:
    metadata = {}
    spec = None
"""
STAND_IN_SPACES = """
class Box:
    def __init__(self, low, high, shape=None, dtype=None):
        assert shape is None and low.shape == high.shape
        self.low, self.high, self.shape, self.dtype = low, high, low.shape, dtype
"""
USES_IT = """
import gymnasium, gymnasium.spaces, numpy, sinew.gym
env = sinew.gym.Env("walk")
assert isinstance(env, gymnasium.Env)
for space in (env.action_space, env.observation_space):
    assert type(space) is gymnasium.spaces.Box and space.dtype is numpy.float64
seen, _ = env.reset(seed=1)
assert env.step(numpy.zeros(4))[0].shape == env.observation_space.shape == seen.shape
"""


class Gymnasium(unittest.TestCase):
    def test_where_it_is_an_environment_is_one_of_its(self) -> None:
        # Debian 12 has no Gymnasium: a substitute with the two names that are used.
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(folder + "/gymnasium")
            for name, text in (("__init__", STAND_IN), ("spaces", STAND_IN_SPACES)):
                with open(f"{folder}/gymnasium/{name}.py", "w", encoding="utf-8") as file:
                    file.write(text)
            path = folder + os.pathsep + os.environ["PYTHONPATH"]
            subprocess.run(
                [sys.executable, "-c", USES_IT], check=True, env={**os.environ, "PYTHONPATH": path}
            )


def memory() -> int:
    """Return the resident memory of this process [bytes]."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")


class Memory(unittest.TestCase):
    def test_does_not_grow_with_resets(self) -> None:
        resets = int(os.environ.get("SINEW_RESETS", "3000"))
        env = sinew.gym.Env("walk")

        def reset(times: int) -> None:
            for k in range(times):
                env.reset(seed=k)
                env.step(numpy.zeros(4))

        reset(300)
        before = memory()
        reset(resets)
        grown = memory() - before
        print(f"memory: {resets} resets, {grown / 1e6:.2f} MB more")
        self.assertLess(grown, 1_000_000)


class Vector(unittest.TestCase):
    def test_side_by_side_is_one_by_one(self) -> None:
        task = dataclasses.replace(sinew.gym.task("walk"), sets={"sequence.repeat": 1})
        many = sinew.gym.VectorEnv(task, num_envs=3)
        dice = numpy.random.default_rng(2)
        actions = dice.uniform(-1, 1, (400, 3, 4))
        seen, info = many.reset(seed=[5, 6, 7])
        rows, sums = [seen], numpy.zeros(3)
        ends = 0
        k = 0
        while ends == 0:
            seen, reward, terminated, truncated, _ = many.step(actions[k])
            rows.append(seen)
            sums += reward
            ends += int((terminated | truncated).sum())
            k += 1
        self.assertEqual(ends, 3)
        for i in range(3):
            alone, total = episode(sinew.gym.Env(task), lambda n: actions[n - 1][i], 5 + i)
            self.assertEqual(numpy.array(alone).tobytes(), numpy.array(rows)[:, i].tobytes())
            self.assertAlmostEqual(total, sums[i], 12)
        # The next step begins their next episodes.
        seen, reward, terminated, truncated, _ = many.step(actions[k])
        self.assertEqual(list(reward), [0.0, 0.0, 0.0])
        self.assertFalse(truncated.any())
        self.assertFalse(numpy.array_equal(seen, rows[-1]))

    def test_each_has_physics_of_its_own(self) -> None:
        task = dataclasses.replace(sinew.gym.task("walk"), sets={"trolley.track_length": 20.0})
        keys = ["link.femur.mass", "joint.hip.angle_gain", "sequence.repeat"]
        num, steps = 9, 250

        def values(seed: int) -> Any:  # repeat: episodes end at different times
            u = numpy.random.default_rng(seed).uniform(size=2)
            return [0.2 + 0.2 * u[0], 2e-4 + 4e-4 * u[1], 1 + seed % 2]

        actions = numpy.random.default_rng(4).uniform(-1, 1, (steps, num, 4))
        kept: List[Any] = []
        for threads in (1, 2, 5):
            many = sinew.gym.VectorEnv(
                task, num, parameters=keys, values=values, threads=threads
            )
            seen, _ = many.reset(seed=3)
            all_seen, ends, values_of = [seen], [], [many.values.copy()]
            for k in range(steps):
                seen, _, terminated, truncated, _ = many.step(actions[k])
                all_seen.append(seen)
                ends.append(terminated | truncated)
                values_of.append(many.values.copy())
            kept.append(tuple(numpy.array(rows) for rows in (all_seen, ends, values_of)))
        for other in kept[1:]:
            for a, b in zip(kept[0], other):
                self.assertEqual(a.tobytes(), b.tobytes())
        rows, over, drawn = kept[0]
        self.assertGreater(len(set(over.argmax(axis=0))), 1)
        for i in range(num):
            seeds = sinew.gym.env._Seeds()
            begins = [0] + [k + 1 for k in range(steps - 1) if over[k, i]]
            for begin, end in zip(begins, begins[1:] + [steps]):
                seed = seeds.next(3 + i if begin == 0 else None)
                numbers: Any = values(seed)
                self.assertEqual(drawn[begin + (begin > 0), i].tolist(), numbers)
                sets = {**task.sets, **dict(zip(keys, numbers)), keys[2]: int(numbers[2])}
                alone = sinew.gym.Env(dataclasses.replace(task, sets=sets))
                seen, _ = alone.reset(seed=seed)
                first = begin + (begin > 0)  # row of the reset
                self.assertEqual(seen.tobytes(), rows[first, i].tobytes())
                for k in range(first, end):
                    seen = alone.step(actions[k, i])[0]
                    self.assertEqual(seen.tobytes(), rows[k + 1, i].tobytes())

    def test_a_seed_may_be_numpys(self) -> None:
        env, many = sinew.gym.Env("walk"), sinew.gym.VectorEnv("walk", 2)
        seeds: Any = (numpy.int64(3), numpy.uint8(3), numpy.array(3), numpy.array([7, 5]))
        for seed in seeds[:3]:
            self.assertEqual(env.reset(seed=seed)[1]["seed"], 3)
            self.assertEqual(list(many.reset(seed=seed)[1]["seed"]), [3, 4])
        self.assertEqual(list(many.reset(seed=seeds[3])[1]["seed"]), [7, 5])
        wrong: Any = 3.5
        with self.assertRaises(TypeError):
            many.reset(seed=wrong)

    def test_values_are_set_at_a_reset(self) -> None:
        many = sinew.gym.VectorEnv("walk", 3, parameters=["link.femur.mass"])
        with self.assertRaisesRegex(ValueError, "values: found none; expected those of link.femur"):
            many.reset(seed=1)
        with self.assertRaisesRegex(ValueError, r"found shape \(2,\); expected \(3, 1\)"):
            many.reset(seed=1, options={"values": [0.3, 0.2]})
        with self.assertRaisesRegex(sinew.InputError, "link.femur.mass"):
            many.reset(seed=1, options={"values": [-1.0]})
        many.reset(seed=1, options={"values": [[0.3], [0.2], [0.3]]})
        seen, _ = many.reset(seed=[5, 5, 5])
        self.assertEqual(seen[0].tobytes(), seen[2].tobytes())
        self.assertNotEqual(seen[0].tobytes(), seen[1].tobytes())
        with self.assertRaisesRegex(sinew.InputError, "link.femur.maas"):
            sinew.gym.VectorEnv("walk", 2, parameters=["link.femur.maas"], values=[0.3])
        rows: Any = (0.3, [0.3, 0.2], [[0.3]])
        for wrong in rows:
            row_of: Any = lambda seed, row=wrong: row
            of_seeds = sinew.gym.VectorEnv("walk", 2, parameters=["link.femur.mass"], values=row_of)
            with self.assertRaisesRegex(ValueError, r"for seed 1; expected \(1,\)"):
                of_seeds.reset(seed=1)
        with self.assertRaisesRegex(ValueError, "threads: found -1"):
            sinew.gym.VectorEnv("walk", 2, threads=-1)


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        env, many = sinew.gym.Env("walk"), sinew.gym.VectorEnv("walk", num_envs=2)
        fresh = sinew.gym.Env("walk")
        env.reset(seed=1)
        many.reset(seed=1)
        walk = sinew.gym.task("walk")
        nan = float("nan")
        action, observation = sinew.gym.Action, sinew.gym.Observation

        def made(**parts: Any) -> sinew.gym.Env:
            return sinew.gym.Env(dataclasses.replace(walk, **parts))

        hip = "control.stiffness.hip"
        self.refused(
            [
                (lambda: sinew.gym.Env("run"), ValueError, "expected one of walk"),
                (lambda: sinew.gym.Env("walk", render_mode="human"), ValueError, "'human'"),
                (lambda: fresh.step(numpy.zeros(4)), RuntimeError, "expected reset() before"),
                (lambda: fresh.simulation, RuntimeError, "expected reset() before"),
                (lambda: env.reset(seed=-1), ValueError, "found -1"),
                (lambda: env.reset(seed=2**31), ValueError, "expected 0 to"),
                (lambda: env.step([0, 0, 0]), ValueError, "shape (3,); expected (4,)"),
                (lambda: env.step([0, 0, nan, 0]), ValueError, "found nan in place 2"),
                (lambda: env.step("abcd"), TypeError, "expected real numbers"),
                (lambda: env.step(None), TypeError, "found None"),  # type: ignore[arg-type]
                (lambda: many.step([[0.0] * 4]), ValueError, "expected (2, 4)"),
                (lambda: many.reset(seed=[1]), ValueError, "expected one, or 2"),
                (lambda: sinew.gym.VectorEnv("walk", 0), ValueError, "num_envs: found 0"),
                (lambda: made(period=0.005), ValueError, "a multiple of the gait"),
                (lambda: made(period=0.015), ValueError, "a multiple of the gait"),
                (lambda: made(begin=0.013), ValueError, "begin: found 0.013"),
                (lambda: made(begin=-1.0), ValueError, "found -1"),
                (lambda: made(begin=1000.0), ValueError, "expected less than the plan's"),
                (lambda: made(measures=["plan:x"]), ValueError, "expected one of control.angle"),
                (lambda: made(actions=[action("x", "offset", 1.0)]), ValueError, "expected one of"),
                (lambda: made(actions=[action(hip, "sum", 1.0)]), ValueError, "offset or factor"),
                (lambda: made(actions=[action(hip, "factor", 0.0)]), ValueError, "more than 0"),
                (lambda: made(observations=[observation("/x")]), ValueError, "/x"),
                (lambda: made(observations=[observation("/foot", 0)]), ValueError, "scale 0"),
                (lambda: made(measures=["plan:control.gains.hip.angle"]), ValueError, "the setting"),
                (lambda: made(sets={"x": 1}), sinew.InputError, "x"),
                (lambda: sinew.gym.Box([0, 1], [1]), ValueError, "expected one shape"),
            ]
        )
        env.step(numpy.zeros(4))  # and continues


if __name__ == "__main__":
    unittest.main()
