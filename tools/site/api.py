"""api.py - what the headers declare, from Doxygen's XML, with the words of the headers.

    headers = read_api(xml_folder, source_folder)
    headers["sinew/world/driven/driven_muscle.h"].names[0].members

A name is documented by the comment in front of it, by one behind it, or by that in front of the
declarations that it stands with: a blank line ends such a group.
"""

import glob
import os
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from typing import Dict, Iterator, List, Optional

from comments import BEHIND, OUR_WORD

KINDS = {"class", "struct", "union", "concept"}


@dataclass
class Name:
    """A function, type, constant, member or enumerator."""

    kind: str
    name: str
    qualified: str  # with its namespaces and classes
    file: str
    line: int
    signature: str = ""
    text: str = ""  # in front of it
    behind: str = ""  # behind it
    leader: Optional["Name"] = None  # whose text it shares
    members: List["Name"] = field(default_factory=list)
    owner: Optional["Name"] = None  # the class that it is in
    by_file: bool = False  # the file's comment is its own

    @property
    def short(self) -> str:
        """The name with its classes, without namespaces."""
        return f"{self.owner.short}::{self.name}" if self.owner else self.name

    @property
    def words(self) -> str:
        """Everything that is said of it."""
        shared = self.leader.text if self.leader else ""
        return "\n".join(part for part in (self.text, self.behind, shared) if part)

    def all(self) -> Iterator["Name"]:
        """Yield itself and what is in it."""
        yield self
        for member in self.members:
            yield from member.all()


@dataclass
class Header:
    """A file, with what it declares in the order of its lines."""

    path: str
    purpose: str = ""  # one line
    text: str = ""  # what follows it
    names: List[Name] = field(default_factory=list)

    @property
    def folder(self) -> str:
        return os.path.dirname(self.path)


def flat(element: Optional[ElementTree.Element]) -> str:
    """The text of an element, on one line."""
    return re.sub(r"\s+", " ", "".join(element.itertext())).strip() if element is not None else ""


def comments(element: ElementTree.Element) -> List[str]:
    """The verbatim comments of a declaration."""
    found = []
    for where in ("briefdescription", "detaileddescription"):
        for block in element.findall(f"{where}//verbatim"):
            lines = "".join(block.itertext()).rstrip().split("\n")
            lines = [lines[0]] + [re.sub(r"^\s*///<?", "", line) for line in lines[1:]]
            found.append("\n".join(lines))
    return found


def dedent(text: str) -> str:
    """Without the one blank behind //."""
    return "\n".join(line[1:] if line.startswith(" ") else line for line in text.split("\n")).rstrip()


def take_comments(element: ElementTree.Element, name: Name) -> None:
    for text in comments(element):
        if text.startswith(BEHIND):
            name.behind = dedent(text[len(BEHIND) :]).strip()
        else:
            name.text = dedent(" " + text if not text.startswith(" ") else text)


def template(element: ElementTree.Element) -> str:
    params = []
    for param in element.findall("templateparamlist/param"):
        words = [flat(param.find("type")), flat(param.find("declname"))]
        default = flat(param.find("defval"))
        params.append(" ".join(w for w in words if w) + (f" = {default}" if default else ""))
    if element.find("templateparamlist") is None:
        return ""
    needs = flat(element.find("requiresclause"))
    return f"template <{', '.join(params)}>\n" + (f"requires {needs}\n" if needs else "")


def tidy(text: str) -> str:
    """A type or declaration as the headers lay them out."""
    text = re.sub(r"\s*<\s*", "<", re.sub(r"\s+>", ">", text)) if "operator" not in text else text
    return re.sub(r"\s+([&*])", r"\1", text).replace("template<", "template <")


def arguments(element: ElementTree.Element) -> str:
    """The parameters of a function, with what stands behind them."""
    params = []
    for param in element.findall("param"):
        default = flat(param.find("defval"))
        words = f"{tidy(flat(param.find('type')))} {flat(param.find('declname'))}".strip()
        words += flat(param.find("array"))
        params.append(words + (f" = {default}" if default else ""))
    text = flat(element.find("argsstring"))
    trailing = text[text.rfind(")") + 1 :] if ")" in text else ""
    return f"({', '.join(params)}){' ' + trailing.strip() if trailing.strip() else ''}"


