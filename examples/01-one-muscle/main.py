"""One braided muscle and one valve: tables of their laws."""

import numpy

import sinew

muscle = sinew.Actuator(sinew.shipped("robots/leg/actuator.toml"))

# Tension decreases as the muscle shortens, and trapped air makes it stiffer.
pressure = sinew.quantity("60 psi gauge", "Pa gauge")
length = numpy.arange(65, 96, 5) / 1e3
tension = muscle.tension(length, pressure)
stiffness = muscle.stiffness(length, pressure)
sealed = muscle.sealed_stiffness(length, pressure)
print("length [mm]  tension [N]  k at p [N/m]  k sealed [N/m]")
for x, pull, open_, shut in zip(length, tension, stiffness, sealed):
    print(f"{1e3 * x:11.0f} {pull:12.2f} {open_:13.1f} {shut:15.1f}")

print("\ngauge [kPa]  tension [N]  effectiveness")
for kpa in range(100, 701, 200):
    at = muscle.point(0.085, 1e3 * kpa)
    print(f"{kpa:11d} {at['tension_N']:12.2f} {at['effectiveness']:14.4f}")

# A pressure needs a reference, gauge or abs.
try:
    sinew.quantity("60 psi", "Pa gauge")
except sinew.InputError as error:
    print(f"\n{error}")

valve = sinew.Valve(sinew.shipped("robots/leg/valves.toml"), "758")
supply = sinew.quantity("100 psi gauge", "Pa abs")
print("\ninto [kPa abs]  flow [g/s]")
for kpa in range(100, 701, 200):
    choked = "  choked" if valve.choked(supply, 1e3 * kpa) else ""
    print(f"{kpa:14d} {1e3 * valve.mass_flow(supply, 1e3 * kpa):11.4f}{choked}")
