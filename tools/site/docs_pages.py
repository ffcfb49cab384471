"""docs_pages.py - the repository's Markdown as pages of the site.

Pages keep their places, so that links between them stay as they are. What they link to besides
becomes a page of the reference (headers and folders of the library) or of the sources.
"""

import json
import os
import re
import shutil
from typing import Callable, Dict, List, Optional

from api import Header, Name
from names import Names, page_of

PICTURES = (".png", ".svg", ".gif")


def title_of(path: str) -> str:
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("# "):
                return re.sub(r"[`*]", "", line[2:].strip())
    raise SystemExit(f"{path}: found no heading; expected a line that begins with \"# \"")


def outside_fences(text: str, change: Callable[[str], str]) -> str:
    """Apply `change` to each line that no ``` encloses."""
    out, fence = [], False
    for line in text.split("\n"):
        if line.lstrip().startswith("```"):
            fence = not fence
        out.append(line if fence else change(line))
    return "\n".join(out)


class Pages:
    """Copies Markdown files to where MkDocs reads them."""

    LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^()\s]+)([^()]*\))")

    def __init__(self, root: str, out: str, files: List[str], headers: Dict[str, Header], names: Names) -> None:
        self.root = root
        self.out = out
        self.files = files
        self.headers = headers
        self.names = names
        self.titles = {f: title_of(os.path.join(root, f)) for f in files if f.endswith(".md")}
        self.raw: List[str] = []  # files that are shown by sources.py because a page leads there

    def target(self, path: str, heading: str) -> str:
        """What stands in the site in the place of a file or folder, from the site's root."""
        if path in self.titles or path.endswith(PICTURES):
            return path + heading
        if path.endswith(".ipynb"):
            return path[: -len(".ipynb")] + ".md"
        if path in self.headers:
            return f"{page_of(os.path.dirname(path))}.md#{os.path.basename(path)}"
        if any(h.folder == path for h in self.headers.values()):
            return f"{page_of(path)}.md"
        if path == "sinew":
            return "reference/cpp/index.md"
        if os.path.isdir(os.path.join(self.root, path)):
            readme = os.path.join(path, "README.md")
            return readme if readme in self.titles else f"source/{path}/index.html"
        return f"source/{path}.html"

    def line(self, text: str, page: str) -> str:
        folder = os.path.dirname(page)

        def change(match: "re.Match[str]") -> str:
            link = match.group(2)
            if re.match(r"[a-z]+:|#", link):
                return match.group(0)
            path, mark, heading = link.partition("#")
            path = os.path.normpath(os.path.join(folder, path))
            found = self.target(path, mark + heading)
            if path.endswith(PICTURES):
                self.raw.append(path)
            return match.group(1) + os.path.relpath(found, folder or ".") + match.group(3)

        # Not within code, but a link's text may be code.
        spans: List[str] = []

        def hide(match: "re.Match[str]") -> str:
            spans.append(match.group(0))
            return f"\x00{len(spans) - 1}\x00"

        text = self.LINK.sub(change, re.sub(r"`[^`]+`", hide, text))
        text = re.sub("\x00(\\d+)\x00", lambda m: spans[int(m.group(1))], text)
        return re.sub(r'<a name="([\w-]+)"></a>', r'<span id="\1"></span>', text)

    def write(self) -> None:
        for path in self.titles:
            with open(os.path.join(self.root, path), encoding="utf-8") as file:
                text = file.read()
            text = outside_fences(text, lambda line, path=path: self.line(line, path))
            if path.startswith("docs/theory/"):
                text = self.with_names(text, path)
            self.save(path, text)
        for path in (f for f in self.files if f.endswith(".ipynb")):
            self.notebook(path)
        for path in dict.fromkeys(self.raw):
            os.makedirs(os.path.dirname(os.path.join(self.out, path)), exist_ok=True)
            shutil.copyfile(os.path.join(self.root, path), os.path.join(self.out, path))

    def save(self, path: str, text: str) -> None:
        where = os.path.join(self.out, path)
        os.makedirs(os.path.dirname(where), exist_ok=True)
        with open(where, "w", encoding="utf-8") as file:
            file.write(text)

    # --- theory pages: their names of code lead to the reference, and that leads back -------------

    def with_names(self, text: str, path: str) -> str:
        folders = list(dict.fromkeys(re.findall(r"reference/cpp/([\w-]+)\.md", text)))
        near = [h.folder for h in self.headers.values() if page_of(h.folder).split("/")[-1] in folders]
        near.sort(key=lambda folder: folders.index(page_of(folder).split("/")[-1]))
        up = "../" * path.count("/")
        title, page = self.titles[path], path[:-3] + ".html"

        def code(match: "re.Match[str]") -> str:
            name = self.meant(match.group(1), list(dict.fromkeys(near)))
            if name is None:
                return match.group(0)
            seen = self.names.theory.setdefault(id(name), [])
            if (title, page) not in seen:
                seen.append((title, page))
            folder, anchor = page_of(os.path.dirname(name.file)), self.names.anchors[id(name)]
            return f"[{match.group(0)}]({up}{folder}.md#{anchor})"

        def change(line: str) -> str:
            if line.startswith("#"):
                return line
            parts = re.split(r"(\[[^\]]*\]\([^)]*\))", line)  # what is a link already
            return "".join(p if i % 2 else re.sub(r"`([^`]+)`", code, p) for i, p in enumerate(parts))

        return outside_fences(text, change)

    def meant(self, word: str, near: List[str]) -> Optional[Name]:
        """The name that a span of code in a theory page is: in the folders it is about, or the only one."""
        word = re.sub(r"\(.*", "", word)
        if not re.fullmatch(r"[A-Za-z_]\w*(::\w+)*", word):
            return None
        qualified = "::" in word
        for folder in near:
            name = self.names.find(word, folder, members=qualified)
            if name is not None and os.path.dirname(name.file) == folder:
                return name
        return self.names.find(word) if qualified else None

    # --- notebooks ------------------------------------------------------------------------------

    def notebook(self, path: str) -> None:
        with open(os.path.join(self.root, path), encoding="utf-8") as file:
            cells = json.load(file)["cells"]
        parts = []
        for cell in cells:
            source = "".join(cell["source"])
            if cell["cell_type"] == "markdown":
                parts.append(outside_fences(source, lambda line: self.line(line, path)))
                continue
            parts.append(f"```python\n{source}\n```")
            for output in cell.get("outputs", []):
                words = output.get("text") or output.get("data", {}).get("text/plain", "")
                if words:
                    parts.append("```text\n" + "".join(words).rstrip() + "\n```")
        self.save(path[: -len(".ipynb")] + ".md", "\n\n".join(parts) + "\n")


