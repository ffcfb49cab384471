"""Small importer of FMUs for Sinew's tests, written after the standard: it unpacks the archive, reads
modelDescription.xml and calls the binary through ctypes. It shares no code with the exporter.

`Fmu` reads and loads one; `Slave` is an instance, of FMI 2.0 or 3.0 alike.
"""

import ctypes
import os
import tempfile
import xml.etree.ElementTree as xml
import zipfile
from ctypes import POINTER, byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from typing import Any, Dict, List, Optional, Sequence

OK, WARNING, DISCARD, ERROR, FATAL, PENDING = range(6)

LOG_2 = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p, c_char_p)
LOG_3 = ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)
ALLOCATE = ctypes.CFUNCTYPE(c_void_p, c_size_t, c_size_t)
FREE = ctypes.CFUNCTYPE(None, c_void_p)


class Callbacks(ctypes.Structure):
    _fields_ = [
        ("logger", LOG_2),
        ("allocate", ALLOCATE),
        ("free", FREE),
        ("finished", c_void_p),
        ("environment", c_void_p),
    ]


class Failed(Exception):
    """A call that did not return OK, with its `status` and the log messages."""

    def __init__(self, function: str, status: int, said: Sequence[str]) -> None:
        super().__init__(f"{function}: {status}: {'; '.join(said)}")
        self.status = status


class Variable:
    def __init__(self, attributes: Dict[str, str], kind: str, values: Dict[str, str]) -> None:
        self.name = attributes["name"]
        self.reference = int(attributes["valueReference"])
        self.causality = attributes.get("causality", "local")
        self.variability = attributes.get("variability", "continuous")
        self.kind = {"Float64": "Real", "Int32": "Integer"}.get(kind, kind)
        self.unit = values.get("unit")
        self.attributes = {**attributes, **values}

    @property
    def start(self) -> Any:
        text = self.attributes.get("start")
        if text is None:
            return None
        if self.kind == "Boolean":
            return text == "true"
        return float(text) if self.kind == "Real" else int(text)


class Fmu:
    def __init__(self, path: str, binary: Optional[str] = None) -> None:
        self.folder = tempfile.mkdtemp(prefix="fmu of ")  # with a space, as in many users' paths
        with zipfile.ZipFile(path) as archive:
            assert archive.testzip() is None
            self.files = archive.namelist()
            archive.extractall(self.folder)
        self.root = xml.parse(os.path.join(self.folder, "modelDescription.xml")).getroot()
        self.version = int(self.root.get("fmiVersion", "0")[0])
        simulation = self.root.find("CoSimulation")
        assert simulation is not None
        self.identifier = simulation.get("modelIdentifier", "")
        self.token = self.root.get("guid" if self.version == 2 else "instantiationToken", "")
        self.variables: Dict[str, Variable] = {}
        model = self.root.find("ModelVariables")
        assert model is not None
        for element in model:
            inner = element[0] if self.version == 2 else element
            variable = Variable(dict(element.attrib), inner.tag, dict(inner.attrib))
            assert variable.name not in self.variables
            self.variables[variable.name] = variable
        platform = "linux64" if self.version == 2 else "x86_64-linux"
        self.binary = binary or os.path.join(
            self.folder, "binaries", platform, self.identifier + ".so"
        )
        self.library = ctypes.CDLL(self.binary, mode=os.RTLD_LOCAL | os.RTLD_NOW)

    @property
    def resources(self) -> str:
        place = os.path.join(self.folder, "resources")
        return "file://" + place.replace(" ", "%20") if self.version == 2 else place + "/"

    def instantiate(self, name: str = "slave", **other: Any) -> "Slave":
        return Slave(self, name, **other)


