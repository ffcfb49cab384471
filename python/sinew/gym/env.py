"""Single and vectorized environments."""

import copy
import operator
from typing import Any, Callable, Dict, Optional, Sequence, SupportsIndex, Tuple, Union

import numpy
import numpy.typing

from sinew import _sinew
from sinew._sinew import Experiment, Simulation
from sinew.gym import spaces
from sinew.gym.drawing import Drawing
from sinew.gym.tasks import Task, task as task_of

Info = Dict[str, Any]

try:
    import gymnasium  # type: ignore[import]

    _Base: Any = gymnasium.Env
except ImportError:
    _Base = object


class _Shared:
    """Data shared by the episodes of a task: experiment, spaces, and the plan's own settings."""

    def __init__(self, task: Union[str, Task]) -> None:
        self.task = task_of(task) if isinstance(task, str) else task
        t = self.task
        for action in t.actions:
            if action.kind not in ("offset", "factor"):
                raise ValueError(
                    f"action {action.setting}: found kind {action.kind!r}; expected offset or factor"
                )
            if not action.size > 0:
                raise ValueError(
                    f"action {action.setting}: found size {action.size}; expected more than 0"
                )
        for one in t.observations:
            if not one.scale > 0:
                raise ValueError(
                    f"observation {one.channel}: found scale {one.scale}; expected more than 0"
                )
        self.experiment = Experiment(t.experiment, dict(t.sets))
        self.definition = _sinew.EpisodeDefinition(
            Simulation(self.experiment),
            [a.setting for a in t.actions],
            [a.size if a.kind == "offset" else 0.0 for a in t.actions],
            [a.size if a.kind == "factor" else 1.0 for a in t.actions],
            [o.channel for o in t.observations],
            [o.middle for o in t.observations],
            [o.scale for o in t.observations],
            list(t.measures),
            t.begin,
            t.period,
        )
        ones = numpy.ones(len(t.actions))
        free = numpy.full(len(t.observations), numpy.inf)
        self.action_space = spaces.box(-ones, ones)
        self.observation_space = spaces.box(-free, free)

    def begin(self, seed: int) -> _sinew.Episode:
        return _sinew.Episode(self.definition, Simulation(self.experiment.with_seed(seed)))


def _clipped(action: numpy.typing.ArrayLike) -> "Optional[numpy.typing.NDArray[numpy.bool_]]":
    """Return a mask of the numbers outside -1 to 1; None if all are inside."""
    beyond = numpy.abs(numpy.asarray(action, float)) > 1.0
    return beyond if beyond.any() else None


def _without_gaps(
    seen: "numpy.typing.NDArray[numpy.float64]", info: Info
) -> "numpy.typing.NDArray[numpy.float64]":
    """Return the observation with 0 for channels without a value, and mark them in info["missing"]."""
    missing = numpy.isnan(seen)
    if not missing.any():
        return seen
    info["missing"] = missing
    return numpy.where(missing, 0.0, seen)


def _refuse(options: Optional[Dict[str, Any]]) -> None:
    if options:
        raise ValueError(
            f"options: found {', '.join(map(repr, options))}; expected no options; settings belong "
            "into sets of the task: dataclasses.replace(env.task, sets={**env.task.sets, KEY: VALUE})"
        )


class _Seeds:
    """Seeds of episodes: the given one, then others derived from it."""

    def __init__(self) -> None:
        self._random = numpy.random.default_rng()

    def next(self, seed: Optional[SupportsIndex]) -> int:
        if seed is not None:
            number = operator.index(seed)
            if not 0 <= number < 2**31:
                raise ValueError(f"seed: found {number}; expected 0 to 2147483647")
            self._random = numpy.random.default_rng(number)
            return number
        return int(self._random.integers(2**31))


