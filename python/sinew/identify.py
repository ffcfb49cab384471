"""Parameters from measurements.

    import sinew.identify as identify

    found = identify.static(length, pressure, force, rest_length=0.25)
    found.model, found.report["parameters"], found.report["cross_validated"]
    found.write("my-actuator.toml")
    sinew.Actuator("my-actuator.toml").tension(0.22, 3e5)

    print(identify.check("forces.csv", rest_length="102 mm", diameter="10 mm"))

    identify.valve("fill.csv", volume="0.5 L").write("my-valve.toml")
    identify.valve({"time": t, "pressure": p}, volume=5e-4)

Each method of `sinew identify` is a function: the same report, the same file. It takes measurements as
one table, or several where it says so: a CSV file's path; a dict, pandas frame or structured array of
columns; or a Table, which says what foreign columns mean. Settings are as the program's: a number in the
SI unit that is told here, or text with a unit, "6 lb".

Functions raise RefusalError where the data support no answer, sinew.InputError for what is wrong with a
table or a setting, and TypeError for what is none. What the numbers mean, and what is refused:
docs/how-to/characterise.md and the pages of docs/theory that it names.
"""

from sinew._sinew import RefusalError
from sinew._found import Checked, Found, Joint, Plan, Static, Valve
from sinew._identify_motion import creep, dynamic, joint, pair, run
from sinew._identify_parts import force_beam, geometry, geometry_from_trapezoids, sensor, valve
from sinew._identify_static import check, columns, plan, scale, static, static_from, template
from sinew._tables import Table

__all__ = [
    "Checked",
    "Found",
    "Joint",
    "Plan",
    "RefusalError",
    "Static",
    "Table",
    "Valve",
    "check",
    "columns",
    "creep",
    "dynamic",
    "force_beam",
    "geometry",
    "geometry_from_trapezoids",
    "joint",
    "pair",
    "plan",
    "run",
    "scale",
    "sensor",
    "static",
    "static_from",
    "template",
    "valve",
]
