"""python_pages.py - the reference of the Python package, from its sources alone: names, signatures and
docstrings of python/sinew, types of its .pyi, and the docstrings that python/binding gives."""

import ast
import glob
import html
import os
import re
from typing import Dict, Iterator, List, Optional, Tuple

from names import as_it_stands, blocks_of

MODULES = {"sinew": "sinew/__init__.py", "sinew.identify": "sinew/identify.py", "sinew.gym": "sinew/gym/__init__.py"}


# --- docstrings of the compiled part --------------------------------------------------------------


def tokens(text: str) -> Iterator[Tuple[str, str]]:
    """A C++ file as strings, words and signs."""
    pattern = re.compile(
        r'(?P<comment>//[^\n]*)|R"(?P<d>\w*)\((?P<raw>.*?)\)(?P=d)"|"(?P<string>(?:[^"\\]|\\.)*)"'
        r"|'(?:[^'\\]|\\.)'|(?P<word>[\w:.]+)|(?P<sign>\S)", re.S)
    for match in pattern.finditer(text):
        if match.group("raw") is not None:
            yield "string", match.group("raw")
        elif match.group("string") is not None:
            yield "string", match.group("string").replace("\\n", "\n").replace('\\"', '"').replace("\\\\", "\\")
        elif match.group("word"):
            yield "word", match.group("word")
        elif match.group("sign"):
            yield "sign", match.group("sign")


# Words whose call defines something: a class, a variable of that kind, a member (also by a
# helper that is called add_… and gets the class), an exception.
DEFINES = re.compile(r"(?:^|[.:])(def\w*|class_)$|^(Class|new_exception|add_\w+)$")


Tokens = List[Tuple[str, str]]


def call_at(found: Tokens, i: int) -> Optional[Tuple[bool, List[Tokens]]]:
    """The call whose name stands at i: does it make a variable, and its arguments; None if it is none."""
    j, angle = i + 1, 0
    while j < len(found) and (angle or found[j][1] != "("):
        angle += {"<": 1, ">": -1}.get(found[j][1], 0)
        if not angle and found[j][1] in ";,)&=":
            return None
        j += 1
    variable = found[j - 1][0] == "word" and j > i + 1
    depth = 0
    parts: List[Tokens] = [[]]
    for token in found[j:]:
        if token[0] == "sign" and token[1] in "([{":
            depth += 1
            if depth == 1:
                continue
        elif token[0] == "sign" and token[1] in ")]}":
            depth -= 1
            if depth == 0:
                return variable, parts
        if depth == 1 and token == ("sign", ","):
            parts.append([])
        else:
            parts[-1].append(token)
    return None


def calls(text: str) -> Iterator[Tuple[str, bool, List[Tokens]]]:
    """Calls that define something: the word, does it make a variable, and its arguments."""
    found = list(tokens(text))
    for i, (kind, word) in enumerate(found):
        if kind == "word" and DEFINES.search(word):
            call = call_at(found, i)
            if call is not None:
                yield (word, *call)


def strings(part: Tokens) -> Optional[str]:
    """The text of an argument that is nothing but string literals."""
    if not part or any(kind != "string" for kind, _ in part):
        return None
    return "".join(text for _, text in part)


def docs_of(text: str) -> Dict[str, str]:
    """Docstrings of one file of python/binding."""
    found: Dict[str, str] = {}
    # `Class` is what a file calls its one class where several functions fill it.
    variable = next((strings(parts[1]) or "" for word, _, parts in calls(text)
                     if word == "Class" and len(parts) > 1), "")
    owner = ""
    for word, named, parts in calls(text):
        literal = [s for s in (strings(p) for p in parts) if s is not None]
        if not literal:
            continue
        if word.endswith("class_") or word in ("Class", "new_exception"):
            owner = literal[0]
            if named:
                variable = owner
            if len(literal) > 1:
                found[owner] = literal[-1]
            continue
        if word.startswith("add_") and parts[0] != [("word", "c")]:
            continue
        of_module = re.match(r"(m|module)\.", word)
        if not word.startswith("."):
            owner = "" if of_module else variable
        name = "__init__" if ("word", "py::init") in parts[0] else literal[0]
        if name == "__init__" or len(literal) > 1:
            found[f"{owner}.{name}" if owner else name] = literal[-1]
    return found


def compiled_docs(folder: str) -> Dict[str, str]:
    """Docstrings of the compiled part by name: Class, Class.member or function."""
    found: Dict[str, str] = {}
    for path in sorted(glob.glob(os.path.join(folder, "*.cpp"))):
        with open(path, encoding="utf-8") as file:
            found.update(docs_of(file.read()))
    return found


