"""An FMU conforms to the standard: its archive, modelDescription.xml and exported functions."""

import itertools
import os
import re
import subprocess
import unittest
import zipfile
from typing import Any

from common import ACTUATOR, RIG, ROBOT, WALK, exported, fmu, program
from importer import Fmu

KINDS = {
    "tube": (ACTUATOR,),
    "muscle": (RIG,),
    "joint": (ROBOT, "--joint", "hip"),
    "machine": (WALK, "--input", "control.stiffness.knee", "--parameter", "joint.hip.damping"),
}
ALL = [(kind, words, version) for (kind, words), version in itertools.product(KINDS.items(), "23")]

# Functions that FMI 2.0 declares for co-simulation (sections 2.1 and 4.2), and FMI 3.0 for all interfaces.
FUNCTIONS_2 = """GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment
EnterInitializationMode ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean GetString
SetReal SetInteger SetBoolean SetString GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize
SerializeFMUstate DeSerializeFMUstate GetDirectionalDerivative SetRealInputDerivatives
GetRealOutputDerivatives DoStep CancelStep GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus
GetStringStatus""".split()
TYPES_3 = "Float32 Float64 Int8 UInt8 Int16 UInt16 Int32 UInt32 Int64 UInt64 Boolean String Binary Clock"
FUNCTIONS_3 = """GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation
InstantiateScheduledExecution FreeInstance EnterInitializationMode ExitInitializationMode EnterEventMode
Terminate Reset GetNumberOfVariableDependencies GetVariableDependencies GetFMUState SetFMUState
FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState GetDirectionalDerivative
GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode GetIntervalDecimal GetIntervalFraction
GetShiftDecimal GetShiftFraction SetIntervalDecimal SetIntervalFraction SetShiftDecimal SetShiftFraction
EvaluateDiscreteStates UpdateDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep SetTime
SetContinuousStates GetContinuousStateDerivatives GetEventIndicators GetContinuousStates
GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode
GetOutputDerivatives DoStep ActivateModelPartition""".split() + [
    way + kind for way in ("Get", "Set") for kind in TYPES_3.split()
]

BEFORE_VARIABLES = ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment"]
IDENTIFIER = r"([A-Za-z_][A-Za-z0-9_]*|'[^']+')(\[\d+\])?"
STRUCTURED = re.compile(rf"{IDENTIFIER}(\.{IDENTIFIER})*")


