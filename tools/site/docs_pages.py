"""Markdown files and notebooks of the repository as pages of the site. Pages keep their paths, so that
links between them stay. Links to headers, folders and other files lead to the reference and the sources."""

import json
import os
import re
import shutil
from typing import Callable, List

from reference import Reference

PICTURES = (".png", ".svg", ".gif")


def title_of(path: str) -> str:
    with open(path, encoding="utf-8") as file:
        title = re.search(r"^# (.*)", file.read(), re.M)
    if title is None:
        raise SystemExit(f"{path}: found no heading; expected a line that begins with \"# \"")
    return re.sub(r"[`*]", "", title[1].strip())


def outside_fences(text: str, change: Callable[[str], str]) -> str:
    """Applies `change` to each line that no ``` encloses."""
    out, fence = [], False
    for line in text.split("\n"):
        if line.lstrip().startswith("```"):
            fence = not fence
        out.append(line if fence else change(line))
    return "\n".join(out)


class Pages:
    """Copies the pages to where MkDocs reads them."""

    LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^()\s]+)([^()]*\))")

    def __init__(self, root: str, out: str, files: List[str], reference: Reference) -> None:
        self.root, self.out, self.files, self.reference = root, out, files, reference
        self.titles = {f: title_of(os.path.join(root, f)) for f in files if f.endswith(".md")}

    def target(self, path: str, heading: str = "") -> str:
        """Returns what the site has in the place of a file or folder, from the site's root."""
        if path in self.titles or path.endswith(PICTURES):
            return path + heading
        if path.endswith(".ipynb"):
            return path[: -len(".ipynb")] + ".md"
        if path in self.reference.places:
            return self.reference.places[path]
        if os.path.isdir(os.path.join(self.root, path)):
            readme = os.path.join(path, "README.md")
            return readme if readme in self.titles else f"source/{path}/index.html"
        return f"source/{path}.html"

    def line(self, text: str, page: str) -> str:
        folder = os.path.dirname(page)

        def change(match: "re.Match[str]") -> str:
            path, mark, heading = match[2].partition("#")
            if re.match(r"[a-z]+:|#", match[2]):
                return match[0]
            path = os.path.normpath(os.path.join(folder, path))
            if path.endswith(PICTURES):
                self.save(path)
            place = self.target(path, mark + heading)
            if page.startswith("docs/theory/"):
                self.reference.theory.setdefault(place, {})[page] = self.titles[page]
            return match[1] + os.path.relpath(place, folder or ".") + match[3]

        # Code keeps what looks like a link, but a link's text may be code.
        spans = re.findall(r"`[^`]+`", text)
        text = self.LINK.sub(change, re.sub(r"`[^`]+`", "\x00", text))
        text = re.sub("\x00", lambda _: spans.pop(0), text)
        return re.sub(r'<a name="([\w-]+)"></a>', r'<span id="\1"></span>', text)

    def write(self) -> None:
        for path in self.titles:
            with open(os.path.join(self.root, path), encoding="utf-8") as file:
                text = outside_fences(file.read(), lambda line, path=path: self.line(line, path))
            self.save(path, self.with_names(text, path) if path.startswith("docs/theory/") else text)
        for path in (f for f in self.files if f.endswith(".ipynb")):
            self.save(path[: -len(".ipynb")] + ".md", self.notebook(path))

    def save(self, path: str, text: str = "") -> None:
        """Writes a page, or copies the file of that name."""
        where = os.path.join(self.out, path)
        os.makedirs(os.path.dirname(where), exist_ok=True)
        if not text:
            shutil.copyfile(os.path.join(self.root, path), where)
            return
        with open(where, "w", encoding="utf-8") as file:
            file.write(text)

    def with_names(self, text: str, path: str) -> str:
        """Lets the code of a theory page lead to the reference: names of the folders that it links to."""
        near = self.reference.folders_of(os.path.join(self.root, path))
        up = "../" * path.count("/")

        def code(match: "re.Match[str]") -> str:
            place = self.reference.find(re.sub(r"\(.*", "", match[1]), near)
            self.reference.theory.setdefault(place, {})[path] = self.titles[path]
            return f"[{match[0]}]({up}{place})" if place else match[0]

        def change(line: str) -> str:
            parts = re.split(r"(\[[^\]]*\]\([^)]*\))", line)  # what is a link already
            return line if line.startswith("#") else "".join(
                p if i % 2 else re.sub(r"`([^`]+)`", code, p) for i, p in enumerate(parts))

        return outside_fences(text, change)

    def notebook(self, path: str) -> str:
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            cells = json.load(file)["cells"]
        parts = []
        for cell in cells:
            source = "".join(cell["source"])
            code = cell["cell_type"] != "markdown"
            parts.append(f"```python\n{source}\n```" if code else outside_fences(source, lambda line: self.line(line, path)))
        return "\n\n".join(parts) + "\n"