# --- settings of the methods of identification ------------------------------------------------------


def row_of(part: Tokens, constants: Dict[str, str]) -> List[str]:
    """Name and line of a row, `Setting{"name", "doc", "unit", …}.in_python("keyword")`."""
    fields: List[str] = [""]
    for kind, text in part[part.index(("sign", "{")) + 1 :]:
        if (kind, text) == ("sign", "}"):
            break
        if (kind, text) == ("sign", ","):
            fields.append("")
        else:
            fields[-1] += text if kind == "string" else constants.get(text, "")
    words = [text for _, text in part]
    keyword = words[words.index(".in_python") + 2] if ".in_python" in words else fields[0]
    unit = f" [{fields[2]}]" if len(fields) > 2 and fields[2] not in ("", "1") else ""
    return [f"`{keyword}`{unit}: {fields[1]}."]


def rows_of(functions: Dict[Tuple[str, str], str], name: str, kind: str) -> List[str]:
    """The rows of a table fields(Visitor&, kind&), with those of the tables that it calls."""
    body = functions[name, kind]
    constants = dict(re.findall(r'(\w+) = "([^"]*)";', body))
    found, out = list(tokens(body)), []
    for i, (_, word) in enumerate(found):
        call = call_at(found, i) if re.fullmatch(r"v\.(?!method)\w+|\w*fields", word) else None
        if call is None:
            continue
        if word.startswith("v."):
            out += row_of(call[1][0], constants)
        else:
            out += rows_of(functions, word, "WishTexts" if word == "fields" else kind.replace("Check", "Static"))
    return out


def setting_rows(folder: str) -> Dict[str, List[str]]:
    """A line for each setting of a method, by the method's name."""
    functions: Dict[Tuple[str, str], str] = {}
    for path in sorted(glob.glob(os.path.join(folder, "*.h"))):
        with open(path, encoding="utf-8") as file:
            for match in re.finditer(r"^void (\w+)\(Visitor& v, (\w+)&.*?\{\n(.*?)^\}", file.read(), re.S | re.M):
                functions[match[1], match[2]] = match[3]
    return {match[1]: rows_of(functions, name, kind) for (name, kind), body in functions.items()
            if (match := re.search(r'v\.method\(\s*\{"([\w-]+)"', body))}


# --- names of the package ---------------------------------------------------------------------------


def public_names(tree: ast.Module) -> List[str]:
    for node in tree.body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__":
            return [n for n in ast.literal_eval(node.value) if not n.startswith("__")]
    raise SystemExit("python/sinew: found a module without __all__; expected the list of its public names")


def parse(path: str) -> ast.Module:
    with open(path, encoding="utf-8") as file:
        return ast.parse(file.read())


def definition(tree: ast.Module, name: str) -> Optional[ast.stmt]:
    for node in tree.body:
        if getattr(node, "name", None) == name:
            return node
        if isinstance(node, (ast.Assign, ast.AnnAssign)):
            target = node.targets[0] if isinstance(node, ast.Assign) else node.target
            if getattr(target, "id", None) == name:
                return node
    return None


def find(root: str, module: str, tree: ast.Module, name: str) -> Tuple[Optional[ast.stmt], bool]:
    """Where a public name is defined, followed through imports; is it in the compiled part?"""
    node = definition(tree, name)
    if node is not None:
        return node, module.endswith("_sinew")
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                if (alias.asname or alias.name) == name:
                    base = os.path.join(root, node.module.replace(".", "/"))
                    for path in (base + ".pyi", base + ".py", os.path.join(base, "__init__.py")):
                        if os.path.exists(path):
                            return find(root, node.module, parse(path), alias.name)
    return None, False


def shown(node: ast.stmt) -> str:
    """A definition's first lines."""
    if isinstance(node, ast.ClassDef):
        bases = ", ".join(ast.unparse(b) for b in node.bases)
        return f"class {node.name}({bases})" if bases else f"class {node.name}"
    if isinstance(node, ast.FunctionDef):
        args = ast.unparse(node.args)
        arrow = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        text = f"{node.name}({args}){arrow}"
        if len(text) > 88:
            parts = re.split(r", (?![^\[]*\])", args)
            text = f"{node.name}(\n    " + ",\n    ".join(parts) + f",\n){arrow}"
        return text
    return ast.unparse(node)


