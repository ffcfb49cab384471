"""Braided pneumatic actuators, their air and valves, and the robots that they move.

    import sinew

    recording = sinew.run(sinew.shipped("experiments/walk-test-1.toml"))
    angle = recording["/joint/hip/angle"]          # an array, in rad
    recording.summary["joints"]["hip"]             # figures, in SI

    leg = sinew.Simulation(sinew.shipped("experiments/walk-test-1.toml"))
    leg.advance(2.0)
    leg.change("control.stiffness.hip", 3.0)       # N m/rad

Values are in SI unless stated otherwise; channels state their unit. Faults of a file raise InputError
with the messages of `sinew check`.
"""

from sinew._sinew import (
    Actuator,
    BoardError,
    Channel,
    DrivenMuscle,
    Ensemble,
    Experiment,
    InputError,
    LogError,
    Loop,
    Problem,
    RecordedChannel,
    Recording,
    RunError,
    Setting,
    Simulation,
    Valve,
    compare,
    convert,
    export_fmu,
    import_recording,
    in_units,
    figures,
    key_schema,
    keys,
    list_files,
    migrate,
    new_file,
    quantity,
    read_run,
    replay,
    run,
    shown,
    step_all,
    sweep,
    tune,
)
from sinew._sinew import version as __version__
from sinew._film import film
from sinew._shipped import shipped
from sinew._pandas import to_pandas
from sinew._parts import Part, Robot

__all__ = [
    "Actuator",
    "BoardError",
    "Channel",
    "DrivenMuscle",
    "Ensemble",
    "Experiment",
    "InputError",
    "LogError",
    "Loop",
    "Part",
    "Problem",
    "RecordedChannel",
    "Recording",
    "Robot",
    "RunError",
    "Setting",
    "Simulation",
    "Valve",
    "compare",
    "convert",
    "export_fmu",
    "import_recording",
    "in_units",
    "figures",
    "film",
    "key_schema",
    "keys",
    "list_files",
    "migrate",
    "new_file",
    "quantity",
    "read_run",
    "replay",
    "run",
    "shipped",
    "shown",
    "step_all",
    "sweep",
    "to_pandas",
    "tune",
    "__version__",
]
