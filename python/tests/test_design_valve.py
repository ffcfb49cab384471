"""Design of a valve: the flow that a time needs, valves of the catalogue, a valve of one's own."""

import unittest

import sinew
import sinew.design as design

TASK = {"volume": "50 mL", "supply": "6 bar gauge", "pressure": "4 bar gauge"}


class Valve(unittest.TestCase):
    """`sinew design valve` as a function."""

    def test_half_the_time_needs_twice_the_flow(self) -> None:
        """The flow is inverse in the time."""
        flow = [
            design.valve(**TASK, fill_time=time).report["sonic_conductance_m3_per_s_Pa"]
            for time in (0.1, 0.05)
        ]
        self.assertAlmostEqual(flow[1] / flow[0], 2, places=9)

    def test_valves_that_suffice_are_first(self) -> None:
        """The table begins with them, in the order of their flow."""
        valves = design.valve(**TASK, fill_time="100 ms").report["valves"]
        order = ["yes", "perhaps", "unknown", "no"]
        found = [order.index(valve["suffices"]) for valve in valves]
        self.assertEqual(found, sorted(found))
        self.assertIsNone(
            next(v for v in valves if v["valve"] == "smc-s070")["sonic_conductance_m3_per_s_Pa_low"]
        )

    def test_a_valve_of_ones_own_is_judged(self) -> None:
        """A flow as published is converted; what it misses is in words."""
        small = design.valve(**TASK, flow="Cv 0.04", fill_time="20 ms")
        self.assertIn("too small to fill", small.refused)
        self.assertAlmostEqual(small.report["given_cv"], 0.04)

    def test_wrong_settings_are_refused(self) -> None:
        """The message begins with the keyword."""
        with self.assertRaisesRegex(sinew.InputError, "^pressure: found 7 bar gauge"):
            design.valve(**{**TASK, "pressure": "7 bar gauge"}, fill_time=0.1)


if __name__ == "__main__":
    unittest.main()