def is_property(node: ast.stmt) -> bool:
    return isinstance(node, ast.FunctionDef) and any(
        getattr(d, "id", getattr(d, "attr", "")) in ("property", "cached_property") for d in node.decorator_list)


def is_setter(node: ast.stmt) -> bool:
    return isinstance(node, ast.FunctionDef) and any(getattr(d, "attr", "") == "setter" for d in node.decorator_list)


def prose(text: str) -> str:
    """A docstring: paragraphs, and what is indented as it stands."""
    out = []
    for kind, block in blocks_of(text):
        inner = re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape("\n".join(block), quote=False))
        out.append(as_it_stands(block) if kind == "pre" else f"<p>{inner}</p>")
    return "\n".join(out)


class ModulePage:
    """The page of one module; counts what has no words."""

    def __init__(self, root: str, module: str, docs: Dict[str, str], rows: Dict[str, List[str]]) -> None:
        self.root = root
        self.rows = rows
        self.module = module
        self.docs = docs
        self.out: List[str] = []
        self.bare: List[str] = []
        self.count = 0

    def text_of(self, node: ast.stmt, name: str, compiled: bool) -> str:
        own = None
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            own = ast.get_docstring(node)
            for call in node.decorator_list:
                if isinstance(call, ast.Call) and ast.unparse(call.func) == "_of":
                    own = "\n\n".join([own or "", *self.rows[ast.literal_eval(call.args[0])]])
        return own or (self.docs.get(name, "") if compiled else "")

    def entry(self, level: int, name: str, node: ast.stmt, text: str) -> None:
        self.count += 1
        if not text and not isinstance(node, (ast.Assign, ast.AnnAssign)):
            self.bare.append(f"{self.module}.{name}")
        signature = html.escape(shown(node), quote=False)
        if is_property(node):
            kind = ast.unparse(node.returns) if node.returns else "Any"
            signature = html.escape(f"{node.name}: {kind}", quote=False)
        full = f"{self.module}.{name}"
        # Two underscores would be strong in Markdown.
        anchor = full.replace("__init__", "init")
        title, label = full.replace(".__init__", "(…)"), re.sub(r"(?:.*\.)?(\w+)\.__init__$", r"\1(…)", name).split(".")[-1]
        self.out += [f"{'#' * level} `{title}` {{: #{anchor} data-toc-label=\"{label}\" }}", "",
                     '<div class="api">', f'<pre class="signature"><code>{signature}</code></pre>',
                     prose(text) if text else "", "</div>", ""]

    def members(self, node: ast.ClassDef, name: str, compiled: bool) -> None:
        for inner in node.body:
            own = getattr(inner, "name", "")
            if not isinstance(inner, ast.FunctionDef) or is_setter(inner):
                continue
            if own == "__init__":
                text = self.text_of(inner, f"{name}.__init__", compiled)
                if text or len(inner.args.args) > 1:
                    inner.name = name.split(".")[-1]
                    self.entry(3, f"{name}.__init__", inner, text or "Makes one.")
            elif not own.startswith("_"):
                self.entry(3, f"{name}.{own}", inner, self.text_of(inner, f"{name}.{own}", compiled))

    def render(self) -> str:
        tree = parse(os.path.join(self.root, MODULES[self.module]))
        self.out = [f"# {self.module}", "", '<div class="api">', prose(ast.get_docstring(tree) or ""), "</div>", ""]
        for name in public_names(tree):
            node, compiled = find(self.root, self.module, tree, name)
            if node is None:
                raise SystemExit(f"python/{MODULES[self.module]}: found no definition of {name}; expected it in the "
                                 "package or its .pyi")
            self.entry(2, name, node, self.text_of(node, name, compiled))
            if isinstance(node, ast.ClassDef):
                self.members(node, name, compiled)
        return "\n".join(self.out)


def write_python_pages(root: str, out: str) -> Tuple[int, List[str]]:
    """Write the pages; return how many names there are, and those without words."""
    docs = compiled_docs(os.path.join(root, "python/binding"))
    rows = setting_rows(os.path.join(root, "sinew/identify/task"))
    count, bare = 0, []
    os.makedirs(os.path.join(out, "reference/python"), exist_ok=True)
    for module in MODULES:
        page = ModulePage(os.path.join(root, "python"), module, docs, rows)
        with open(os.path.join(out, f"reference/python/{module.replace('.', '-')}.md"), "w", encoding="utf-8") as file:
            file.write(page.render())
        count += page.count
        bare += page.bare
    return count, bare
