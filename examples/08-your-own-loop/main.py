"""A mass on a lever with one muscle, in a loop at 10 kHz outside of Sinew. The muscle, its valves, its hose
and its supply are read from a file."""

import math
import os

import sinew

STEP = 1e-4  # 10 kHz [s]
ARM, INERTIA = 0.02, 0.02  # of the muscle [m]; of the lever [kg m^2]
WEIGHT, DAMPING = 1.2, 0.3  # torque of the load [N m]; [N m s/rad]
REST = 0.0864  # length at angle 0 [m]

here = os.path.dirname(os.path.abspath(__file__))
pull = sinew.DrivenMuscle(os.path.join(here, "muscle.toml"), length=REST)
atmosphere = sinew.quantity("14.7 psi abs", "Pa abs")

angle = rate = 0.0
print("time [ms]  angle [deg]  gauge [kPa]  tension [N]  air [mg]")
for k in range(8001):
    # Our controller: 40 pulses per second of 6 ms until 25 degrees, then none.
    wanted = angle < 0.4363
    pull.inlet(wanted and k % 250 < 60)
    if k % 1000 == 0:
        print(
            f"{1e3 * pull.time:8.0f} {math.degrees(angle):11.3f} "
            f"{(pull.pressure - atmosphere) / 1e3:12.2f} {pull.tension:12.3f} "
            f"{1e6 * pull.air_mass:9.3f}"
        )

    # Our equation of motion, semi-implicit Euler.
    rate += STEP * (ARM * pull.tension - WEIGHT - DAMPING * rate) / INERTIA
    if angle <= 0 and rate < 0:  # a stop
        rate = 0.0
    angle += STEP * rate
    pull.advance(STEP, REST - ARM * angle)
