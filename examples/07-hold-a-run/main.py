"""A walk that the program controls: advanced by periods, read, changed, saved and restored."""

import math

import sinew


def show(leg: sinew.Simulation, what: str) -> None:
    """Print the position of the leg and the air it has used."""
    hip = math.degrees(leg.read("/true/joint/hip/angle"))
    print(
        f"{leg.time:6.2f} s  {what:<26} hip {hip:6.2f} deg  "
        f"trolley {1e3 * leg.read('/true/trolley/position'):6.1f} mm  "
        f"air used {1e6 * leg.read('/true/muscle/hip_extensor/air_in'):5.0f} mg"
    )


leg = sinew.Simulation(sinew.shipped("experiments/walk-test-1.toml"))
show(leg, "at its start")
leg.advance(2.2)
show(leg, "in the first stance")

# Two continuations from the same time: as planned, and with a stiffer hip.
saved = leg.save()
leg.advance(0.8)
show(leg, "as planned")

leg.restore(saved)
leg.change("control.stiffness.hip", 6.0)  # N m/rad
leg.advance(0.8)
show(leg, "with a stiffer hip")

# Restored once more, it gives the same bits as the first time.
leg.restore(saved)
leg.advance(0.8)
show(leg, "as planned, once more")

# Our own controller: a setpoint every 10 ms, from a measurement.
for _ in range(100):
    if leg.ended:
        break
    leg.change("control.stiffness.knee", 1.5 if leg.read("/joint/knee/angle") < 5.0 else 3.0)
    leg.advance(0.01)
show(leg, "a second of our own words")
