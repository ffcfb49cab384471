"""Trains a faster walk with the cross-entropy method, using only numpy: sixteen legs in parallel walk with
gaits drawn at random around the best so far, and the fastest ones determine the next distribution.

An action is, 20 times per second, the offset of each joint from the plan's angle and a factor of its stiffness. A
gait is a matrix: the action is linear in the observation and the phase of the step. The result is evaluated with
the noise of 20 seeds that were not used in training.
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
phase_at = [o.channel for o in envs.task.observations].index("/plan/phase")


def dice(generation: int, count: int) -> Any:
    """Return random bits of a generation, a hash of their number: main.cpp has the same."""
    z = numpy.arange(generation * 2**32 + 1, generation * 2**32 + count + 1, dtype=numpy.uint64)
    z *= numpy.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> numpy.uint64(30))) * numpy.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> numpy.uint64(27))) * numpy.uint64(0x94D049BB133111EB)
    return z ^ (z >> numpy.uint64(31))


def normals(generation: int, shape: Any) -> Any:
    """Return approximately normal numbers: the sum of twelve uniform ones, minus six."""
    uniform = (dice(generation, 12 * int(numpy.prod(shape))) >> numpy.uint64(11)) * 2.0**-53
    return sum(uniform.reshape(-1, 12).T).reshape(shape) - 6


def features(seen: Any) -> Any:
    """Return the observation, with the index of the phase as three numbers 0 or 1."""
    phases = numpy.round(seen[:, phase_at, None]) == numpy.arange(3)
    return numpy.concatenate([phases, numpy.delete(seen, phase_at, axis=1)], axis=1)


def walk(gaits: Any, seeds: Any) -> Any:
    """Return the distance of each gait with its seed [m]."""
    seen, _ = envs.reset(seed=[int(s) for s in seeds])
    way, walks = numpy.zeros(ENVS), numpy.ones(ENVS, bool)
    while walks.any():
        # Summed in the same order as in C++: the order in numpy's product depends on the computer.
        action = sum(gaits[:, :, j] * f[:, None] for j, f in enumerate(features(seen).T))
        seen, reward, terminated, truncated, _ = envs.step(numpy.clip(action, -1, 1))
        way += reward * walks
        walks &= ~(terminated | truncated)
    return way


def judged(gait: Any, seeds: Any) -> Any:
    """Return the distance of one gait with each seed [m]; the last batch is filled up."""
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
