"""A load hangs on one braided muscle. The integration loop is ours; Sinew has the laws: tension of the muscle,
volume of its air, flow through the open valve.

    x' = v      M v' = M g - F(x, v, p)      m' = inflow      x downward, length = x

    p = p_atm (m / V / rho_atm)^n, [40]
"""

import os
from typing import NamedTuple

import sinew

LOAD = sinew.quantity("10 lb", "kg")
WEIGHT = LOAD * 9.80665
HOSES = sinew.quantity("0.495 in3", "m3")
STEP = 5e-4  # [s]
OPENS, SHUTS = 0.004, 0.001  # delays of the valve [s]
EXPONENT, DENSITY = 1.4, 101352.9322095749 / (286.98629312304 * 293.33333333333333)  # n, rho_atm

here = os.path.dirname(os.path.abspath(__file__))
muscle = sinew.Actuator(os.path.join(here, "muscle.toml"))
valve = sinew.Valve(os.path.join(here, "valves.toml"), "inlet")
supply = muscle.atmosphere + sinew.quantity("100 psi gauge", "Pa gauge")


class State(NamedTuple):
    """Length [m], velocity [m/s], mass of air [kg]."""

    length: float
    velocity: float
    mass: float


def volume(length: float) -> float:
    """Return the volume of muscle and hoses [m3]."""
    return float(muscle.volume(length, 0.0)) + HOSES


def pressure(s: State) -> float:
    """Return the gauge pressure of the air [Pa], [40]."""
    return float(muscle.atmosphere * ((s.mass / volume(s.length) / DENSITY) ** EXPONENT - 1))


def tension(s: State) -> float:
    """Return the tension of the muscle, including losses [N]."""
    return max(0.0, float(muscle.tension(s.length, pressure(s), s.velocity)))


def slope(s: State, is_open: bool) -> State:
    """Return the state's derivative."""
    flow = float(valve.mass_flow(supply, pressure(s) + muscle.atmosphere)) if is_open else 0.0
    return State(s.velocity, (WEIGHT - tension(s)) / LOAD, flow)


def add(s: State, h: float, k: State) -> State:
    """Return the state after h seconds with that derivative."""
    return State(*(a + h * b for a, b in zip(s, k)))


def rk4(s: State, h: float, is_open: bool) -> State:
    """Return the state after a step. The air's mass is a state like length and velocity."""
    k1 = slope(s, is_open)
    k2 = slope(add(s, h / 2, k1), is_open)
    k3 = slope(add(s, h / 2, k2), is_open)
    k4 = slope(add(s, h, k3), is_open)
    return add(add(add(add(s, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4)


# Without air the load hangs in the stretched threads.
start = muscle.greatest_length + WEIGHT / 8.8e4
state, time = State(start, 0.0, DENSITY * volume(start)), 0.0

print("time [ms]  length [mm] gauge [kPa]  tension [N]  air [mg]")
for until in (0.0, 0.025, 0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0):
    while time < until:
        # The inlet has current from 0 to 50 ms and follows with delays. Steps end when it switches.
        opens, shuts = OPENS, 0.05 + SHUTS
        end = min([time + STEP, until] + [t for t in (opens, shuts) if t > time])
        state = rk4(state, end - time, opens <= time < shuts)
        time = end
    print(
        f"{1e3 * time:8.0f} {1e3 * state.length:12.2f} {pressure(state) / 1e3:14.1f} "
        f"{tension(state):11.2f} {1e6 * state.mass:11.3f}"
    )
