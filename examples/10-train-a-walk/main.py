"""Trains a faster walk with numpy alone, by the cross-entropy method: sixteen legs side by side walk with
gaits drawn at random around the best so far; the fastest say where the next are drawn.

An action is, 20 times a second, how far each joint is to be from the plan's angle, and how much stiffer. A gait is
a matrix: the action is linear in what is seen and in the phase of the step. It is judged with the noise of 20 seeds
that it has never met.
"""

import sys
from typing import Any

import numpy

import sinew.gym

GENERATIONS = int(sys.argv[1]) if len(sys.argv) > 1 else 15
ROUNDS, KEPT, ENVS = 3, 10, 16
TRIED = ROUNDS * ENVS

envs = sinew.gym.VectorEnv("walk", num_envs=ENVS)
actions = envs.single_action_space.shape[0]
phase_at = [sight.channel for sight in envs.task.sights].index("/plan/phase")


def dice(generation: int, count: int) -> Any:
    """Return random bits of a generation, a hash of their number: main.cpp has the same."""
    z = numpy.arange(generation * 2**32 + 1, generation * 2**32 + count + 1, dtype=numpy.uint64)
    z *= numpy.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> numpy.uint64(30))) * numpy.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> numpy.uint64(27))) * numpy.uint64(0x94D049BB133111EB)
    return z ^ (z >> numpy.uint64(31))


def normals(generation: int, shape: Any) -> Any:
    """Return numbers that are normal but for their tails: the sum of twelve uniform ones, less six."""
    uniform = (dice(generation, 12 * int(numpy.prod(shape))) >> numpy.uint64(11)) * 2.0**-53
    return sum(uniform.reshape(-1, 12).T).reshape(shape) - 6


def features(seen: Any) -> Any:
    """Return what is seen, the number of the phase as three numbers that are 0 or 1."""
    phases = numpy.round(seen[:, phase_at, None]) == numpy.arange(3)
    return numpy.concatenate([phases, numpy.delete(seen, phase_at, axis=1)], axis=1)


def walk(gaits: Any, seeds: Any) -> Any:
    """Return how far each gait goes with its seed [m]."""
    seen, _ = envs.reset(seed=[int(s) for s in seeds])
    way, walks = numpy.zeros(ENVS), numpy.ones(ENVS, bool)
    while walks.any():
        # One after the other, as in C++: numpy's own product adds in an order of the computer's.
        action = sum(gaits[:, :, j] * f[:, None] for j, f in enumerate(features(seen).T))
        seen, reward, terminated, truncated, _ = envs.step(numpy.clip(action, -1, 1))
        way += reward * walks
        walks &= ~(terminated | truncated)
    return way


def judged(gait: Any, seeds: Any) -> Any:
    """Return how far one gait goes with each seed [m]; the last ones may stand for a full row."""
    rows = [numpy.resize(seeds[i : i + ENVS], ENVS) for i in range(0, len(seeds), ENVS)]
    return numpy.concatenate([walk(numpy.tile(gait, (ENVS, 1, 1)), row) for row in rows])[: len(seeds)]


unseen = numpy.arange(10_000, 10_020)
shape = (actions, envs.single_observation_space.shape[0] + 2)
mean, spread = numpy.zeros(shape), numpy.full(shape, 0.3)
plan = judged(mean, unseen)
print(f"the plan: {plan.mean():.2f} m in four steps")

for generation in range(1, GENERATIONS + 1):
    seeds = dice(generation + 2**20, TRIED) % numpy.uint64(9_999) + numpy.uint64(1)
    tried = mean + spread * normals(generation, (TRIED, *shape))
    ways = numpy.concatenate(
        [walk(tried[i : i + ENVS], seeds[i : i + ENVS]) for i in range(0, TRIED, ENVS)]
    )
    best = tried[numpy.argsort(-ways)[:KEPT]]
    mean = 0.3 * mean + 0.7 * best.mean(axis=0)
    spread = 0.01 + 0.3 * spread + 0.7 * best.std(axis=0)
    if generation % 5 == 0:
        print(f"generation {generation}: {ways.mean():.2f} m on average")

trained = judged(mean, unseen)
gain = trained / plan - 1
print(
    f"trained: {trained.mean():.2f} m, {100 * gain.mean():.0f} % further; "
    f"of {len(unseen)} seeds that it has not met the worst {100 * gain.min():.0f} %"
)
sys.exit(0 if gain.min() >= 0.2 else 1)