class Env(_Base):  # type: ignore[misc]
    """A robot's run as an environment with Gymnasium's interface.

    task: a name (sinew.gym.names) or a Task. render_mode: None, "rgb_array" (an image of the
    machine) or "ansi" (a line of text).

    An action has a number from -1 to 1 for each of the task's actions; 0 keeps the plan's value. An
    episode is terminated if the run fails, and truncated when the plan ends. The same seed and actions
    give the same bits. Numbers of an action outside -1 to 1 are clipped, and info["clipped"] is then a
    mask of them. A channel without a value, such as the desired position of the foot while joint
    angles are desired, is observed as 0 and marked in info["missing"].
    """

    metadata = {"render_modes": ["rgb_array", "ansi"], "render_fps": 20}

    def __init__(self, task: Union[str, Task] = "walk", render_mode: Optional[str] = None) -> None:
        if render_mode not in (None, "rgb_array", "ansi"):
            raise ValueError(
                f"render_mode: found {render_mode!r}; expected None, 'rgb_array' or 'ansi'"
            )
        self._shared = _Shared(task)
        self.task = self._shared.task
        self.metadata = dict(Env.metadata, render_fps=round(1.0 / self.task.period))
        self.render_mode = render_mode
        self.action_space = self._shared.action_space
        self.observation_space = self._shared.observation_space
        self._seeds = _Seeds()
        self._episode: Optional[_sinew.Episode] = None
        self._number = 0  # seed of the episode
        self._over = False
        self._drawing: Optional[Drawing] = None

    def __copy__(self) -> "Env":
        """Return an independent environment that continues equally."""
        out = Env(self.task, self.render_mode)
        out._seeds = copy.deepcopy(self._seeds)
        if self._episode is not None:
            out._episode = out._shared.begin(self._number)
            out._episode.simulation.restore(self._episode.simulation.save())
            out._number, out._measured, out._over = self._number, self._measured, self._over
        return out

    def __deepcopy__(self, memo: Dict[int, Any]) -> "Env":
        """Return a copy; copies share the task, which never changes."""
        return self.__copy__()

    @property
    def simulation(self) -> Simulation:
        """The run of this episode. Raises RuntimeError before reset()."""
        return self._running().simulation

    def _running(self) -> _sinew.Episode:
        if self._episode is None:
            raise RuntimeError("env: found no episode; expected reset() before")
        return self._episode

    def reset(
        self, *, seed: Optional[SupportsIndex] = None, options: Optional[Dict[str, Any]] = None
    ) -> Tuple["numpy.typing.NDArray[numpy.float64]", Info]:
        """Begin an episode. Without a seed, it is derived from the last one given.

        Raises ValueError for options: a task has none.
        """
        _refuse(options)
        number = self._seeds.next(seed)
        self._episode = self._shared.begin(number)
        self._number = number
        self._over = False
        seen, self._measured = self._episode.observe()
        info: Info = {"seed": number, "time": self._episode.simulation.time}
        return _without_gaps(seen, info), info

    def step(
        self, action: numpy.typing.ArrayLike
    ) -> Tuple["numpy.typing.NDArray[numpy.float64]", float, bool, bool, Info]:
        """Advance by a period. Returns observation, reward, terminated, truncated, info."""
        episode = self._episode
        if episode is None or self._over:
            raise RuntimeError("env: found no episode under way; expected reset() before")
        info: Info = {}
        before, terminated = self._measured, False
        try:
            seen, self._measured, ended = episode.step(action)
        except _sinew.RunError as failed:
            seen, self._measured = episode.observe()
            ended, terminated, info["failure"] = False, True, str(failed)
        if (beyond := _clipped(action)) is not None:
            info["clipped"] = beyond
        if self.task.failed is not None and self.task.failed(self._measured):
            terminated = True
        reward = self.task.reward(before, self._measured, self.task.period)
        truncated = ended and not terminated
        self._over = ended or terminated
        return _without_gaps(seen, info), reward, terminated, truncated, info

    def render(self) -> Any:
        """Return an image or a text of the machine, according to `render_mode`."""
        if self.render_mode is None:
            return None
        if self._drawing is None:
            self._drawing = Drawing(self._shared.experiment)
        if self.render_mode == "ansi":
            return self._drawing.text(self.simulation)
        return self._drawing.image(self.simulation)

    def close(self) -> None:
        """End the episode."""
        self._episode = None


Values = Union[numpy.typing.ArrayLike, Callable[[int], numpy.typing.ArrayLike]]


