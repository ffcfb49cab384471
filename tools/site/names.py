"""names.py - where a name of the library stands in the site, and words as HTML that lead there."""

import html
import os
import re
from typing import Dict, List, Optional, Tuple

from api import KINDS, Header, Name

REFERENCE = "reference/cpp"
TYPES = KINDS | {"enum"}


def page_of(folder: str) -> str:
    """The page of a folder, without its ending: sinew/control/joint -> reference/cpp/control-joint."""
    return f"{REFERENCE}/{re.sub('^sinew/', '', folder).replace('/', '-')}"


def anchor_of(text: str) -> str:
    for sign, word in (("<", "lt"), (">", "gt"), ("=", "eq"), ("+", "plus"), ("[]", "at"), ("()", "call")):
        if "operator" in text:
            text = text.replace(sign, word)
    return re.sub(r"[^\w.]+", "-", text.replace("::", ".")).strip("-")


class Names:
    """All names of the headers; finds the one that a word means."""

    def __init__(self, headers: Dict[str, Header]) -> None:
        self.headers = headers
        self.anchors: Dict[int, str] = {}
        self.by_short: Dict[str, List[Name]] = {}
        self.theory: Dict[int, List[Tuple[str, str]]] = {}  # pages that mention it: title, path
        taken: Dict[str, int] = {}
        for header in headers.values():
            for top in header.names:
                for name in top.all():
                    if header.path.endswith(".fields.h"):  # its page has the keys' owners alone
                        self.anchors[id(name)] = os.path.basename(header.path)
                        continue
                    key = f"{page_of(header.folder)}#{anchor_of(name.short)}"
                    taken[key] = taken.get(key, 0) + 1
                    count = taken[key]
                    self.anchors[id(name)] = anchor_of(name.short) + (f"-{count}" if count > 1 else "")
                    self.by_short.setdefault(name.short, []).append(name)
                    if name.owner:
                        self.by_short.setdefault(name.name, []).append(name)

    def url(self, name: Name) -> str:
        """From the site's root."""
        return f"{page_of(os.path.dirname(name.file))}.html#{self.anchors[id(name)]}"

    def find(self, word: str, near: Optional[str] = None, owner: Optional[Name] = None,
             members: bool = True) -> Optional[Name]:
        """The name that is meant: of the class, of the folder, or the only one; else None."""
        if owner is not None:
            for member in owner.members:
                if member.name == word:
                    return member
            if owner.owner is not None:
                return self.find(word, near, owner.owner, members)
        parts = word.split("::")
        found = self.by_short.get(word, [])
        if not found and len(parts) > 1:
            found = [n for n in self.by_short.get(parts[-1], []) if n.qualified.endswith("::" + word)]
        if not members:
            found = [n for n in found if n.owner is None]
        if near is not None:
            here = [n for n in found if os.path.dirname(n.file) == near]
            found = here or found
        places = {n.qualified for n in found}
        return found[0] if len(places) == 1 else None

    def header(self, word: str, near: str) -> Optional[Header]:
        """The header that a comment names: from its own folder on, or from sinew/."""
        for path in (f"{near}/{word}", f"sinew/{word}", word, os.path.normpath(f"{near}/../{word}")):
            if path in self.headers:
                return self.headers[path]
        found = [h for h in self.headers.values() if h.path.endswith("/" + word)]
        return found[0] if len(found) == 1 else None


def blocks_of(text: str) -> List[Tuple[str, List[str]]]:
    """The lines of a comment as paragraphs (p), points of a list (li) and what is indented (pre)."""
    blocks: List[Tuple[str, List[str]]] = []
    for line in text.strip("\n").split("\n"):
        before = blocks[-1][0] if blocks else ""
        kind = "p"
        if not line.strip():
            kind = ""
        elif re.match(r"[*-] ", line):
            blocks.append(("li", [line]))
            continue
        elif line.startswith(" "):
            kind = "li" if before == "li" else "pre"
        # What is indented on both sides of an empty line is one.
        if kind == "pre" and before == "" and len(blocks) > 1 and blocks[-2][0] == "pre":
            blocks.pop()
            blocks[-1][1].append("")
            before = "pre"
        if blocks and before == kind:
            blocks[-1][1].append(line)
        else:
            blocks.append((kind, [line]))
    return [(kind, lines) for kind, lines in blocks if kind]


