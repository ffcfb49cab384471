"""cpp_pages.py - the reference of the C++ library: a page for each folder, a section for each header,
and a heading for each name, so that the site's search finds it."""

import html
import os
import re
from typing import Dict, List, Optional

from api import KINDS, Header, Name
from names import Names, Prose, page_of


class FolderPage:
    """One page: what a folder is for, and what its headers declare."""

    def __init__(self, folder: str, purpose: str, headers: List[Header], prose: Prose, theory: List[str]) -> None:
        self.folder = folder
        self.purpose = purpose
        self.headers = headers
        self.prose = prose
        self.names = prose.names
        self.theory = theory  # links
        self.out: List[str] = []

    def render(self) -> str:
        title = re.sub("^sinew/", "", self.folder)
        source = f"{self.prose.root}source/{self.folder}/index.html"
        self.out = [f"# {title}", ""]
        target = title.replace("/", "_")
        words = [f"<p>{self.purpose}</p>"] if self.purpose else []
        if self.folder.startswith("sinew/"):
            words.append(f'<p class="facts">Target <code>sinew::{target}</code> · <a href="{source}">sources</a></p>')
        if self.theory:
            words.append(f'<p class="facts">Theory: {" · ".join(self.theory)}</p>')
        rows = "".join(
            f'<tr><td><a href="#{os.path.basename(h.path)}"><code>{os.path.basename(h.path)}</code></a></td>'
            f"<td>{self.prose.line(h.purpose)}</td></tr>"
            for h in self.headers
        )
        words.append(f'<table class="headers"><tbody>{rows}</tbody></table>')
        self.raw(words)
        for header in self.headers:
            self.header(header)
        return "\n".join(self.out) + "\n"

    def raw(self, parts: List[str]) -> None:
        self.out += ['<div class="api">', *parts, "</div>", ""]

    def header(self, header: Header) -> None:
        file = os.path.basename(header.path)
        self.out += [f"## `{re.sub('^sinew/', '', header.path)}` {{: #{file} }}", ""]
        source = f"{self.prose.root}source/{header.path}.html"
        parts = [
            f'<p class="purpose">{self.prose.line(header.purpose[:1].upper() + header.purpose[1:])}</p>',
            self.prose.text(header.text) if header.text.strip() else "",
            f'<pre class="signature"><code>#include "<a href="{source}">{header.path}</a>"</code></pre>',
        ]
        self.raw([part for part in parts if part])
        if header.path.endswith(".fields.h"):
            self.tables_of_keys(header)
            return
        for group in grouped([n for n in header.names if n.kind != "variable"]):
            self.entry(group)
        self.constants([n for n in header.names if n.kind == "variable"], file)

    def tables_of_keys(self, header: Header) -> None:
        """A field table is one overload of `fields` for each kind of part."""
        parts = []
        for name in header.names:
            match = re.search(r"\(Visitor& ?\w*, (?:const )?([\w:]+)&", name.signature)
            if name.name == "fields" and match:
                found = self.names.find(match.group(1), self.prose.folder)
                parts.append(self.prose.link(found, f"<code>{match.group(1)}</code>"))
        if parts:
            self.raw([f"<p>Keys of {', '.join(dict.fromkeys(parts))}.</p>"])

    def heading(self, level: int, group: List[Name]) -> None:
        first = group[0]
        titles = list(dict.fromkeys(n.short for n in group))
        label = html.escape(", ".join(dict.fromkeys(n.name for n in group)))
        self.out += [
            f"{'#' * level} `{', '.join(titles)}` {{: #{self.names.anchors[id(first)]} data-toc-label=\"{label}\" }}",
            "",
        ]

    def entry(self, group: List[Name], level: int = 3) -> None:
        """Names that share a comment, with what is in them."""
        self.heading(level, group)
        parts = []
        for name in group:
            own = self.names.anchors[id(name)]
            at = f'<span id="{own}"></span>' if name is not group[0] else ""
            parts.append(at + self.prose.signature(name))
        first = group[0]
        parts += [self.prose.text(t, first.owner or first) for t in self.words(group) if t]
        if first.by_file:
            file = os.path.basename(first.file)
            parts.append(f'<p>It is what <a href="#{file}"><code>{file}</code></a> describes.</p>')
        if first.kind in ("struct", "class", "union"):
            parts.append(self.fields([m for m in first.members if m.kind == "variable"], first))
        if first.kind == "enum":
            parts.append(self.fields(first.members, first))
        parts.append(self.seen(first))
        self.raw([part for part in parts if part])
        if first.kind in KINDS:
            for inner in grouped([m for m in first.members if m.kind not in ("variable", "enumvalue")]):
                self.entry(inner, 4)

    def words(self, group: List[Name]) -> List[str]:
        found: List[str] = []
        for name in group:
            for text in (name.text, sentence(name.behind), name.leader.text if name.leader else ""):
                if text and text not in found:
                    found.append(text)
        return found

    def seen(self, name: Name) -> str:
        """Where it stands in the source, and the theory pages that have it."""
        line = f'{self.prose.root}source/{name.file}.html#L{name.line}'
        parts = [f'<a href="{line}">{os.path.basename(name.file)}:{name.line}</a>']
        for title, page in self.names.theory.get(id(name), []):
            parts.append(f'theory: <a href="{self.prose.root}{page}">{title}</a>')
        return f'<p class="facts">{" · ".join(parts)}</p>'

    def fields(self, members: List[Name], owner: Optional[Name]) -> str:
        if not members:
            return ""
        rows = []
        for m in members:
            words = "<br>".join(self.prose.line(t.replace("\n", " "), owner) for t in self.words([m]) if t)
            shown = self.prose.signature(m).replace('<pre class="signature">', "").replace("</pre>", "")
            anchor = self.names.anchors[id(m)]
            rows.append(f'<tr id="{anchor}"><td>{shown}</td><td>{words}</td></tr>')
        return f'<table class="members"><tbody>{"".join(rows)}</tbody></table>'

    def constants(self, names: List[Name], file: str) -> None:
        if names:
            self.out += [f"### Constants of `{file}` {{: #constants-{file} }}", ""]
            self.raw([self.fields(names, None)])


