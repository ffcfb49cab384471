"""Helpers of the tests: FMUs exported by the program, and random runs."""

import os
import random
import subprocess
import tempfile
from typing import Any, Dict, Iterator, List, Tuple

from importer import Fmu

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.environ.get("SINEW", "sinew")
WORK = tempfile.mkdtemp(prefix="sinew-fmu-")

ACTUATOR = f"{ROOT}/robots/leg/actuator.toml"
ROBOT = f"{ROOT}/robots/leg/robot.toml"
RIG = f"{ROOT}/examples/08-your-own-loop/muscle.toml"
WALK = f"{ROOT}/experiments/walk-test-1.toml"

_made: Dict[Tuple[str, ...], str] = {}


def program(*words: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)


def exported(*words: str) -> str:
    """Return the file that `sinew fmu export WORDS` writes; each is exported once."""
    if words not in _made:
        path = os.path.join(WORK, f"{len(_made)}.fmu")
        done = program("fmu", "export", *words, "-o", path)
        assert done.returncode == 0, done.stderr
        _made[words] = path
    return _made[words]


_read: Dict[Tuple[str, ...], Fmu] = {}


def fmu(*words: str) -> Fmu:
    if words not in _read:
        _read[words] = Fmu(exported(*words))
    return _read[words]


def steps(seed: int, until: float, least: float = 1e-4, most: float = 7e-3) -> Iterator[Any]:
    """Return instants and lengths of random steps up to `until`, not on a grid."""
    chance, at = random.Random(seed), 0.0
    while at < until:
        length = chance.uniform(least, most)
        yield at, length
        at += length


def pulses(seed: int, count: int) -> "List[bool]":
    chance = random.Random(seed)
    return [chance.random() < 0.3 for _ in range(count)]
