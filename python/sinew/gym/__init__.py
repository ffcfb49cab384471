"""Environments with Gymnasium's interface for robots with braided actuators; Gymnasium is optional.

    import sinew.gym

    env = sinew.gym.Env("walk")
    seen, info = env.reset(seed=1)
    over = False
    while not over:
        seen, reward, terminated, truncated, info = env.step(env.action_space.sample())
        over = terminated or truncated

If Gymnasium is installed, Env is a gymnasium.Env and its spaces are Gymnasium's.
"""

from sinew.gym.env import Env, VectorEnv
from sinew.gym.spaces import Box
from sinew.gym.tasks import Action, Observation, Task, names, task

__all__ = ["Action", "Box", "Env", "Observation", "Task", "VectorEnv", "names", "task"]