def signature(element: ElementTree.Element) -> str:
    kind, name = element.get("kind"), flat(element.find("name"))
    kind_of = tidy(flat(element.find("type")))
    value = flat(element.find("initializer"))
    if kind == "function":
        static = "static " if element.get("static") == "yes" and element.get("id", "").startswith(("class", "struct")) else ""
        explicit = "explicit " if element.get("explicit") == "yes" else ""
        start = f"{static}{explicit}{kind_of} {name}".strip() if kind_of else f"{explicit}{name}"
        return template(element) + start + arguments(element)
    if kind == "typedef":
        return template(element) + tidy(flat(element.find("definition")).replace(flat(element.find("qualifiedname")), name))
    if kind == "enum":
        strong = "enum class" if element.get("strong") == "yes" else "enum"
        return f"{strong} {name}" + (f" : {kind_of}" if kind_of else "")
    array = flat(element.find("argsstring"))
    return template(element) + f"{kind_of} {name}{array}" + (f" {value}" if value and len(value) < 60 else "")


def place(element: ElementTree.Element) -> tuple:
    where = element.find("location")
    if where is None:
        return "", 0
    return where.get("file", ""), int(where.get("line", "0"))


def read_member(element: ElementTree.Element) -> Name:
    file, line = place(element)
    qualified = flat(element.find("qualifiedname")) or flat(element.find("name"))
    name = Name(element.get("kind", ""), flat(element.find("name")), qualified, file, line, signature(element))
    take_comments(element, name)
    for value in element.findall("enumvalue"):
        inner = Name("enumvalue", flat(value.find("name")), f"{qualified}::{flat(value.find('name'))}", file, line)
        inner.signature = f"{inner.name} {flat(value.find('initializer'))}".strip()
        inner.owner = name
        take_comments(value, inner)
        name.members.append(inner)
    return name


def read_compound(element: ElementTree.Element) -> Name:
    file, line = place(element)
    qualified = flat(element.find("compoundname"))
    kind = element.get("kind", "")
    short = re.split(r"::(?![^<]*>)", qualified)[-1]
    name = Name(kind, short, qualified, file, line, template(element) + f"{kind} {short}")
    if kind == "concept":
        text = "".join(element.find("initializer").itertext()).rstrip()
        name.signature = text.replace(qualified, short).replace(" =  ", " = ").replace("template<", "template <")
    take_comments(element, name)
    for member in element.iter("memberdef"):
        if member.get("prot") != "private" and member.get("kind") != "friend":
            inner = read_member(member)
            inner.owner = name
            if inner.file == file:  # of another file: another class of this name, with which it is mixed up
                name.members.append(inner)
    return name


def share_lines(variables: List[Name]) -> None:
    """double length = 0, rate = 0;  // [m], [m/s]: each its part, or all of them the whole."""
    lines: Dict[int, List[Name]] = {}
    for name in variables:
        lines.setdefault(name.line, []).append(name)
    for together in lines.values():
        text = next((name.behind for name in reversed(together) if name.behind), "")
        parts = text.split(", ")
        for i, name in enumerate(together):
            name.behind = parts[i] if len(parts) == len(together) and all(p.startswith("[") for p in parts) else text


def share_texts(names: List[Name], source: List[str]) -> None:
    """Let declarations without a blank line between them share the comment in front of the first."""
    share_lines([name for name in names if name.kind == "variable"])
    leader: Optional[Name] = None
    last = 0
    for name in sorted(names, key=lambda n: n.line):
        if name.text:
            leader = name
        elif leader is not None and all(line.strip() for line in source[last : name.line - 1]):
            name.leader = leader if not name.behind else None
        else:
            leader = None
        last = name.line


