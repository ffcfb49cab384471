"""Typical first use of the installed package. Prints its results; fails if one is wrong."""

import os
import time

import numpy

import sinew
import sinew.gym

# 1. Two hundred gains, and the best of them.
began = time.monotonic()
air = sinew.shipped("experiments/leg-in-air.toml")
key = "joint.hip.angle_gain"
rows = sinew.sweep(air, {key: numpy.linspace(1e-4, 4e-3, 200)}, report="joints.hip.tracking_rms_rad")
figure = "joints.hip.tracking_rms [rad]"
best = min((row for row in rows if row["status"] == "ok"), key=lambda row: float(row[figure]))
gain = best[f"{key} [1/count]"]
alone = sinew.run(air, {key: gain})
assert len(rows) == 200
assert alone.summary["joints"]["hip"]["tracking_rms_rad"] == best[figure]
plain = sinew.run(air).summary["joints"]["hip"]["tracking_rms_rad"]
assert best[figure] < 0.8 * plain
print(
    f"journey: 200 gains in {time.monotonic() - began:.1f} s; the best, {gain * 100:.3f} %/count, "
    f"tracks to {numpy.degrees(best[figure]):.2f} deg, the thesis's to {numpy.degrees(plain):.2f} deg"
)

# The installed package finds the search module, which is in another folder.
with open("hip.toml", "w", encoding="utf-8") as file:
    file.write(
        f'format = "sinew.tuning/1"\ntitle = "A hip that tracks"\nexperiment = "{air}"\n'
        f'tune = ["{key}=0.02:0.15 %/count log"]\n'
        'minimize = ["joints.hip.tracking_rms_rad [deg]"]\npopulation = 6\ngenerations = 3\n'
    )
tuned = sinew.tune("hip.toml", "hip.db")
print(f"journey: a search of {tuned['candidates']} candidates, {len(tuned['best'])} best")

# 2. Ten thousand steps of an environment.
began, steps, episodes, way = time.monotonic(), 0, 0, 0.0
env = sinew.gym.Env("walk")
env.action_space.seed(1)
seen, _ = env.reset(seed=1)
while steps < 10_000:
    seen, reward, terminated, truncated, _ = env.step(env.action_space.sample())
    assert numpy.isfinite(seen).all()
    steps, way = steps + 1, way + reward
    if terminated or truncated:
        seen, _ = env.reset()
        episodes += 1
assert episodes >= 30
print(f"journey: 10,000 steps in {time.monotonic() - began:.1f} s, {way / episodes:.2f} m in an episode")

# 3. A run is kept and read back.
kept = sinew.run(sinew.shipped("experiments/walk-test-1.toml"), folder="run")
again = sinew.read_run("run")
for channel in kept.channels:
    same = numpy.array_equal(kept[channel.name], again[channel.name], equal_nan=True)
    assert same, channel.name
assert all(verdict["is"] for verdict in again.verdicts)
print(f"journey: a run of {len(kept.channels)} channels kept in {os.listdir('run')} and read back")
