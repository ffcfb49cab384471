"""How comments become the reference: what stands where in a header, and in a binding of Python."""

import os
import re
import sys
import unittest
from typing import Dict, List, Set

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../tools/site"))

import comments  # noqa: E402
from api import Name, documented, share_texts  # noqa: E402
from names import blocks_of  # noqa: E402
from python_pages import docs_of, prose, setting_rows  # noqa: E402


def converted(text: str) -> List[str]:
    """The lines of a header below its own comment."""
    lines = ["// a/b.h - a test.", "#pragma once"] + text.strip("\n").split("\n")
    return comments.convert(lines)[2:]


def name(kind: str, word: str, line: int, **more: str) -> Name:
    return Name(kind, word, word, "a/b.h", line, **more)


class Settings(unittest.TestCase):
    def test_each_method_has_those_of_its_table(self) -> None:
        rows = setting_rows(os.path.join(os.path.dirname(__file__), "../../sinew/identify/task"))
        self.assertGreater(len(rows), 11)
        self.assertIn("`moment_arm` [m]: is known, at the rest angle.", rows["joint"])
        self.assertIn("`tie`: NAME=OTHER: two parameters that are one.", rows["pair"])
        self.assertTrue(set(rows["check"]) < set(rows["static"]))


class Headers(unittest.TestCase):
    def test_lines_keep_their_numbers(self) -> None:
        text = ["// a/b.h - a test", "// of two lines.", "#pragma once", "", "// Adds.", "int add(int a);  // [m]", ""]
        made = comments.convert(text)
        self.assertEqual(len(made), len(text))
        self.assertEqual(made[0], "/// @file")
        self.assertIn("int add(int a);", made[5])

    def test_a_comment_in_front_is_the_declarations(self) -> None:
        made = converted("// Adds a \\f and <b>.\n// Twice.\nint add(int a);")
        self.assertEqual(made[0], "/// @verbatim Adds a \\f and <b>.")
        self.assertEqual(made[1], "/// Twice. @endverbatim")

    def test_a_comment_behind_is_the_members(self) -> None:
        made = converted("struct A {\n  int a = 0;  // first\n              // and more\n};")
        self.assertEqual(made[1], "  int a = 0;  ///< @verbatim< first")
        self.assertEqual(made[2].strip(), "///< and more @endverbatim")

    def test_a_comment_behind_an_enum_is_not_its_last_values(self) -> None:
        made = converted("enum class A { b, c };  // two")
        self.assertEqual(made[0], "/** @verbatim< two @endverbatim */ enum class A { b, c };")

    def test_others_stay(self) -> None:
        for text in ("// --- a heading ---\n\nint a();", "int f() {\n  // inside\n  return 1;  // one\n}",
                     'const char* a = "// none";', "inline int f() { return 1; }\n// at the end\n}"):
            self.assertNotIn("@verbatim", "\n".join(converted(text)), text)

    def test_behind_a_body_of_several_lines(self) -> None:
        made = converted("struct A {\n  int f() const {\n    return 1;\n  }  // one [N]\n};")
        self.assertEqual(made[3], "  }  ///< @verbatim< one [N] @endverbatim")

    def test_a_namespace_that_doxygen_would_read_otherwise(self) -> None:
        made = converted("namespace sinew::signals {\nsignals::Tick f(); // signals::Tick")
        self.assertIn("signalsNamespace {", made[0])
        self.assertIn("signalsNamespace::Tick f();", made[1])
        self.assertIn("@verbatim< signals::Tick", made[1])


class Groups(unittest.TestCase):
    def test_a_comment_holds_up_to_an_empty_line(self) -> None:
        source = ["// Both.", "int a();", "int b();", "", "int c();"]
        a, b, c = name("function", "a", 2, text="Both."), name("function", "b", 3), name("function", "c", 5)
        share_texts([a, b, c], source)
        self.assertTrue(documented(a) and documented(b))
        self.assertFalse(documented(c))

    def test_variables_of_one_line(self) -> None:
        a, b = name("variable", "a", 1), name("variable", "b", 1, behind="[m], [s]")
        share_texts([a, b], ["double a, b;  // [m], [s]"])
        self.assertEqual((a.behind, b.behind), ("[m]", "[s]"))
        a, b = name("variable", "a", 1), name("variable", "b", 1, behind="of both")
        share_texts([a, b], ["double a, b;  // of both"])
        self.assertEqual((a.behind, b.behind), ("of both", "of both"))

    def test_usual_members_need_no_words(self) -> None:
        for signature in ("A(const A&) =delete", "~A()", "bool operator==(const A&) const"):
            self.assertTrue(documented(name("function", "A", 1, signature=signature)), signature)

    def test_a_struct_is_described_by_its_members(self) -> None:
        whole, part = name("struct", "A", 1), name("struct", "B", 9)
        whole.members = [name("variable", "a", 2, behind="[m]")]
        part.members = whole.members + [name("variable", "b", 3)]
        self.assertTrue(documented(whole))
        self.assertFalse(documented(part))


