"""From a CSV of measured forces to a robot with such muscles: their law, its best gain, and the heaviest
forearm that it moves."""

import math
import os
import shutil
import tempfile

import numpy

import sinew
import sinew.identify

here = os.path.dirname(os.path.abspath(__file__))
csv = "../../data/martens_boblan_2017/DMSP-10-250_force_map.csv"

# The file's columns are pressure [Pa gauge], length [m] and force [N]; a force map does not contain the rest length.
pressure, length, force = numpy.loadtxt(os.path.join(here, csv), delimiter=",", skiprows=1).T
found = sinew.identify.static(length, pressure, force, rest_length=0.25, source=csv)
law = next(model for model in found.report["models"] if model["model"] == found.model)
print(
    f"{len(force)} points: {found.model}, to {law['fit']['rmse_percent']:.2f} % of the largest force, "
    f"{law['cross_validated']['rmse_percent']:.2f} % of what it did not see"
)
for p in law["parameters"]:
    unit = "" if p["unit"] == "1" else " " + p["unit"]
    print(f"  {p['name']:<20} {p['value']:10.4g}{unit}")

with tempfile.TemporaryDirectory() as folder:
    for name in ("robot.toml", "experiment.toml"):
        shutil.copy(os.path.join(here, name), folder)
    shutil.copy(sinew.shipped("robots/leg/valves.toml"), folder)
    found.write(f"{folder}/muscle.toml")
    experiment = sinew.Experiment(f"{folder}/experiment.toml")

    # The gain with the smallest tracking error.
    rows = sinew.sweep(
        experiment,
        ["joint.elbow.angle_gain=0.04:0.16:7 %/count"],
        report=["joints.elbow.tracking_rms_rad [deg]", "passiveness", "air_used_kg [g]"],
        threads=2,
    )
    print("\ngain [%/count]  tracking [deg]  passiveness  air [g]")
    for row in rows:
        print(
            f"{row['joint.elbow.angle_gain [%/count]']:14g} {row['joints.elbow.tracking_rms [deg]']:15.2f} "
            f"{row['passiveness']:12.3f} {row['air_used [g]']:8.3f}"
        )
    best = min(rows, key=lambda row: float(row["joints.elbow.tracking_rms [deg]"]))
    gain = best["joint.elbow.angle_gain [%/count]"]

    # The heaviest forearm that it moves with a tracking error below five degrees.
    tuned = experiment.vary({"joint.elbow.angle_gain": f"{gain} %/count"})
    masses = sinew.sweep(
        tuned,
        largest="link.forearm.mass=0.5:4:8 kg",
        where="joints.elbow.tracking_rms_rad < 5 deg",
        report="passiveness",
        threads=2,
    )
    mass = masses[0]["largest link.forearm.mass [kg]"]
    print(f"\nwith {gain:g} %/count it moves a forearm of up to {mass:.2f} kg within 5 deg")

    # Stored, so that its page can be opened.
    run = sinew.run(tuned, folder=f"{folder}/run")
    moved = math.degrees(run.summary["joints"]["elbow"]["excursion_rad"])
    print(
        f"a run of {tuned.duration:.1f} s: the elbow moves by {moved:.1f} deg, "
        f"peak tension {run.summary['muscles']['flexor']['peak_tension_N']:.0f} N"
    )
