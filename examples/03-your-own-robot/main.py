"""Your own robot, described only in TOML: its values with their sources, its best gain, and how a wrong key
is refused."""

import math
import os

import sinew

file = sinew.shipped("experiments/one-joint.toml")
lever = sinew.Experiment(file)
for key in ("joint.lever.angle_gain", "muscle.flexor.mount_length"):
    origin = lever.origin(key)
    print(f"{key} = {lever[key]:.6g} {origin['unit']}, written {origin['text']}")
    print(f"  of {os.path.basename(origin['file'])}, line {origin['line']}: {origin['source']}")

print("\ngain [%/count]  tracking [deg]  passiveness  air [g]")
for gain in ("0.03", "0.06", "0.12", "0.24", "0.48"):
    found = sinew.run(lever, {"joint.lever.angle_gain": f"{gain} %/count"}).summary
    tracking = math.degrees(found["joints"]["lever"]["tracking_rms_rad"])
    print(f"{gain:>14} {tracking:15.2f} {found['passiveness']:12.3f} {1e3 * found['air_used_kg']:8.3f}")

# An error is reported before anything runs, with parts that a program can use.
try:
    lever.vary({"joint.lever.angle_gian": "0.3 %/count"})
except sinew.InputError as error:
    problem = error.problems[0]
    print(f"\nrefused: {problem.key}\n  found {problem.found}\n  try {problem.try_this}")