def snake(word: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", word).lower()


def share_file_texts(header: Header) -> None:
    """A file's comment is also that of the name which the file is called by, or of its only one."""
    stem = os.path.basename(header.path)[: -len(".h")]
    alone = len({n.name for n in header.names}) == 1
    for name in header.names:
        if not name.words and (alone or snake(name.name) == stem):
            name.by_file = True


# Nobody asks what these do: it is what they do everywhere. `fields` visits the fields of what it is given.
USUAL = re.compile(r"= ?(default|delete)$|^~|^(begin|end|empty|size|fields)\(\)|operator(?!\(\)|\"\")(?: bool|\W)")


def documented(name: Name) -> bool:
    """Has a function or type words: its own, those of its group or, for a file's one name, the file's?"""
    if name.words or name.by_file or USUAL.search(name.signature) or USUAL.search(f"{name.name}()"):
        return True
    # What each member has words for is described by them.
    parts = [m for m in name.members if m.kind in ("variable", "enumvalue")]
    return bool(parts) and name.kind in ("struct", "enum") and all(m.words for m in parts)


def join(names: List[Name], source: Dict[str, List[str]]) -> None:
    """Put classes into the classes that they stand in, and let groups share their comments."""
    by_name = {n.qualified: n for n in names if n.kind in KINDS}
    for name in list(names):
        outer = re.sub(r"::[^:]*$", "", re.sub(r"<.*", "", name.qualified))
        if name.kind in KINDS and outer in by_name and by_name[outer] is not name:
            name.owner = by_name[outer]
            name.owner.members.append(name)
            names.remove(name)
    for name in names:
        for inner in name.all():
            inner.members.sort(key=lambda n: n.line)
            if inner.kind in KINDS:
                share_texts(inner.members, source[inner.file])


def read_header(element: ElementTree.Element) -> Header:
    file, _ = place(element)
    header = Header(file)
    words = dedent(" " + "\n".join(comments(element)).strip())
    # The purpose is the first paragraph, which begins with the file's name.
    first, _, header.text = words.partition("\n\n")
    header.purpose = re.sub(r"\s+", " ", re.sub(r"^\S+ - ", "", first))
    if re.search(r"\n  ", first):  # a table follows at once
        lines = first.split("\n")
        cut = next(i for i, line in enumerate(lines) if i and line.startswith("  "))
        header.purpose = re.sub(r"^\S+ - ", "", " ".join(lines[:cut]))
        header.text = "\n".join(lines[cut:]) + "\n\n" + header.text
    return header


def declared_private(names: List[Name], source: Dict[str, List[str]]) -> List[str]:
    """Classes that are declared in the private part of another one, and defined outside of it.

    Doxygen takes those for public.
    """
    by_name = {n.qualified: n for n in names if n.kind in KINDS}
    found = []
    for qualified, name in by_name.items():
        outer = by_name.get(qualified.rpartition("::")[0])
        if outer is None or outer.file not in source:
            continue
        access = "private" if outer.kind == "class" else "public"
        for line in source[outer.file][outer.line :]:
            if match := re.match(r"\s*(public|protected|private):", line):
                access = match.group(1)
            elif re.match(rf"\s*(class|struct) {name.name};", line):
                if access == "private":
                    found.append(qualified)
                break
            elif line.startswith("};"):
                break
    return found


def read_api(xml: str, sources: str) -> Dict[str, Header]:
    """Return the headers by their paths. `sources` is the folder that the paths stand in."""
    headers: Dict[str, Header] = {}
    names: List[Name] = []
    hidden = set()  # classes that stand in the private part of others
    for path in sorted(glob.glob(os.path.join(xml, "*.xml"))):
        if os.path.basename(path) == "index.xml":
            continue
        with open(path, encoding="utf-8") as file:
            text = file.read().replace(OUR_WORD, "signals")
        for element in ElementTree.fromstring(text.encode()).findall("compounddef"):
            kind = element.get("kind")
            if kind == "file":
                header = read_header(element)
                headers[header.path] = header
            elif kind in KINDS:
                hidden.update(flat(inner) for inner in element.findall("innerclass[@prot='private']"))
                names.append(read_compound(element))
            elif kind == "namespace":
                names += [read_member(member) for member in element.iter("memberdef")]
    source = {}
    for path in headers:
        with open(os.path.join(sources, path), encoding="utf-8") as file:
            source[path] = file.read().split("\n")
    hidden.update(declared_private(names, source))
    names = [n for n in names if n.qualified not in hidden and not any(n.qualified.startswith(h + "::") for h in hidden)]
    names = [n for n in names if n.file in headers and "@" not in n.qualified and "::detail" not in n.qualified]
    join(names, source)
    for name in names:
        headers[name.file].names.append(name)
    for header in headers.values():
        header.names.sort(key=lambda n: n.line)
        share_texts(header.names, source[header.path])
        share_file_texts(header)
    return headers