def sentence(text: str) -> str:
    return text[:1].upper() + text[1:] if text[:1].islower() and " " in text else text


def grouped(names: List[Name]) -> List[List[Name]]:
    """Functions and types that have no words but those of the one before go with it."""
    groups: List[List[Name]] = []
    for name in names:
        plain = name.kind in ("function", "typedef") and not name.text and not name.behind
        if plain and groups and name.leader is not None and groups[-1][-1].kind in ("function", "typedef"):
            before = groups[-1][0]
            if before is name.leader or before.leader is name.leader:
                groups[-1].append(name)
                continue
        same = groups and groups[-1][-1].name == name.name and plain and name.kind == "function"
        if same and groups[-1][-1].kind == "function" and not groups[-1][-1].words and not name.words:
            groups[-1].append(name)
            continue
        groups.append([name])
    return groups


def write_cpp_pages(out: str, headers: Dict[str, Header], names: Names, pages: Dict[str, str],
                    purposes: Dict[str, str], theory: Dict[str, List[str]]) -> List[str]:
    """Write the pages below `out`; return the folders in their order."""
    folders = sorted({h.folder for h in headers.values()}, key=lambda f: (not f.startswith("sinew/"), f))
    rows = []
    for folder in folders:
        own = [h for h in headers.values() if h.folder == folder]
        # Tables of keys last; else what the folder is called by first.
        stem = os.path.basename(folder)
        own.sort(key=lambda h: (h.path.endswith(".fields.h"), os.path.basename(h.path) != f"{stem}.h", h.path))
        prose = Prose(names, pages, folder)
        if folder not in purposes:
            raise SystemExit(f"{folder}: found no words on what it is for; expected a row in docs/architecture.md's table of "
                             "folders, or a line in tools/site/folders.txt")
        purpose = purposes[folder]
        page = FolderPage(folder, purpose, own, prose, theory.get(folder, []))
        path = os.path.join(out, page_of(folder) + ".md")
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(page.render())
        title = re.sub("^sinew/", "", folder)
        count = len(own)
        rows.append(f'<tr><td><a href="{os.path.basename(page_of(folder))}.html"><code>{title}</code></a></td>'
                    f"<td>{purpose}</td><td>{count}</td></tr>")
    with open(os.path.join(out, "reference/cpp/index.md"), "w", encoding="utf-8") as file:
        file.write(INDEX.format(rows="\n".join(rows)))
    return folders


INDEX = """# The C++ library

Every folder of `sinew/` is one page: what its headers declare, in their own words. Search finds a
function by its name. Numbers in brackets, as [26], are equations of Colbrunn (2000), which the theory
pages derive. `find_package(sinew)` gives a target for each folder ([lesson 04](../../examples/04-consumer/README.md)).

<div class="api">
<table class="headers"><thead><tr><th>folder</th><th>what it is</th><th>headers</th></tr></thead><tbody>
{rows}
</tbody></table>
</div>
"""
