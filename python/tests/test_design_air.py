"""How long a store of air lasts: design.air."""

import pathlib
import tempfile

import sinew
from common import ACTUATOR, WALK, Refusals, program, program_json
from sinew import design


class Air(Refusals):
    def test_a_run_gives_what_the_program_prints(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            run = str(pathlib.Path(folder) / "walk")
            program("run", str(WALK), "-o", run, "--no-report", "--quiet")
            found = design.air(use=run, volume="1 L", pressure="200 bar gauge", mass=1.2)
            printed = program_json("design", "air", "--use", run, "--volume", "1 L", "--pressure",
                                   "200 bar gauge", "--mass", "1.2 kg", "--json")
        self.assertEqual(found.report, printed)
        self.assertLess(found.report["time_s_low"], found.report["time_s"])
        self.assertEqual(len(found.report["limits"]), 2)

    def test_more_muscles_last_shorter(self) -> None:
        def time(muscles: int) -> float:
            found = design.air(use=ACTUATOR, volume=1e-3, pressure=2e7, line=6e5, muscles=muscles,
                               cycles=1, length=0.08, contraction=0.2)
            return float(found.report["time_s"])

        self.assertAlmostEqual(time(18) / time(36), 2, 9)

    def test_what_is_refused(self) -> None:
        low = design.air(use=ACTUATOR, volume=1e-3, pressure=5e5, line=6e5, muscles=18, cycles=1,
                         length=0.08, contraction=0.2)
        self.assertIn("no design: the store has 5 bar gauge", low.refused)
        self.refused([
            (lambda: design.air(use=ACTUATOR, volume="1,5 L", pressure=2e7), sinew.InputError,
             'found "1,5 L"'),
            (lambda: design.air(use=ACTUATOR, volume=1e-3, pressure=2e7), sinew.InputError,
             "cycles: found nothing"),
            (lambda: design.air(volume=1e-3, pressure=2e7), sinew.InputError, "use"),
        ])
