"""Four steps of the thesis's leg: runs them, stores the run in a folder, and reads its numbers."""

import tempfile
from typing import Any

import sinew


def number(summary: Any, key: str) -> None:
    """Print one of a run's figures, by its dotted key."""
    value = summary
    for part in key.split("."):
        value = value[part]
    print(f"  {key:<36} {value:.4g}")


experiment = sinew.shipped("experiments/walk-test-1.toml")
with tempfile.TemporaryDirectory() as folder:
    walk = sinew.run(experiment, folder=f"{folder}/walk")
    print(walk.summary["title"])
    for key in (
        "trolley.distance_m",
        "trolley.mean_speed_m_per_s",
        "joints.hip.passiveness",
        "joints.knee.passiveness",
        "air_used_kg",
    ):
        number(walk.summary, key)

    print("\nreported beside ours")
    for verdict in walk.verdicts:
        print(f"  {verdict['key']}: {verdict['reported']}, ours {verdict['ours']}: {verdict['is']}")

    # All figures can be computed again from the log.
    same = sinew.read_run(walk.folder).summary == walk.summary
    print(f"\nfrom the log: {'the same numbers' if same else 'other numbers'}")

    # Overrides one value of a file.
    easy = sinew.run(experiment, {"trolley.drag": "0 lbf"}, folder=f"{folder}/easy")
    print("\nwithout drag")
    number(easy.summary, "trolley.distance_m")
    number(easy.summary, "trolley.mean_speed_m_per_s")