class Words(unittest.TestCase):
    def test_what_is_indented_stays_as_it_is(self) -> None:
        made = blocks_of("One\ntwo.\n\n  a = b\n\n  c = d\n\n* point\n  goes on\n* other")
        self.assertEqual([kind for kind, _ in made], ["p", "pre", "li", "li"])
        self.assertEqual(made[1][1], ["  a = b", "", "  c = d"])
        self.assertEqual(made[2][1], ["* point", "  goes on"])

    def test_docstrings(self) -> None:
        self.assertEqual(prose("Takes `a` < b.\n\n    a = 1"),
                         '<p>Takes <code>a</code> &lt; b.</p>\n<pre class="as-it-stands"><code>a = 1</code></pre>')


class Bindings(unittest.TestCase):
    def found(self, text: str) -> Dict[str, str]:
        return docs_of(text)

    def test_members_of_a_class(self) -> None:
        found = self.found('py::class_<A, std::shared_ptr<A>>(m, "A", "An " "a.")\n'
                           '  .def("f", [](A& a, int b) { return a.f("no", b); }, py::arg("b"), "Does \\"f\\".\\nSo.")\n'
                           '  .def(py::init<int>(), "Makes.");\nm.def("g", &g, "Does g.");')
        self.assertEqual(found, {"A": "An a.", "A.f": 'Does "f".\nSo.', "A.__init__": "Makes.", "g": "Does g."})

    def test_a_class_that_several_functions_fill(self) -> None:
        found = self.found('using Class = py::class_<A>;\nvoid more(Class& c) { c.def("f", &f, "Does f."); }\n'
                           'void bind(py::module_& m) { Class c(m, "A", "An a."); more(c); }')
        self.assertEqual(found, {"A": "An a.", "A.f": "Does f."})

    def test_what_has_no_words_is_not_there(self) -> None:
        self.assertEqual(self.found('py::class_<A>(m, "A").def("__repr__", [](A&) { return "<A>"; });'), {})


class Bibliography(unittest.TestCase):
    """The keys of references.bib, the anchors of bibliography.md and what the theory pages cite are the same."""

    FOLDER = os.path.join(os.path.dirname(__file__), "../../docs/theory")

    def read(self, name: str) -> str:
        with open(os.path.join(self.FOLDER, name), encoding="utf-8") as file:
            return file.read()

    def keys(self) -> List[str]:
        return re.findall(r"^@\w+\{([^,\s]+),", self.read("references.bib"), re.M)

    def cited(self) -> Dict[str, Set[str]]:
        pages = [f for f in os.listdir(self.FOLDER) if f.endswith(".md") and f != "bibliography.md"]
        return {page: set(re.findall(r"\]\(bibliography\.md#([^)]+)\)", self.read(page))) for page in pages}

    def test_each_key_is_there_once_and_in_both(self) -> None:
        keys = self.keys()
        self.assertGreater(len(keys), 0)
        self.assertEqual(len(keys), len(set(keys)))
        self.assertEqual(sorted(keys), sorted(re.findall(r'<a name="([^"]+)">', self.read("bibliography.md"))))

    def test_what_a_page_cites_is_in_the_bibliography(self) -> None:
        for page, cited in self.cited().items():
            self.assertEqual(cited - set(self.keys()), set(), page)

    def test_every_entry_has_a_title_and_a_balanced_body(self) -> None:
        for entry in re.split(r"^@", self.read("references.bib"), flags=re.M)[1:]:
            self.assertIn("title ", entry)
            self.assertEqual(entry.count("{"), entry.count("}"), entry)


if __name__ == "__main__":
    unittest.main()
