"""Actuator and valve as functions: the program's numbers, in arrays."""

import unittest
from typing import Any, List

import numpy

import sinew
from common import ACTUATOR, VALVES, Refusals, program_json


class Actuator(unittest.TestCase):
    def test_numbers_are_the_programs(self) -> None:
        muscle = sinew.Actuator(ACTUATOR)
        said = program_json(
            "actuator", ACTUATOR, "--length", "0.07m:0.09m:0.005m", "--pressure",
            "100 kPa gauge:400 kPa gauge:100 kPa diff", "--velocity", "-0.05 m/s", "--json",
        )  # fmt: skip
        self.assertEqual(muscle.shortest_length, said["shortest_length_m"])
        self.assertEqual(muscle.greatest_length, said["greatest_length_m"])
        points = said["points"]
        length = numpy.array([p["length_m"] for p in points])
        pressure = numpy.array([p["gauge_pressure_Pa"] for p in points])
        self.assertEqual(list(muscle.tension(length, pressure)), [p["tension_N"] for p in points])
        sliding = muscle.tension(length, pressure, -0.05)
        for one, (x, p) in zip(sliding, zip(length, pressure)):
            self.assertEqual(one, muscle.point(x, p, -0.05)["sliding_tension_N"])
        self.assertEqual(points[3], muscle.point(length[3], pressure[3], -0.05))

    def test_arrays_are_broadcast(self) -> None:
        muscle = sinew.Actuator(ACTUATOR)
        length = numpy.linspace(1.01 * muscle.shortest_length, 0.09, 7)[:, None]
        pressure = numpy.linspace(0, 4e5, 5)
        laws: "List[Any]" = [muscle.tension, muscle.volume, muscle.stiffness]
        for law in [*laws, muscle.sealed_stiffness]:
            table = law(length, pressure)
            self.assertEqual(table.shape, (7, 5))
            self.assertEqual(table[2, 3], law(length[2, 0], pressure[3]))
        self.assertIsInstance(muscle.tension(0.08, 2e5), float)
        # More pressure pulls more, between the lengths where a braid works.
        self.assertTrue(bool((numpy.diff(muscle.tension(length, pressure), axis=1) > 0).all()))

    def test_stiffness_is_the_slope_of_the_tension(self) -> None:
        muscle = sinew.Actuator(ACTUATOR)
        length = numpy.linspace(0.065, 0.085, 11)
        step = 1e-7
        slope = (muscle.tension(length + step, 3e5) - muscle.tension(length - step, 3e5)) / (2 * step)
        error = numpy.abs(slope / muscle.stiffness(length, 3e5) - 1)
        self.assertLess(float(error.max()), 1e-5)


class Valve(unittest.TestCase):
    def test_numbers_are_the_programs(self) -> None:
        inlet = sinew.Valve(VALVES, "inlet")
        for up, down in ((8e5, 1e5), (8e5, 7e5), (2e5, 1.9e5), (1e5, 8e5)):
            said = program_json(
                "valve", VALVES, "inlet", "--upstream", f"{up} Pa abs", "--downstream",
                f"{down} Pa abs", "--quiet", "--json",
            )  # fmt: skip
            self.assertEqual(inlet.mass_flow(up, down), said["mass_flow_kg_per_s"])
        flow = inlet.mass_flow(8e5, numpy.linspace(0, 8e5, 50))
        choked = inlet.choked(8e5, numpy.linspace(0, 8e5, 50))
        self.assertEqual(len(set(flow[choked.astype(bool)])), 1)
        self.assertTrue(bool((numpy.diff(flow) <= 0).all()))


class Wrong(Refusals):
    def test_inputs_are_refused_in_words(self) -> None:
        muscle, inlet = sinew.Actuator(ACTUATOR), sinew.Valve(VALVES, "inlet")
        nan = float("nan")
        self.refused(
            [
                (lambda: sinew.Actuator("nowhere.toml"), sinew.InputError, "nowhere.toml"),
                (lambda: sinew.Actuator(VALVES), sinew.InputError, "actuator"),
                (lambda: sinew.Actuator(ACTUATOR, "other"), sinew.InputError, "other"),
                (lambda: sinew.Actuator(ACTUATOR, "", -1.0), ValueError, "external_volume"),
                (lambda: sinew.Actuator(3), TypeError, "expected a path"),  # type: ignore[arg-type]
                (lambda: muscle.tension(-0.1, 2e5), ValueError, "length: found -0.1 m"),
                (lambda: muscle.tension(nan, 2e5), ValueError, "length: found nan"),
                (lambda: muscle.tension(0.08, 1e9), ValueError, "pressure: found 1000000000"),
                (lambda: muscle.tension(0.08, -2e5), ValueError, "vacuum"),
                (lambda: muscle.tension(0.08, 2e5, 1e6), ValueError, "velocity: found"),
                (lambda: muscle.tension(0.08, 2e5, nan), ValueError, "velocity: found nan"),
                (lambda: muscle.tension([0.08, 0.07], [1e5, 2e5, 3e5]), ValueError, "broadcast"),
                (lambda: muscle.tension("0.08", 1e5), TypeError, "length: found '0.08'"),
                (lambda: muscle.tension(0.08 + 1j, 1e5), TypeError, "expected real numbers"),
                (lambda: muscle.tension(None, 1e5), TypeError, "found None"),  # type: ignore[arg-type]
                (lambda: muscle.tension([[1.0], [1.0, 2.0]], 1e5), TypeError, "length: found [["),
                (lambda: muscle.point(0.08, nan), ValueError, "pressure: found nan"),
                (lambda: muscle.volume(9.0, 1e5), ValueError, "length: found 9 m"),
                (lambda: sinew.Valve(ACTUATOR), sinew.InputError, "valve"),
                (lambda: sinew.Valve(VALVES), sinew.InputError, "inlet"),
                (lambda: sinew.Valve(VALVES, "inlte"), sinew.InputError, "inlet"),
                (lambda: inlet.mass_flow(-1.0, 1e5), ValueError, "upstream: found -1 Pa"),
                (lambda: inlet.mass_flow(1e5, nan), ValueError, "downstream: found nan"),
            ]
        )


if __name__ == "__main__":
    unittest.main()
