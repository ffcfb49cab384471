"""Overhead of Python: a walk advanced in one call, in steps, by a loop, as one environment and as sixty-four,
measured alternately. Prints microseconds of processor time for each step of 50 ms, of all threads together.

    PYTHONPATH=build/release/python python3 bench/python_speed.py
"""

import statistics
import time
from typing import Any, Callable, Dict, List

import numpy

import sinew
import sinew.gym

STEP = 0.05
task = sinew.gym.task("walk")
walk = sinew.Experiment(task.experiment, dict(task.sets))
steps = round((walk.duration - task.begin) / STEP) - 2


def at_one_go() -> int:
    """Advance in one call: the time of the library."""
    leg = sinew.Simulation(walk)
    leg.advance(task.begin)
    began = time.process_time_ns()
    leg.advance(steps * STEP)
    return time.process_time_ns() - began


def in_steps() -> int:
    """Advance in steps, with one reading each."""
    leg = sinew.Simulation(walk)
    leg.advance(task.begin)
    began = time.process_time_ns()
    for _ in range(steps):
        leg.advance(STEP)
        leg.read("/true/trolley/position")
    return time.process_time_ns() - began


def in_a_loop() -> int:
    """Run a loop with two settings and twelve readings."""
    leg = sinew.Simulation(walk)
    leg.advance(task.begin)
    names = [one.channel for one in task.observations][:12]
    loop = sinew.Loop(leg, ["control.stiffness.hip", "control.stiffness.knee"], names, STEP)
    wanted = numpy.array([walk["control.stiffness.hip"], walk["control.stiffness.knee"]])
    began = time.process_time_ns()
    for _ in range(steps):
        loop.step(wanted)
    return time.process_time_ns() - began


one = sinew.gym.Env("walk")
MANY = 64
many = sinew.gym.VectorEnv("walk", num_envs=MANY)
still: Any = numpy.zeros(4)
all_still: Any = numpy.zeros((MANY, 4))


def as_an_environment() -> int:
    """Step an environment: observations, reward, flags."""
    one.reset(seed=1)
    began = time.process_time_ns()
    for _ in range(steps):
        one.step(still)
    return time.process_time_ns() - began


def as_many() -> int:
    """Step sixty-four environments in lanes; return the time of each."""
    many.reset(seed=1)
    began = time.process_time_ns()
    for _ in range(steps):
        many.step(all_still)
    return (time.process_time_ns() - began) // MANY


ways: Dict[str, Callable[[], int]] = {
    "at one go": at_one_go,
    "in steps": in_steps,
    "in a loop": in_a_loop,
    "an environment": as_an_environment,
    "sixty-four, each": as_many,
}
times: Dict[str, List[float]] = {name: [] for name in ways}
for _ in range(15):
    for name, way in ways.items():
        times[name].append(way() / steps / 1000)
ratios = {
    name: statistics.median(t / own for t, own in zip(times[name], times["at one go"]))
    for name in ways
}
for name, all_times in times.items():
    extra = statistics.median(t - own for t, own in zip(all_times, times["at one go"]))
    print(
        f"{name:17s} {statistics.median(all_times):6.1f} us a step, {extra:5.1f} us more, "
        f"{ratios[name]:.2f} times"
    )
