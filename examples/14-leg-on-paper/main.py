"""The leg on paper, from Python: calculators against the simulator, for 50 muscles and 20 seeds of the sensors' noise."""

import os
import pathlib
import shutil
import tempfile

import numpy

import sinew
import sinew.design as design
import sinew.identify as identify

HERE = pathlib.Path(__file__).resolve().parent
LEVER, GRAVITY = 0.15, 9.80665  # [m], [m/s2]
MUSCLES, SEEDS = 50, range(1, 21)
SCALE = "actuator.festo20.effectiveness.scale"  # strength of the braid


def joint(actuator: str, **task: str) -> design.Design:
    """Return the design of the lesson, of another muscle or for another task."""
    return design.joint(actuator=actuator, angles="60 deg", pressure="6 bar gauge", external_volume="5 cm3",
                        moment_arm="8 mm", **task)  # fmt: skip


def torque_of(strength: float) -> float:
    """Return the weakest torque with a muscle of this strength [N m]."""
    text = f'format = "sinew.actuator/1"\nbase = "leg-muscle.toml"\n[effectiveness]\nscale = {strength}\n'
    pathlib.Path("one.toml").write_text(text, encoding="utf-8")
    return float(joint("one.toml", torque="2 N m").report["torque_Nm"])


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name in ("forces.csv", "robot.toml", "lift.toml", "hold.toml"):
        shutil.copy(HERE / name, name)
    identify.static_from("forces.csv", diameter="20 mm", name="festo20").write("muscle.toml")
    identify.scale("muscle.toml", rest_length="140 mm").write("leg-muscle.toml")

    leg = joint("leg-muscle.toml", load="1 kg", lever="150 mm", time="0.3 s", base="robot.toml", joint_name="knee")
    leg.write("leg.toml")
    wanted, low, torque, high = (
        leg.report[key] for key in ("torque_wanted_Nm", "torque_Nm_low", "torque_Nm", "torque_Nm_high")
    )
    print(f"weakest torque {torque:.2f} N m, 95 %: {low:.2f} to {high:.2f} N m; {wanted:.2f} N m are needed")

    # Muscles whose torques scatter as the interval of the design states.
    scale = sinew.Experiment("lift.toml")[SCALE]
    slope = (torque_of(1.01 * scale) - torque_of(0.99 * scale)) / (0.02 * scale)
    deviation = (high - low) / (2 * 1.96) / slope
    strengths = scale + deviation * numpy.random.default_rng(14).standard_normal(MUSCLES)
    torques = numpy.array([torque_of(strength) for strength in strengths])
    print(f"{numpy.sum((torques >= low) & (torques <= high))} of {MUSCLES} muscles are within the interval")

    # Each holds 2 % less than its torque, and not 2 % more.
    hold = sinew.Ensemble(
        "hold.toml",
        [SCALE, "link.shank.mass", "seed"],
        ["phases.lift.joints.knee.end_angle_true_rad", "muscles.knee_flexor.air_used_kg"],
    )
    loads = [(s, share * t / LEVER / GRAVITY, seed)
             for share in (0.98, 1.02) for s, t in zip(strengths, torques) for seed in SEEDS]  # fmt: skip
    angle, air = hold(loads).T.reshape(2, 2, -1)
    lifted = numpy.sum(numpy.degrees(angle) < 180, axis=1)
    print(f"loads of 98 % of the torque are lifted in {lifted[0]} of 1000 runs, of 102 % in {lifted[1]}")
    designed = leg.report["air_per_stroke_kg"]
    print(f"air of a stroke: {1e3 * designed:.3f} g designed, {1e3 * air[0].mean():.3f} g simulated")

    # The load of the design is lifted in time.
    lift = sinew.Ensemble("lift.toml", [SCALE, "seed"], ["phases.lift.mean_duration_s"])
    time = lift([(s, seed) for s in strengths for seed in SEEDS])[:, 0]
    print(f"60 deg in {time.min():.2f} to {time.max():.2f} s: {numpy.sum(time <= 0.3)} of 1000 within 0.3 s")
