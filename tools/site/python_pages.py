"""Reference of the Python package: names and docstrings of the built package, signatures of its sources
and of its .pyi, one page for each module."""

import ast
import glob
import html
import importlib
import inspect
import os
import re
import textwrap
from typing import Any, Dict, List, Tuple

MODULES = ("sinew", "sinew.identify", "sinew.gym")
SETTING = re.compile(r"^(\w+)(?= \[[^\]]*\]: |: )(?=.*\.$)")
Definitions = Dict[Tuple[str, str], ast.stmt]


def definitions(package: str) -> Definitions:
    """Top-level definitions of the package's files by module and name."""
    found: Definitions = {}
    for path in glob.glob(os.path.join(package, "sinew/**/*.py*"), recursive=True):
        name, ending = os.path.splitext(os.path.relpath(path, package))
        if ending not in (".py", ".pyi"):
            continue
        module = name.replace("/", ".").replace(".__init__", "")
        with open(path, encoding="utf-8") as file:
            for node in ast.parse(file.read()).body:
                if isinstance(node, (ast.Assign, ast.AnnAssign)):
                    target = node.targets[0] if isinstance(node, ast.Assign) else node.target
                    found[module, getattr(target, "id", "")] = node
                elif isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                    found[module, node.name] = node
    return found


def decorators(node: ast.stmt) -> str:
    return " ".join(ast.unparse(d) for d in getattr(node, "decorator_list", []))


def shown(node: ast.stmt) -> str:
    """Returns the first lines of a definition."""
    if isinstance(node, ast.ClassDef):
        bases = ", ".join(ast.unparse(b) for b in node.bases)
        return f"class {node.name}({bases})" if bases else f"class {node.name}"
    if not isinstance(node, ast.FunctionDef):
        return ast.unparse(node)
    returns = ast.unparse(node.returns) if node.returns else ""
    if "property" in decorators(node):
        return f"{node.name}: {returns or 'Any'}"
    args, arrow = ast.unparse(node.args), f" -> {returns}" if returns else ""
    text = f"{node.name}({args}){arrow}"
    if len(text) > 88:
        text = f"{node.name}(\n    " + ",\n    ".join(re.split(r", (?![^\[]*\])", args)) + f",\n){arrow}"
    return text


def prose(text: str) -> str:
    """Returns a docstring as HTML: paragraphs, lines of settings as a list, indented blocks as they are."""
    out: List[str] = []
    named = r"<code>\1</code>"
    for block in re.split(r"\n\n(?=\S)", text.strip("\n")):
        words, _, example = block.partition("\n\n    ")
        inner = re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(words, quote=False))
        if all(SETTING.match(line) for line in words.split("\n")):
            out += ["<ul>", *(f"<li>{SETTING.sub(named, line)}</li>" for line in inner.split("\n")), "</ul>"]
        elif words:
            out.append(f"<p>{inner}</p>")
        if example:
            code = html.escape(textwrap.dedent("    " + example), quote=False)
            out.append(f'<pre class="as-it-stands"><code>{code}</code></pre>')
    return "\n".join(out)


def docstring(of: Any) -> str:
    """Returns what __doc__ has, without the signatures that pybind11 puts before it."""
    text = inspect.cleandoc(getattr(of, "__doc__", None) or "")
    if "(self: sinew." in text or " -> " in text.split("\n")[0]:
        text = re.sub(r"^(\d+\. )?\w+\(.*\)( -> .*)?$|^Overloaded function\.$", "", text, flags=re.M)
    return re.sub(r"\n{3,}", "\n\n", text).strip()


class ModulePage:
    """Page of one module. `bare` has the names without a docstring."""

    def __init__(self, module: str, found: Definitions) -> None:
        self.module, self.found = module, found
        self.out: List[str] = []
        self.bare: List[str] = []
        self.count = 0

    def entry(self, level: int, name: str, node: ast.stmt, text: str) -> None:
        self.count += 1
        full = f"{self.module}.{name}"
        if not text and not isinstance(node, (ast.Assign, ast.AnnAssign)):
            self.bare.append(full)
        title = full.replace(".__init__", "(…)")
        anchor = full.replace("__init__", "init")  # two underscores would be bold
        self.out += [f"{'#' * level} `{title}` {{: #{anchor} data-toc-label=\"{title.split('.')[-1]}\" }}", "",
                     '<div class="api">', f'<pre class="signature"><code>{html.escape(shown(node), quote=False)}</code></pre>',
                     prose(text) if text else "", "</div>", ""]

    def members(self, name: str, node: ast.ClassDef, of: type) -> None:
        for inner in node.body:
            if not isinstance(inner, ast.FunctionDef) or ".setter" in decorators(inner):
                continue
            own = inner.name
            text = docstring(inspect.getattr_static(of, own, None))
            if own == "__init__" and len(inner.args.args) > 1:
                inner.name = name
                self.entry(3, f"{name}.__init__", inner, text or "Makes one.")
            elif not own.startswith("_"):
                self.entry(3, f"{name}.{own}", inner, text)

    def definition(self, name: str, of: Any) -> ast.stmt:
        places = [getattr(of, "__module__", None), self.module, "sinew._sinew"]
        node = next((self.found[p, name] for p in places if (p, name) in self.found), None)
        node = node or next((n for (_, own), n in self.found.items() if own == name), None)
        if node is None:
            raise SystemExit(f"{self.module}.{name}: found no definition; expected one in python/sinew or its .pyi")
        return node

    def render(self) -> str:
        module = importlib.import_module(self.module)
        self.out = [f"# {self.module}", "", '<div class="api">', prose(inspect.getdoc(module) or ""), "</div>", ""]
        for name in (n for n in module.__all__ if not n.startswith("__")):
            of = getattr(module, name)
            node = self.definition(name, of)
            plain = isinstance(node, (ast.Assign, ast.AnnAssign))
            self.entry(2, name, node, "" if plain else docstring(of))
            if isinstance(node, ast.ClassDef):
                self.members(name, node, of)
        return "\n".join(self.out)


def write_python_pages(package: str, out: str) -> Tuple[int, List[str]]:
    """Writes the pages. Returns the number of names, and those without a docstring."""
    found = definitions(package)
    count, bare = 0, []
    os.makedirs(out, exist_ok=True)
    for module in MODULES:
        page = ModulePage(module, found)
        with open(os.path.join(out, f"{module.replace('.', '-')}.md"), "w", encoding="utf-8") as file:
            file.write(page.render())
        count += page.count
        bare += page.bare
    return count, bare