def as_it_stands(lines: List[str]) -> str:
    """What is indented, without its margin."""
    margin = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
    inner = "\n".join(html.escape(line[margin:], quote=False) for line in lines)
    return f'<pre class="as-it-stands"><code>{inner}</code></pre>'


class Prose:
    """Turns the words of comments into HTML for a page of the reference."""

    WORDS = re.compile(
        r"(?P<code>`[^`\n]+`)"
        r"|(?P<page>\bdocs/[\w/-]+\.md)"
        r"|(?P<file>\b[\w/]+\.h\b)"
        r"|(?P<call>\b[A-Za-z_][\w:]*)\(\)"
        r"|(?P<type>\b(?:[A-Z][a-z0-9]+){2,}(?:::\w+)*\b)"
    )

    def __init__(self, names: Names, pages: Dict[str, str], folder: str) -> None:
        self.names = names
        self.pages = pages  # Markdown files that the site has, with their titles
        self.folder = folder
        self.root = "../" * page_of(folder).count("/")

    def link(self, name: Optional[Name], text: str) -> str:
        return f'<a href="{self.root}{self.names.url(name)}">{text}</a>' if name else text

    def word(self, match: "re.Match[str]", owner: Optional[Name]) -> str:
        text = html.escape(match.group(0), quote=False)
        if match.group("code"):
            inner = match.group("code").strip("`")
            bare = re.sub(r"\(.*", "", inner)
            name = self.names.find(bare, self.folder, owner) if len(bare) > 3 else None
            return self.link(name, f"<code>{html.escape(inner, quote=False)}</code>")
        if match.group("page"):
            page = match.group("page")
            if page not in self.pages:
                return text
            return f'<a href="{self.root}{page[:-3]}.html">{self.pages[page]}</a>'
        if match.group("file"):
            header = self.names.header(match.group("file"), self.folder)
            if header is None:
                return text
            return f'<a href="{self.root}{page_of(header.folder)}.html#{os.path.basename(header.path)}">{text}</a>'
        if match.group("call"):
            return self.link(self.names.find(match.group("call"), self.folder, owner), text)
        name = self.names.find(match.group("type"), self.folder, owner)
        return self.link(name if name and name.kind in TYPES else None, text)

    def line(self, text: str, owner: Optional[Name] = None) -> str:
        """One run of words."""
        out, last = [], 0
        for match in self.WORDS.finditer(text):
            out.append(html.escape(text[last : match.start()], quote=False))
            out.append(self.word(match, owner))
            last = match.end()
        return "".join(out) + html.escape(text[last:], quote=False)

    def text(self, text: str, owner: Optional[Name] = None) -> str:
        """A comment: paragraphs, lists, and what is indented as it stands."""
        return "\n".join(self.block(kind, lines, owner) for kind, lines in blocks_of(text))

    def block(self, kind: str, lines: List[str], owner: Optional[Name]) -> str:
        if kind == "pre":
            return as_it_stands(lines)
        if kind == "li":
            words = re.sub(r"^[*-] ", "", " ".join(line.strip() for line in lines))
            return f"<ul><li>{self.line(words, owner)}</li></ul>"
        return f"<p>{self.line(' '.join(lines), owner)}</p>"

    def signature(self, name: Name) -> str:
        """A declaration, its types leading to theirs."""
        text = name.signature
        if len(text.split("\n")[-1]) > 88 and "(" in text:
            head, _, rest = text.partition("(")
            inner, close, tail = rest.rpartition(")")
            text = f"{head}(\n    " + re.sub(r", (?![^<(]*[>)])", ",\n    ", inner) + f"{close}{tail}"
        out, last = [], 0
        for match in re.finditer(r"[A-Za-z_]\w*(?:::\w+)*", text):
            out.append(html.escape(text[last : match.start()], quote=False))
            word = match.group(0)
            found = self.names.find(word, self.folder, name.owner) if word != name.name else None
            if found is not None and found.kind in TYPES:
                out.append(self.link(found, word))
            elif word == name.name:
                out.append(f"<b>{word}</b>")
            else:
                out.append(word)
            last = match.end()
        inner = "".join(out) + html.escape(text[last:], quote=False)
        return f'<pre class="signature"><code>{inner}</code></pre>'
