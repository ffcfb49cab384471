"""The Python lines of README.md: one muscle, and one walk with and without the trolley's drag."""

import sinew

muscle = sinew.Actuator(sinew.shipped("robots/leg/actuator.toml"))
pressure = sinew.quantity("60 psi gauge", "Pa gauge")
print(f"85 mm long, the muscle pulls with {muscle.tension(0.085, pressure):.1f} N")

for drag in ("1.03 lbf", "0 lbf"):  # as the leg's file has it; none
    walk = sinew.run(sinew.shipped("experiments/walk-test-1.toml"), {"trolley.drag": drag})
    trolley = walk.summary["trolley"]  # SI; walk["/joint/hip/angle"] is an array
    print(f"{trolley['distance_m']:.2f} m at {trolley['mean_speed_m_per_s']:.2f} m/s")
