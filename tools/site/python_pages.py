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
from typing import Any, Dict, Iterator, List, Tuple

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
                target = node.targets[0] if isinstance(node, ast.Assign) else getattr(node, "target", node)
                found[module, getattr(target, "id", getattr(target, "name", ""))] = node
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


def entry(level: int, name: str, node: ast.stmt, of: Any) -> Iterator[str]:
    """Yields the lines on one name. Raises SystemExit if it has no docstring, as only a constructor may."""
    text = "" if isinstance(node, (ast.Assign, ast.AnnAssign)) else docstring(of)
    if not text and isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not name.endswith("__init__"):
        raise SystemExit(f"{name}: found no docstring; expected one, as each public name has")
    title = name.replace(".__init__", "(…)")
    anchor = name.replace("__init__", "init")  # two underscores would be bold
    yield f"{'#' * level} `{title}` {{: #{anchor} data-toc-label=\"{title.split('.')[-1]}\" }}\n"
    yield f'<div class="api">\n<pre class="signature"><code>{html.escape(shown(node), quote=False)}</code></pre>'
    yield f"{prose(text)}\n</div>\n"


def module_page(name: str, found: Definitions) -> Iterator[str]:
    module = importlib.import_module(name)
    yield f'# {name}\n\n<div class="api">\n{prose(inspect.getdoc(module) or "")}\n</div>\n'
    for own in (n for n in module.__all__ if not n.startswith("__")):
        of = getattr(module, own)
        places = [getattr(of, "__module__", ""), name, "sinew._sinew", *(m for m, n in found if n == own)]
        node = next((found[p, own] for p in places if (p, own) in found), None)
        if node is None:
            raise SystemExit(f"{name}.{own}: found no definition; expected one in python/sinew or its .pyi")
        yield from entry(2, f"{name}.{own}", node, of)
        for inner in node.body if isinstance(node, ast.ClassDef) else []:
            if isinstance(inner, ast.FunctionDef) and ".setter" not in decorators(inner):
                made = inner.name == "__init__" and len(inner.args.args) > 1
                if made or not inner.name.startswith("_"):
                    member = getattr(of, inner.name)
                    path = f"{name}.{own}.{inner.name}"
                    inner.name = own if made else inner.name
                    yield from entry(3, path, inner, member)


def write_python_pages(package: str, out: str) -> int:
    """Writes the pages. Returns the number of names."""
    found = definitions(package)
    os.makedirs(out, exist_ok=True)
    count = 0
    for module in MODULES:
        lines = list(module_page(module, found))
        count += sum(line.startswith("##") for line in lines)
        with open(os.path.join(out, f"{module.replace('.', '-')}.md"), "w", encoding="utf-8") as file:
            file.write("\n".join(lines))
    return count
