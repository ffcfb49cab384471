"""How comments of a header become those of the reference, and docstrings a page; the bibliography."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from typing import Dict, List, Set

HERE = os.path.dirname(os.path.abspath(__file__))
SITE = os.path.join(HERE, "../../tools/site")
sys.path.insert(0, SITE)

from python_pages import docstring, prose  # noqa: E402


def converted(text: str, name: str = "b.h") -> List[str]:
    """The lines of a header below its own comment."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write("// a/b.h - a test.\n#pragma once\n" + text.strip("\n") + "\n")
        made = subprocess.run(["awk", "-f", os.path.join(SITE, "comments.awk"), path], capture_output=True, text=True, check=True)
    return made.stdout.split("\n")[:-1][2:]


class Headers(unittest.TestCase):
    def test_a_comment_in_front_is_the_declarations(self) -> None:
        self.assertEqual(converted("// Adds \\f and <b>.\n// Twice.\nint add(int a);"),
                         ["/** %Adds \\\\f and \\<b\\>.", "%Twice. */", "int add(int a);"])

    def test_a_comment_behind_is_the_members(self) -> None:
        made = converted("struct A {\n  int a = 0;  // first\n              // and more\n};")
        self.assertEqual(made[1:3], ["  int a = 0;  /**< first", "and more */"])

    def test_a_comment_behind_an_enum_is_not_its_last_values(self) -> None:
        self.assertEqual(converted("enum class A { b, c };  // two")[0].strip(), "/** two */ enum class A { b, c };")

    def test_a_comment_holds_up_to_an_empty_line(self) -> None:
        made = converted("// Both.\nint a();\nint b();\n\nint c();")
        self.assertEqual(made, ["/** %Both. */", "int a();", "/** %Both. */ int b();", "", "int c();"])

    def test_variables_of_one_line_have_their_parts(self) -> None:
        made = converted("double a, b;  // [m], [s]\ndouble c = 1, d;  // of both")
        self.assertEqual([re.sub(" +", " ", line).strip() for line in made], [
            "/** [m] */ double a; /** [s] */ double b;",
            "/** of both */ double c = 1; /** of both */ double d;"])

    def test_indented_lines_stay_as_they_are(self) -> None:
        made = converted("// Returns F:\n//\n//   F = a *b\n//\n//   b < 1\n// here.\nint f();")
        self.assertEqual(made, ["/** %Returns F:", " @details @verbatim", "F = a *b", "", "b < 1", "@endverbatim here. */", "int f();"])

    def test_the_name_of_a_file_has_the_comment_of_the_file(self) -> None:
        self.assertEqual(converted("class TwoLinks {\n};", "two_links.h")[0].split(), "/** A test. */ class TwoLinks {".split())

    def test_other_comments_are_left_out(self) -> None:
        for text in ("// --- a heading ---\n\nint a();", "int f() {\n  // inside\n  return 1;  // one\n}",
                     'const char* a = "// none";', "inline int f() { return 1; }\n// at the end\n}"):
            made = converted(text)
            self.assertNotIn("/**", "\n".join(made), text)
            self.assertEqual(len(made), text.count("\n") + 1)

    def test_a_class_of_a_private_part_is_left_out(self) -> None:
        made = converted("class A {\n private:\n  class B;\n};\n\nclass A::B {\n  int c;\n};")
        self.assertNotIn("int c", "\n".join(made))
        self.assertEqual(len(made), 8)

    def test_a_namespace_that_doxygen_would_read_otherwise(self) -> None:
        self.assertEqual(converted("signals::Tick f(sinew::signals::Tick t);"), ["sinew::signals::Tick f(sinew::signals::Tick t);"])


class Undocumented(unittest.TestCase):
    def findings(self, warnings: str, text: str = "") -> int:
        search = ('<field name="type">struct</field>\n<field name="name">sinew::A</field>\n'
                  f'<field name="text">{text}</field>\n')
        with tempfile.TemporaryDirectory() as folder:
            for name, words in (("a.xml", search), ("a.txt", warnings)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(words)
            return subprocess.run(["awk", "-f", os.path.join(SITE, "undocumented.awk"), "a.xml", "a.txt"], cwd=folder,
                                  env={**os.environ}, capture_output=True).returncode

    def test_functions_and_classes_need_a_comment(self) -> None:
        for name in ("Member f(int) (function) of namespace sinew", "Compound sinew::A", "Member A (enumeration) of namespace sinew"):
            self.assertEqual(self.findings(f"a.h:1: warning: {name} is not documented.\n"), 1, name)

    def test_usual_members_need_none(self) -> None:
        for name in ("A(const A &)=delete", "~A()", "operator==(const A &) const", "begin() const"):
            self.assertEqual(self.findings(f"a.h:1: warning: Member {name} (function) of class sinew::A is not documented.\n"), 0, name)

    def test_a_struct_is_described_by_its_members(self) -> None:
        one = "a.h:1: warning: Member a (variable) of struct sinew::A is not documented.\n"
        self.assertEqual(self.findings(one, "Has a comment"), 0)
        self.assertEqual(self.findings(one, "Described by its members"), 1)


class Docstrings(unittest.TestCase):
    def test_paragraphs_examples_and_settings(self) -> None:
        self.assertEqual(prose("Takes `a` < b.\n\n    a = 1\n\nrest [m]: its length.\nname: of it."),
                         '<p>Takes <code>a</code> &lt; b.</p>\n<pre class="as-it-stands"><code>a = 1</code></pre>\n'
                         "<ul>\n<li><code>rest</code> [m]: its length.</li>\n<li><code>name</code>: of it.</li>\n</ul>")

    def test_signatures_of_the_binding_are_left_out(self) -> None:
        def of() -> None:
            """f(self: sinew._sinew.A, b: int) -> int

            Does f."""

        self.assertEqual(docstring(of), "Does f.")


class Bibliography(unittest.TestCase):
    """The keys of references.bib, the anchors of bibliography.md and what the theory pages cite are the same."""

    FOLDER = os.path.join(HERE, "../../docs/theory")

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
