"""Tasks of environments: an experiment, actions, observations and a reward.

A Task is plain data with two functions, so that tasks of your own work like those of this module:

    walk = sinew.gym.task("walk")
    heavier = dataclasses.replace(walk, sets={**walk.sets, "trolley.payload": 1.0})
    env = sinew.gym.Env(heavier)
"""

import dataclasses
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Tuple

import numpy

from sinew._shipped import shipped

@dataclasses.dataclass(frozen=True)
class Action:
    """Effect of a number of the action, from -1 to 1, on a setting of the run.

    setting: its key, "control.stiffness.hip".
    kind: "offset" adds `size` times the number to the plan's value; "factor" multiplies the plan's
        value by `size` to the power of the number. So 0 keeps the plan's value.
    size: of an offset in the setting's SI unit, of a factor without unit.
    """

    setting: str
    kind: str
    size: float


@dataclasses.dataclass(frozen=True)
class Observation:
    """A number of the observation: (value of a channel - middle) / scale, both in its unit."""

    channel: str
    scale: float = 1.0
    middle: float = 0.0


@dataclasses.dataclass(frozen=True)
class Task:
    """Task of an environment, see the module.

    experiment: its path; sinew.shipped("experiments/…") for one shipped with Sinew.
    sets: settings that override the experiment's, as in sinew.Experiment.
    actions, observations: the numbers of an action and of an observation.
    measures: channels that `reward` and `failed` use, in their units; "plan:KEY" is the plan's value
        of an action's setting, without the action.
    reward: function of the measures before and after a step and its period [s]; returns the reward.
    failed: function of the measures after a step; returns whether the episode is terminated as failed.
    period: duration of a step [s]; a multiple of the gait controller's 0.01 s is advisable.
    begin: start of an episode [s]; before, the run follows the plan.
    """

    experiment: str
    actions: Sequence[Action]
    observations: Sequence[Observation]
    measures: Sequence[str]
    reward: Callable[[Any, Any, float], float]
    failed: Optional[Callable[[Any], bool]] = None
    sets: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    period: float = 0.05
    begin: float = 0.6


_angles = tuple(
    Observation(f"/joint/{joint}/angle", 0.5, middle)
    for joint, middle in (("hip", 4.9), ("knee", 5.2))
)
_desired = tuple(
    Observation(f"/desired/joint/{joint}/angle", 0.5, middle)
    for joint, middle in (("hip", 4.9), ("knee", 5.2))
)
_speeds = tuple(Observation(f"/true/joint/{joint}/velocity", 3.0) for joint in ("hip", "knee"))
_tensions = tuple(
    Observation(f"/muscle/{muscle}/tension", 200.0)
    for muscle in ("hip_flexor", "hip_extensor", "knee_flexor", "knee_extensor")
)
_stiffness = tuple(Observation(f"/joint/{joint}/stiffness", 4.0) for joint in ("hip", "knee"))
_actions = (
    Action("control.angle.hip", "offset", 0.2),
    Action("control.angle.knee", "offset", 0.2),
    Action("control.stiffness.hip", "factor", 2.0),
    Action("control.stiffness.knee", "factor", 2.0),
)


_foot = (
    "/true/foot/position.x",
    "/true/foot/position.y",
    "/desired/foot/position.x",
    "/desired/foot/position.y",
)


def _progress(before: Any, after: Any, period: float) -> float:
    return float(after[0] - before[0])


def _walk() -> Task:
    return Task(
        experiment=shipped("experiments/walk-test-1.toml"),
        # The thesis's track is only as long as its walk; a faster robot would reach its end.
        sets={"trolley.track_length": 20.0, "sequence.repeat": 4},
        actions=_actions,
        observations=_angles
        + _desired
        + _speeds
        + _stiffness
        + _tensions
        + (Observation("/plan/phase"), Observation("/true/trolley/velocity", 0.3)),
        measures=("/true/trolley/position",),
        reward=_progress,
    )


def _distance(before: Any, after: Any, period: float) -> float:
    return -period * float(numpy.hypot(after[0] - after[2], after[1] - after[3]))


def _kick() -> Task:
    return Task(
        experiment=shipped("experiments/kick.toml"),
        actions=_actions
        + (
            Action("control.gains.hip.angle", "factor", 3.0),
            Action("control.gains.knee.angle", "factor", 3.0),
        ),
        observations=_angles + _desired + _speeds + _tensions + (Observation("/plan/phase"),),
        measures=_foot,
        reward=_distance,
        period=0.01,
        begin=1.5,
    )


def _reach() -> Task:
    return Task(
        experiment=shipped("experiments/leg-in-air.toml"),
        actions=_actions,
        observations=_angles + _desired + _speeds + _tensions,
        measures=_foot,
        reward=_distance,
        period=0.02,
    )


def _stiffness_error(before: Any, after: Any, period: float) -> float:
    hip, hip_wanted, knee, knee_wanted = (float(x) for x in after)
    return -period * (abs(hip / hip_wanted - 1.0) + abs(knee / knee_wanted - 1.0))


def _hold_stiffness() -> Task:
    return Task(
        experiment=shipped("experiments/leg-in-air.toml"),
        actions=(
            Action("control.stiffness.hip", "factor", 3.0),
            Action("control.stiffness.knee", "factor", 3.0),
            Action("control.gains.hip.stiffness", "factor", 3.0),
            Action("control.gains.knee.stiffness", "factor", 3.0),
        ),
        observations=_angles + _speeds + _stiffness + _tensions,
        measures=("/joint/hip/stiffness", "plan:control.stiffness.hip")
        + ("/joint/knee/stiffness", "plan:control.stiffness.knee"),
        reward=_stiffness_error,
        period=0.02,
    )


_made: "Dict[str, Callable[[], Task]]" = {
    "walk": _walk,
    "kick": _kick,
    "reach": _reach,
    "hold-stiffness": _hold_stiffness,
}
names: Tuple[str, ...] = tuple(_made)


def task(name: str) -> Task:
    """Return a task shipped with Sinew: "walk", "kick", "reach", "hold-stiffness".

    Rewards: walk: progress of the trolley in a step [m]. kick and reach: distance of the foot from its
    planned position times the period, negative [m s]. hold-stiffness: relative deviation of the joints'
    stiffnesses from the plan's times the period, negative [s]. Raises ValueError for another name.
    """
    if name not in _made:
        raise ValueError(f"task: found {name!r}; expected one of {', '.join(names)}")
    return _made[name]()