def purposes_of(page: str, more: str, line: Callable[[str], str]) -> Dict[str, str]:
    """What each folder is for: by the page's table of folders, and by a list of those that it leaves out."""
    found = {}
    with open(page, encoding="utf-8") as file:
        rows = re.findall(r"^\| (\[`.*?) \| (.*?) \|$", file.read(), re.M)
    for folder_links, words in rows:
        folders = re.findall(r"\]\((?:\.\./)?(sinew/[\w/]+)\)", folder_links)
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", words)
        # A row of two folders has two halves.
        parts = [words] if len(folders) == 1 else words.split("; ")
        if len(parts) == len(folders):
            found.update(zip(folders, parts))
    with open(more, encoding="utf-8") as file:
        for text in file:
            if text.strip() and not text.startswith("#"):
                folder, words = text.split(None, 1)
                found[folder] = words.strip()
    return {folder: line(words[:1].upper() + words[1:]) for folder, words in found.items()}


def theory_of(root: str, titles: Dict[str, str]) -> Dict[str, List[str]]:
    """The theory pages that lead to a folder, as links from a page of the reference."""
    found: Dict[str, List[str]] = {}
    for path, title in titles.items():
        if not path.startswith("docs/theory/"):
            continue
        with open(os.path.join(root, path), encoding="utf-8") as file:
            folders = re.findall(r"\]\(\.\./\.\./(sinew/[\w/.]+)", file.read())
        for folder in dict.fromkeys(re.sub(r"/[^/]*\.\w+$", "", f).rstrip("/") for f in folders):
            found.setdefault(folder, []).append(f'<a href="../../{path[:-3]}.html">{title}</a>')
    return found