class Slave:
    """An instance. `said` holds its log messages."""

    def __init__(
        self,
        fmu: Fmu,
        name: Optional[str] = "slave",
        token: Optional[str] = "",
        resources: Optional[str] = "",
        kind: int = 1,
        logger: bool = True,
    ) -> None:
        self.fmu, self.lib, self.said = fmu, fmu.library, []  # type: ignore[var-annotated]
        self.pre = f"fmi{fmu.version}"
        token = fmu.token if token == "" else token
        resources = fmu.resources if resources == "" else resources
        texts = [None if t is None else t.encode() for t in (name, token, resources)]
        if fmu.version == 2:
            log = LOG_2(lambda e, i, s, c, f, m: self.said.append((f.replace(b"%s", m)).decode()))
            self.callbacks = Callbacks(log if logger else LOG_2(0), ALLOCATE(0), FREE(0), None, None)
            make = self.lib.fmi2Instantiate
            make.restype = c_void_p
            make.argtypes = [c_char_p, c_int, c_char_p, c_char_p, POINTER(Callbacks), c_int, c_int]
            self.handle = make(texts[0], kind, texts[1], texts[2], byref(self.callbacks), 0, 0)
        else:
            self.log = LOG_3(lambda e, s, c, m: self.said.append(m.decode()))
            make = self.lib.fmi3InstantiateCoSimulation
            make.restype = c_void_p
            make.argtypes = [c_char_p] * 3 + [c_bool] * 4 + [c_void_p, c_size_t, c_void_p]
            make.argtypes += [LOG_3, c_void_p]
            false = [False] * 4
            self.handle = make(*texts, *false, None, 0, None, self.log if logger else LOG_3(0), None)
        if not self.handle:
            raise Failed("instantiate", ERROR, self.said)

    def call(self, function: str, *arguments: Any) -> None:
        """Call fmi2… or fmi3…; raises Failed if it does not return OK."""
        entry = getattr(self.lib, self.pre + function)
        entry.restype = c_int
        before = len(self.said)
        status = entry(c_void_p(self.handle), *arguments)
        if status != OK:
            raise Failed(function, status, self.said[before:])

    def free(self) -> None:
        self.lib[self.pre + "FreeInstance"].restype = None
        self.lib[self.pre + "FreeInstance"](c_void_p(self.handle))
        self.handle = None

    # --- phases ---

    def initialize(
        self, start: float = 0.0, stop: Optional[float] = None, **values: Any
    ) -> "Slave":
        """Initialize for stepping; first set `values`, given by name with _ for dots."""
        self.enter(start, stop)
        for name, value in values.items():
            self.set(name, value)
        self.call("ExitInitializationMode")
        return self

    def enter(self, start: float = 0.0, stop: Optional[float] = None) -> None:
        last = c_double(stop or 0.0)
        if self.fmu.version == 2:
            self.call("SetupExperiment", 0, c_double(0), c_double(start), int(stop is not None), last)
            self.call("EnterInitializationMode")
        else:
            none = (c_bool(False), c_double(0))
            end = (c_bool(stop is not None), last)
            self.call("EnterInitializationMode", *none, c_double(start), *end)

    # --- values ---

    CTYPES_2 = {"Real": c_double, "Integer": c_int, "Boolean": c_int}
    CTYPES_3 = {"Real": c_double, "Integer": ctypes.c_int32, "Boolean": c_bool}
    NAMES_3 = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean"}

    def _function(self, way: str, kind: str) -> Any:
        if self.fmu.version == 2:
            return way + kind, self.CTYPES_2[kind]
        return way + self.NAMES_3[kind], self.CTYPES_3[kind]

    def raw(self, way: str, kind: str, references: Sequence[int], values: Any) -> Any:
        """Get or set values of a type by their value references."""
        function, of = self._function(way, kind)
        at = (c_uint * len(references))(*references)
        array = (of * len(references))(*values)
        sizes = [c_size_t(len(references))] if self.fmu.version == 3 else []
        self.call(function, at, c_size_t(len(references)), array, *sizes)
        return array

    def get(self, name: str) -> Any:
        v = self.fmu.variables[name]
        return self.raw("Get", v.kind, [v.reference], [0])[0]

    def get_reals(self, names: Sequence[str]) -> List[float]:
        references = [self.fmu.variables[name].reference for name in names]
        return list(self.raw("Get", "Real", references, [0.0] * len(names)))

    def set(self, name: str, value: Any) -> None:
        v = self.fmu.variables[name]
        self.raw("Set", v.kind, [v.reference], [value])

    # --- time ---

    def step(self, at: float, length: float) -> bool:
        """Return whether the model has reached its end."""
        if self.fmu.version == 2:
            self.call("DoStep", c_double(at), c_double(length), 1)
            return False
        event, ended, early, last = c_bool(), c_bool(), c_bool(), c_double()
        self.call(
            "DoStep", c_double(at), c_double(length), c_bool(True),
            byref(event), byref(ended), byref(early), byref(last),
        )  # fmt: skip
        assert not early.value and not event.value
        return ended.value

    # --- states ---

    def _state_names(self) -> Any:
        return ("FMUstate", "DeSerialize") if self.fmu.version == 2 else ("FMUState", "Deserialize")

    def state(self) -> c_void_p:
        out = c_void_p()
        self.call("Get" + self._state_names()[0], byref(out))
        return out

    def back_to(self, state: c_void_p) -> None:
        self.call("Set" + self._state_names()[0], state)

    def free_state(self, state: c_void_p) -> None:
        self.call("Free" + self._state_names()[0], byref(state))

    def serialized(self) -> bytes:
        state, size = self.state(), c_size_t()
        name = self._state_names()[0]
        self.call(f"Serialized{name}Size", state, byref(size))
        out = ctypes.create_string_buffer(size.value)
        self.call(f"Serialize{name}", state, out, size)
        self.free_state(state)
        return out.raw

    def deserialized(self, saved: bytes) -> c_void_p:
        name, way = self._state_names()
        out = c_void_p()
        self.call(way + name, ctypes.create_string_buffer(saved, len(saved)),
                  c_size_t(len(saved)), byref(out))  # fmt: skip
        return out