class VectorEnv:
    """Several parallel environments of a task, which step with one call, in lanes and on all cores.

    Observations, rewards and flags have a row for each. An environment whose episode has ended
    begins the next one in the next step, like Gymnasium's vector environments; its action is then
    ignored, and its reward is 0. info["clipped"] marks numbers of actions that were clipped to -1
    and 1, info["missing"] channels without a value; each is left out if nothing is marked.

    parameters: keys of numbers in which the environments differ, such as "link.femur.mass", as of
        sinew.Ensemble.
    values: their values in SI: a row for each environment, one row for all, or a function of an
        episode's seed that returns its row.
    threads: number of threads; 0: one per core. The results do not depend on it.

    Each environment has the bits of an Env whose task sets these values. The values of the present
    episodes are in `values`.
    """

    def __init__(
        self,
        task: Union[str, Task] = "walk",
        num_envs: int = 16,
        *,
        parameters: Sequence[str] = (),
        values: Optional[Values] = None,
        threads: int = 0,
    ) -> None:
        if num_envs < 1:
            raise ValueError(f"num_envs: found {num_envs}; expected 1 or more")
        self._shared = _Shared(task)
        self.task = self._shared.task
        self.num_envs = num_envs
        self.parameters = tuple(parameters)
        self.single_action_space = self._shared.action_space
        self.single_observation_space = self._shared.observation_space
        self.action_space = spaces.box(
            numpy.tile(self.single_action_space.low, (num_envs, 1)),
            numpy.tile(self.single_action_space.high, (num_envs, 1)),
        )
        self.observation_space = spaces.box(
            numpy.tile(self.single_observation_space.low, (num_envs, 1)),
            numpy.tile(self.single_observation_space.high, (num_envs, 1)),
        )
        self.values = numpy.full((num_envs, len(self.parameters)), numpy.nan)
        self._values: Optional[Callable[[int], numpy.typing.ArrayLike]] = None
        self._has_values = not self.parameters
        if values is not None:
            self._set_values(values)
        self._seeds = [_Seeds() for _ in range(num_envs)]
        self._episodes = _sinew.Episodes(
            self._shared.definition, self._shared.experiment, self.parameters, num_envs, threads
        )
        self._under_way = False
        self._over = numpy.zeros(num_envs, bool)

    def _set_values(self, values: Values) -> None:
        if callable(values):
            self._values = values
        else:
            rows = numpy.asarray(values, float)
            if rows.shape not in (self.values.shape, self.values.shape[1:]):
                raise ValueError(
                    f"values: found shape {rows.shape}; expected {self.values.shape}, or "
                    f"{self.values.shape[1:]} for all"
                )
            self._values = None
            self.values[:] = rows
        self._has_values = True

    def _begin(self, places: Sequence[int], seeds: Sequence[int]) -> None:
        """Begin the episodes of these environments with the next step."""
        if self._values is not None:
            for i, seed in zip(places, seeds):
                row = numpy.asarray(self._values(seed), float)
                if row.shape != self.values.shape[1:]:
                    raise ValueError(
                        f"values: found shape {row.shape} of the function for seed {seed}; "
                        f"expected {self.values.shape[1:]}, a number for each parameter"
                    )
                self.values[i] = row
        self._episodes.begin(places, seeds, self.values[places])

    def reset(
        self,
        *,
        seed: Optional[Union[SupportsIndex, Sequence[SupportsIndex]]] = None,
        options: Optional[Dict[str, Any]] = None,
    ) -> Tuple["numpy.typing.NDArray[numpy.float64]", Info]:
        """Restart all environments. `seed`: seed of the first, increased by 1 for each next; or a list.

        `options`: {"values": other values of the parameters from now on}. Raises ValueError for
        others, InputError for values that the experiment refuses.
        """
        options = dict(options or {})
        if self.parameters and "values" in options:
            self._set_values(options.pop("values"))
        _refuse(options)
        if not self._has_values:
            raise ValueError(f"values: found none; expected those of {', '.join(self.parameters)}")
        seeds: "Sequence[Optional[SupportsIndex]]"
        if seed is None:
            seeds = [None] * self.num_envs
        elif isinstance(seed, SupportsIndex) and numpy.ndim(seed) == 0:  # type: ignore[arg-type]
            first = operator.index(seed)
            seeds = [first + i for i in range(self.num_envs)]
        else:
            seeds = list(seed)  # type: ignore[arg-type]
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed: found {len(seeds)}; expected one, or {self.num_envs}")
        numbers = [s.next(one) for s, one in zip(self._seeds, seeds)]
        self._under_way = False
        self._begin(range(self.num_envs), numbers)
        seen, self._measured, _, failed = self._episodes.step(numpy.zeros(self.action_space.shape))
        if failed.any():
            raise _sinew.RunError(self._episodes.cause(int(failed.argmax())))
        self._under_way = True
        self._over[:] = False
        info: Info = {"seed": numpy.array(numbers)}
        return _without_gaps(seen, info), info

    def step(self, actions: numpy.typing.ArrayLike) -> Tuple[Any, Any, Any, Any, Info]:
        """Advance all by a period. Returns observations, rewards, terminated, truncated, info."""
        if not self._under_way:
            raise RuntimeError("env: found no episodes; expected reset() before")
        skipped = self._over
        if skipped.any():
            again = [int(i) for i in numpy.flatnonzero(skipped)]
            self._begin(again, [self._seeds[i].next(None) for i in again])
        before = self._measured
        seen, self._measured, ended, failed = self._episodes.step(actions)
        reward, period = self.task.reward, self.task.period
        rewards = numpy.array(
            [
                0.0 if skip else reward(b, a, period)
                for b, a, skip in zip(before, self._measured, skipped)
            ]
        )
        terminated = failed
        if self.task.failed is not None:
            terminated = failed | [bool(self.task.failed(m)) for m in self._measured]
        self._over = ended | terminated
        beyond = _clipped(actions)
        if beyond is not None:
            beyond &= ~skipped[:, numpy.newaxis]
        info: Info = {"clipped": beyond} if beyond is not None and beyond.any() else {}
        return _without_gaps(seen, info), rewards, terminated, ended & ~terminated, info

    def close(self) -> None:
        """End all episodes."""
        self._under_way = False