class Archive(unittest.TestCase):
    def test_has_what_belongs_there(self) -> None:
        for kind, words, version in ALL:
            with self.subTest(kind=kind, version=version):
                f = fmu(*words, "--fmi", version)
                self.assertEqual(f.files[0], "modelDescription.xml")
                self.assertIn("documentation/index.html", f.files)
                self.assertTrue(os.path.exists(f.binary))
                self.assertTrue(re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", f.identifier))
                has_sources = any(name.startswith("sources/") for name in f.files)
                self.assertEqual(has_sources, kind != "machine")
                self.assertEqual(
                    "sources/buildDescription.xml" in f.files, version == "3" and kind != "machine"
                )

    def test_is_the_same_bytes_again(self) -> None:
        for words in KINDS.values():
            again = exported(*words, "--name", "again"), exported(*words, "--name", "again", "--force")
            with open(again[0], "rb") as first, open(again[1], "rb") as second:
                self.assertEqual(first.read(), second.read())

    def test_has_no_dates(self) -> None:
        with zipfile.ZipFile(exported(RIG)) as archive:
            self.assertEqual({info.date_time[:3] for info in archive.infolist()}, {(1980, 1, 1)})


class Description(unittest.TestCase):
    def test_elements_stand_in_the_schemas_order(self) -> None:
        for kind, words, version in ALL:
            with self.subTest(kind=kind, version=version):
                root = fmu(*words, "--fmi", version).root
                self.assertEqual(root.tag, "fmiModelDescription")
                tags = [element.tag for element in root]
                self.assertEqual(tags, BEFORE_VARIABLES + ["ModelVariables", "ModelStructure"])

    def test_variables_are_as_their_causality_allows(self) -> None:
        for kind, words, version in ALL:
            f = fmu(*words, "--fmi", version)
            units = {unit.get("name") for unit in f.root.iter("Unit")}
            references = [v.reference for v in f.variables.values()]
            self.assertEqual(len(set(references)), len(references))
            for v in f.variables.values():
                with self.subTest(kind=kind, version=version, name=v.name):
                    self.assertTrue(STRUCTURED.fullmatch(v.name))
                    self.assertEqual(v.start is not None, v.causality in ("input", "parameter"))
                    if v.causality == "parameter":
                        self.assertEqual(v.variability, "fixed")
                        self.assertEqual(v.attributes["initial"], "exact")
                    else:
                        self.assertNotIn("initial", v.attributes)
                        jumps = v.kind != "Real" or (kind == "machine" and v.causality == "input")
                        self.assertEqual(v.variability, "discrete" if jumps else "continuous")
                    if v.unit is not None:
                        self.assertIn(v.unit, units)
                    if v.start is not None and v.kind != "Boolean":
                        self.assertLessEqual(float(v.attributes.get("min", "-inf")), v.start)
                        self.assertGreaterEqual(float(v.attributes.get("max", "inf")), v.start)
            self.assertEqual([v.causality for v in f.variables.values()].count("independent"), 1)

    def test_structure_names_each_output_once(self) -> None:
        for kind, words, version in ALL:
            with self.subTest(kind=kind, version=version):
                f = fmu(*words, "--fmi", version)
                order = list(f.variables.values())
                structure = f.root.find("ModelStructure")
                assert structure is not None
                two = version == "2"
                key, more = ("index", 1) if two else ("valueReference", 0)
                lists = [structure.findall("Outputs/Unknown" if two else "Output")]
                lists.append(structure.findall("InitialUnknowns/Unknown" if two else "InitialUnknown"))
                outputs = [k for k, v in enumerate(order) if v.causality == "output"]
                for found in lists:
                    self.assertEqual([int(e.get(key, "-1")) - more for e in found], outputs)
                for element in lists[0]:
                    for known in element.get("dependencies", "").split():
                        self.assertEqual(order[int(known) - more].causality, "input")

    def test_units_are_those_of_si(self) -> None:
        """A few units are checked by hand; the FMU of a machine also has volts and counts."""
        expected = {
            "N": {"kg": "1", "m": "1", "s": "-2"},
            "Pa": {"kg": "1", "m": "-1", "s": "-2"},
            "N/m": {"kg": "1", "s": "-2"},
            "m3": {"m": "3"},
            "kg/(s Pa)": {"m": "1", "s": "1"},
        }
        found = {unit.get("name"): unit for unit in fmu(RIG).root.iter("Unit")}
        for name, base in expected.items():
            inner = found[name].find("BaseUnit")
            assert inner is not None
            self.assertEqual(dict(inner.attrib), base)
        bar = found["Pa"].find("DisplayUnit[@name='bar']")
        assert bar is not None
        self.assertAlmostEqual(float(bar.get("factor", "0")), 1e-5, delta=1e-20)


class Binary(unittest.TestCase):
    def test_exports_all_functions_and_nothing_else(self) -> None:
        for kind in ("muscle", "machine"):
            listed = subprocess.run(
                ["nm", "-D", "--defined-only", fmu(*KINDS[kind]).binary],
                capture_output=True, text=True, check=True,
            ).stdout  # fmt: skip
            found = {line.split()[-1] for line in listed.splitlines()}
            expected = {"fmi2" + name for name in FUNCTIONS_2} | {"fmi3" + n for n in FUNCTIONS_3}
            self.assertEqual(found, expected)

    def test_needs_the_c_library_alone(self) -> None:
        for kind in ("muscle", "machine"):
            dynamic = subprocess.run(
                ["readelf", "-d", fmu(*KINDS[kind]).binary], capture_output=True, text=True, check=True
            ).stdout
            needed = set(re.findall(r"NEEDED.*\[(.*)\]", dynamic))
            self.assertLessEqual(needed, {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"})
            versions = subprocess.run(
                ["objdump", "-T", fmu(*KINDS[kind]).binary], capture_output=True, text=True, check=True
            ).stdout
            newest = max(int(minor) for minor in re.findall(r"GLIBC_2\.(\d+)", versions))
            self.assertLessEqual(newest, 35)  # the version stated in docs/how-to/fmu.md

    def test_start_values_are_those_of_the_description(self) -> None:
        for kind, words, version in ALL:
            f = fmu(*words, "--fmi", version)
            slave = f.instantiate()
            for v in f.variables.values():
                if v.start is not None:
                    with self.subTest(kind=kind, version=version, name=v.name):
                        self.assertEqual(slave.get(v.name), v.start)
            slave.free()

    def test_its_sources_give_the_same_bits(self) -> None:
        def compiled(version: str) -> Any:
            folder = fmu(RIG, "--fmi", version).folder
            flags = ["-O1", "-ffp-contract=off", "-fvisibility=hidden", "-fPIC", "-shared", "-I."]
            return subprocess.Popen(
                ["g++", "-std=c++20", *flags, f"fmi{version}.cpp", "-o", f"{folder}/built.so"],
                cwd=f"{folder}/sources",
            )

        for build in [compiled(version) for version in "23"]:
            self.assertEqual(build.wait(), 0)
        for version in "23":
            f = fmu(RIG, "--fmi", version)
            built = f"{f.folder}/built.so"
            results = []
            for binary in (f.binary, built):
                other = Fmu(exported(RIG, "--fmi", version), binary=binary)
                slave = other.instantiate().initialize()
                slave.set("inlet", True)
                for k in range(40):
                    slave.step(k * 0.003, 0.003)
                results.append(slave.get_reals(["tension", "pressure", "air_mass"]))
                slave.free()
            self.assertEqual(results[0], results[1])


class Program(unittest.TestCase):
    def test_prints_what_it_wrote_as_json(self) -> None:
        import json

        done = program("fmu", "export", RIG, "-o", exported(RIG) + ".json.fmu", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        said = json.loads(done.stdout)
        names = [v["name"] for v in said["variables"]]
        self.assertEqual(names, list(fmu(RIG).variables))
        self.assertEqual(said["token"], fmu(RIG).token)
