"""A braided muscle as an FMU in an external co-simulation master at 1 kHz. Class Slave does not depend on
Sinew: it works with any FMU of FMI 2.0 with these variables."""

import ctypes
import math
import os
import tempfile
import xml.etree.ElementTree
import zipfile
from typing import Dict, List, Tuple

import sinew

STEP = 1e-3  # 1 kHz [s]
ARM, INERTIA = 0.02, 0.02  # of the muscle [m]; of the lever [kg m^2]
WEIGHT, DAMPING = 1.2, 0.3  # torque of the load [N m]; [N m s/rad]
REST = 0.0864  # length at angle 0 [m]


class Slave:
    """FMU of FMI 2.0: unpacks, loads and instantiates it. Values are accessed by name; all are real except for
    the valves' currents."""

    def __init__(self, path: str) -> None:
        folder = tempfile.mkdtemp()
        zipfile.ZipFile(path).extractall(folder)
        root = xml.etree.ElementTree.parse(f"{folder}/modelDescription.xml").getroot()
        simulation = root.find("CoSimulation")
        assert simulation is not None
        name = simulation.get("modelIdentifier", "")
        self.lib = ctypes.CDLL(f"{folder}/binaries/linux64/{name}.so")
        self.references: Dict[str, int] = {}
        for variable in root.iter("ScalarVariable"):
            self.references[variable.get("name", "")] = int(variable.get("valueReference", ""))
        make = self.lib.fmi2Instantiate
        make.restype = ctypes.c_void_p
        callbacks = (ctypes.c_void_p * 5)()  # no logger and no allocation functions
        self.handle = ctypes.c_void_p(
            make(name.encode(), 1, root.get("guid", "").encode(), f"{folder}/resources".encode(),
                 callbacks, 0, 0)
        )  # fmt: skip

    def call(self, function: str, *arguments: object) -> None:
        status = getattr(self.lib, "fmi2" + function)(self.handle, *arguments)
        if status != 0:
            raise RuntimeError(f"fmi2{function}: status {status}")

    def initialize(self) -> None:
        zero = ctypes.c_double(0)
        self.call("SetupExperiment", 0, zero, zero, 0, zero)
        self.call("EnterInitializationMode")
        self.call("ExitInitializationMode")

    def get(self, name: str) -> float:
        value = ctypes.c_double()
        self.call("GetReal", ctypes.byref(ctypes.c_uint(self.references[name])), 1, ctypes.byref(value))
        return value.value

    def set(self, name: str, value: float) -> None:
        at = ctypes.byref(ctypes.c_uint(self.references[name]))
        self.call("SetReal", at, 1, ctypes.byref(ctypes.c_double(value)))

    def switch(self, name: str, on: bool) -> None:
        at = ctypes.byref(ctypes.c_uint(self.references[name]))
        self.call("SetBoolean", at, 1, ctypes.byref(ctypes.c_int(on)))

    def step(self, time: float) -> None:
        self.call("DoStep", ctypes.c_double(time), ctypes.c_double(STEP), 0)

    def state(self) -> ctypes.c_void_p:
        out = ctypes.c_void_p()
        self.call("GetFMUstate", ctypes.byref(out))
        return out

    def back_to(self, state: ctypes.c_void_p) -> None:
        self.call("SetFMUstate", state)


Lever = Tuple[float, float]  # angle [rad], rate [rad/s]


def moved(lever: Lever, tension: float) -> Lever:
    """Return the lever a step later, computed in ten small steps with constant tension."""
    angle, rate = lever
    for _ in range(10):
        rate += STEP / 10 * (ARM * tension - WEIGHT - DAMPING * rate) / INERTIA
        if angle <= 0 and rate < 0:  # a stop
            rate = 0.0
        angle += STEP / 10 * rate
    return angle, rate


def run(muscle: Slave, lever: Lever, begin: int, end: int, pulses: bool) -> Lever:
    """Run our controller, our body and the FMU's muscle from one millisecond to another."""
    for k in range(begin, end):
        muscle.switch("inlet", pulses and lever[0] < 0.4363 and k % 25 < 6)
        later = moved(lever, muscle.get("tension"))
        muscle.set("length", REST - ARM * lever[0])
        muscle.set("rate", -ARM * (later[0] - lever[0]) / STEP)
        muscle.step(k * STEP)
        lever = later
    return lever


def row(milliseconds: int, lever: Lever, muscle: Slave) -> None:
    print(
        f"{milliseconds:8d} {math.degrees(lever[0]):11.3f} {muscle.get('gauge_pressure') / 1e3:12.2f} "
        f"{muscle.get('tension'):12.3f} {1e6 * muscle.get('air_mass'):9.3f}"
    )


here = os.path.dirname(os.path.abspath(__file__))
path = os.path.join(tempfile.mkdtemp(), "muscle.fmu")
made = sinew.export_fmu(os.path.join(here, "../08-your-own-loop/muscle.toml"), path)
shown: List[str] = [v["name"] for v in made["variables"] if v["causality"] in ("input", "output")]
print(f"{made['kind']}: {', '.join(shown)}\n")

muscle = Slave(path)
muscle.set("length", REST)
muscle.initialize()
print("time [ms]  angle [deg]  gauge [kPa]  tension [N]  air [mg]")
lever: Lever = (0.0, 0.0)
row(0, lever, muscle)
for k in range(400, 801, 400):
    lever = run(muscle, lever, k - 400, k, pulses=True)
    row(k, lever, muscle)
    if k == 400:
        kept = (lever, muscle.state())

# Back to 400 ms; from there on both valves stay closed.
lever, state = kept
muscle.back_to(state)
lever = run(muscle, lever, 400, 800, pulses=False)
print("again from 400 ms, with the valves shut:")
row(800, lever, muscle)
