#!/usr/bin/env python3
"""Writes the two files of this lesson, as a laboratory in Germany would have recorded them.

    make_data.py SINEW

The data are simulated: the muscle on the rig is that of truth.toml, and the recorded machine has a heavier
lever, more damping and more friction than the robot of the lesson. The force cell, the encoder and the
pressure sensors are noisy, and the recorder's clock is 0.3 % fast. The correct result of the lesson is
therefore known.
"""
import csv
import json
import pathlib
import random
import subprocess
import sys
import tempfile
from typing import List, Union

SINEW = str(pathlib.Path(sys.argv[1]).resolve())
HERE = pathlib.Path(__file__).resolve().parent
NOISE = random.Random(13)

# Differences of the recorded machine from the robot of the lesson.
OTHERWISE = {
    "link.lever.mass": "0.30 kg",
    "link.lever.inertia": "580 kg mm2",
    "joint.lever.damping": "0.12 N m s/rad",
    "joint.lever.dry_friction": "0.09 N m",
}
CLOCK = 1.003  # the recorder counts 1.003 s per second
STARTED = 1.37  # the recorder was started this long before the machine [s]


def sinew(*words: str, cwd: Union[str, pathlib.Path]) -> str:
    return subprocess.run([SINEW, *words], cwd=cwd, check=True, capture_output=True, text=True).stdout


def german(value: float, digits: int) -> str:
    return f"{value:.{digits}f}".replace(".", ",")


def write(name: str, lines: List[str]) -> None:
    # As Excel writes it: a byte order mark, CR LF, semicolons.
    (HERE / name).write_bytes(("\ufeff" + "\r\n".join(lines) + "\r\n").encode())


def force_map() -> None:
    """Measure at seven pressures, each with twelve lengths up and down."""
    lengths = [150 + 5 * i for i in range(12)]
    rows = []
    for pressure in (0.5, 1, 2, 3, 4, 5, 6):
        for length in lengths + lengths[-2::-1]:
            out = sinew("actuator", "truth.toml", "--length", f"{length} mm", "--pressure",
                        f"{pressure} bar gauge", "--json", cwd=HERE)
            force = json.loads(out)["points"][0]["tension_N"]
            # A slack muscle does not push on the force cell.
            rows.append((length + NOISE.gauss(0, 0.05), pressure + NOISE.gauss(0, 0.004),
                         max(force, 0) + NOISE.gauss(0, 0.3)))
    lines = ["Prüfstand 2;;", "Länge (mm);Druck (bar);Kraft (N)"]
    lines += [";".join((german(l, 2), german(p, 3), german(f, 2))) for l, p, f in rows if f > 2]
    write("kennlinie.csv", lines)


def recording() -> None:
    """Record the machine at 100 Hz, ten times up and down: angle and gauge pressures."""
    with tempfile.TemporaryDirectory() as work:
        # The robot is made with the muscle that the lesson identifies, and then gets the true one.
        muscle = pathlib.Path(work) / "muskel.toml"
        sinew("identify", "static", str(HERE / "kennlinie.csv"), "--map", "length=Länge,pressure=Druck,force=Kraft",
              "--unit", "Druck=bar gauge", "--rest-length", "200 mm", "--name", "muskel", "-o", str(muscle), cwd=work)
        sinew("new", "robot", "arm", "--metric", "--actuator", "muskel.toml", cwd=work)
        muscle.write_text((HERE / "truth.toml").read_text().replace('"truth"', '"muskel"'))
        sinew("new", "experiment", "heben", "--metric", "--of", "arm/robot.toml", cwd=work)
        sets = [word for key, value in OTHERWISE.items() for word in ("--set", f"{key}={value}")]
        sinew("run", "heben.toml", "-o", "run", "--no-report", "--set", "log.period=10 ms",
              "--set", "sequence.repeat=10", *sets, cwd=work)
        sinew("export", "run", "--csv", "-o", "run.csv", cwd=work)
        with open(pathlib.Path(work) / "run.csv", encoding="utf-8", newline="") as file:
            table = list(csv.DictReader(file))
    names = list(table[0])

    def column(begin: str) -> str:
        return next(n for n in names if n.startswith(begin))

    time = column("time")
    angle = column("/true/joint/lever/angle")
    flexor, extensor = (column(f"/true/muscle/{m}/pressure") for m in ("flexor", "extensor"))
    samples = [(float(r[time]), *(float(r[c]) for c in (angle, flexor, extensor))) for r in table if r[angle]]
    step = samples[1][0] - samples[0][0]
    before = int(STARTED / step)
    samples = [(t - before * step, *samples[0][1:]) for t in (step * i for i in range(before))] + samples
    lines = ["Zeit (ms);Winkel (°);Druck Beuger (bar);Druck Strecker (bar)"]
    start = samples[0][0]
    for t, a, f, e in samples:
        degrees = a * 180 / 3.141592653589793
        bars = [(p - 101350) / 1e5 + NOISE.gauss(0, 0.01) for p in (f, e)]
        lines.append(";".join((german((t - start) * CLOCK * 1e3, 2), german(degrees + NOISE.gauss(0, 0.15), 2),
                               german(bars[0], 3), german(bars[1], 3))))
    write("aufnahme.csv", lines)


force_map()
recording()
