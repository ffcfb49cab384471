#!/usr/bin/env python3
"""Writes forces.csv of this lesson: forces of 20 mm muscles, as a test rig would have measured them.

The forces are those of a published law, fitted by its authors to tests of Festo muscles of 20 mm:

    F/F_max = a0 (exp(-a1 r) - 1) + (p/620 kPa) exp(-a3 r^2)     F_max = 620 kPa k1 atan(k2 (L - 7.5 mm) 620 kPa)

r: contraction relative to the largest one, 24 % here (our assumption: it is not published with the law).
Each reading has noise of 2 N, and the muscles of a batch differ in strength by 2 %.
"""
import csv
import math
import pathlib
import random

A0, A1, A3 = 0.25785, 6.47661, 1.32088
K1, K2 = 1.4877, 0.0248  # [N/kPa], [1/(kPa m)]
LARGEST = 0.24  # largest contraction [-]
NOISE = random.Random(14)


def force(rest_length: float, length: float, pressure: float) -> float:
    """Return the force [N] at lengths [m] and a gauge pressure [kPa]."""
    most = 620 * K1 * math.atan(K2 * (rest_length - 0.0075) * 620)
    r = (1 - length / rest_length) / LARGEST
    return most * (A0 * (math.exp(-A1 * r) - 1) + pressure / 620 * math.exp(-A3 * r * r))


rows = []
for rest_length in (0.13, 0.18, 0.24, 0.3):
    strength = 1 + NOISE.gauss(0, 0.02)
    for share in (0, 0.04, 0.08, 0.12, 0.16, 0.20):
        for pressure in range(0, 601, 100):
            length = rest_length * (1 - share)
            newtons = max(strength * force(rest_length, length, pressure), 0) + NOISE.gauss(0, 2)
            rows.append([1e3 * rest_length, f"{1e3 * length:.1f}", pressure, f"{newtons:.1f}"])
with open(pathlib.Path(__file__).parent / "forces.csv", "w", newline="", encoding="utf-8") as file:
    out = csv.writer(file, lineterminator="\n")
    out.writerow(["rest_length [mm]", "length [mm]", "pressure [kPa gauge]", "force [N]"])
    out.writerows(rows)
