"""Every public name has a docstring, and every function of the library has a signature."""

import inspect
import types
import unittest
from typing import Any, Iterator, Tuple

import sinew
import sinew.gym
import sinew.identify


def public(module: types.ModuleType) -> Iterator[Tuple[str, Any]]:
    """Yield the public names of a module and of its classes."""
    for name in module.__all__:
        thing = getattr(module, name)
        yield f"{module.__name__}.{name}", thing
        if inspect.isclass(thing):
            for inner, member in vars(thing).items():
                described = callable(member) or isinstance(member, property)
                if not inner.startswith("_") and described:
                    yield f"{module.__name__}.{name}.{inner}", member


class Documentation(unittest.TestCase):
    def test_every_public_name_has_its_text(self) -> None:
        count = 0
        for module in (sinew, sinew.gym, sinew.identify):
            self.assertTrue(module.__doc__)
            for name, thing in public(module):
                if isinstance(thing, (str, tuple)):
                    continue
                count += 1
                text = inspect.getdoc(thing) or ""
                # pybind11's first line is only the signature.
                words = text.split("\n", 1)[-1] if text.startswith(name.split(".")[-1] + "(") else text
                self.assertGreater(len(words.strip()), 8, f"{name}: {text!r}")
        self.assertGreater(count, 100)

    def test_methods_of_identification_take_the_settings_of_the_library(self) -> None:
        called = {"static": "static_from", "force-beam": "force_beam"}
        for method in "dynamic joint pair valve sensor creep check scale run plan static force-beam".split():
            function = getattr(sinew.identify, called.get(method, method))
            rows = {row["keyword"] for row in sinew._sinew.identify_settings(method)}
            self.assertEqual(set(inspect.signature(function).parameters) - {"data"}, rows, method)
            for keyword in rows:
                self.assertRegex(inspect.getdoc(function) or "", rf"(?m)^{keyword}( \[.*\])?: ", method)


if __name__ == "__main__":
    unittest.main()
