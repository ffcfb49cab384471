"""Samples and figures of a walk, another gait of the same leg, the best of several gains, and a muscle's law."""

import numpy

import sinew

walk = sinew.Experiment(sinew.shipped("experiments/walk-test-1.toml"))
print(f"{walk.title}: {walk.duration:.1f} s, seed {walk.seed}")
stiffness = walk.origin("control.stiffness.hip")
print(
    f"the hip is as stiff as {walk['control.stiffness.hip']:.3f} {stiffness['unit']}, "
    f"{stiffness['text']} in {stiffness['source']}"
)

# A run gives arrays and figures.
recording = sinew.run(walk)
angle = numpy.degrees(recording["/joint/hip/angle"])
topics = {channel.name.partition(".")[0] for channel in recording.channels}
print(f"{len(topics)} topics; the hip moves from {angle.min():.0f} to {angle.max():.0f} deg")
print(f"the trolley goes {recording.summary['trolley']['distance_m']:.3f} m")
for verdict in recording.verdicts[:3]:
    print(f"  {verdict['key']}: {verdict['ours']}, reported {verdict['reported']}: {verdict['is']}")

# A run that is controlled by the program: two continuations from the same time.
leg = sinew.Simulation(walk)
leg.advance(2.2)
soft = leg.copy()
soft.change("control.stiffness.hip", 1.0)
for one, name in ((leg, "as planned"), (soft, "with a soft hip")):
    one.advance(1.5)
    print(f"{name}: at {one.time:.1f} s the trolley is at {one.read('/true/trolley/position'):.3f} m")

# Many runs, on two cores. Numbers are in SI.
key = "joint.hip.angle_gain"
rows = sinew.sweep(
    sinew.shipped("experiments/leg-in-air.toml"),
    {key: numpy.linspace(1e-4, 2e-3, 20)},
    report="joints.hip.tracking_rms_rad [deg]",
    threads=2,
)
best = min(rows, key=lambda row: float(row["joints.hip.tracking_rms [deg]"]))
print(
    f"of {len(rows)} gains {100 * best[key + ' [1/count]']:.3f} %/count tracks best, "
    f"to {best['joints.hip.tracking_rms [deg]']:.2f} deg"
)

# Laws without a simulation, for arrays.
muscle = sinew.Actuator(sinew.shipped("robots/leg/actuator.toml"))
length = numpy.array([0.065, 0.075, 0.085])
pull = muscle.tension(length[:, None], numpy.array([2e5, 4e5]))
for x, row in zip(length, pull):
    print(f"at {1e3 * x:.0f} mm it pulls {row[0]:.1f} N at 2 bar and {row[1]:.1f} N at 4 bar")
