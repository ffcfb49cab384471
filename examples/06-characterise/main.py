"""Your own muscle, from forces on a stand to a parameter file. The stand is simulated, and its muscle is
known, so that the result can be checked."""

import os
import tempfile
from typing import Any

import numpy

import sinew
import sinew.identify

here = os.path.dirname(os.path.abspath(__file__))


def measured_at(psi: int, folder: str) -> Any:
    """Return length [m], force [N] and pressure [Pa gauge] as recorded by hand at a stand."""
    kept = sinew.run(
        os.path.join(here, "pressures.toml"),
        {"charge.pressure": f"{psi} psi gauge"},
        folder=f"{folder}/{psi}",
        report=False,
    ).folder
    with open(f"{kept}/measured.csv", encoding="utf-8") as file:
        assert file.readline().strip() == "time [s],length [m],force [N],pressure [Pa gauge]"
        return numpy.loadtxt(file, delimiter=",")[:, 1:]


with tempfile.TemporaryDirectory() as work:
    rows = numpy.concatenate([measured_at(psi, work) for psi in range(10, 101, 10)])
    length, force, pressure = rows.T
    found = sinew.identify.static(length, pressure, force, source="a stand of ours")
    print(f"{len(rows)} points; rest length {1e3 * length.max():.1f} mm, the longest")

    print("model                     fit [%]  not seen [%]")
    for model in found.report["models"]:
        if "refused" not in model:
            fit, unseen = model["fit"]["rmse_percent"], model["cross_validated"]["rmse_percent"]
            chosen = "  <- chosen" if model["model"] == found.model else ""
            print(f"{model['model']:<24} {fit:8.2f} {unseen:13.2f}{chosen}")

    found.write(f"{work}/my-actuator.toml")
    mine = sinew.Actuator(f"{work}/my-actuator.toml")

stand = sinew.Actuator(sinew.shipped("robots/stand/equations.toml"))
print("\nat 80 mm  found [N]  true [N]")
for kpa in range(100, 601, 100):
    print(f"{kpa:4d} kPa {mine.tension(0.08, 1e3 * kpa):10.2f} {stand.tension(0.08, 1e3 * kpa):9.2f}")
