"""Reference of the C++ library: Doxygen's pages of the headers, and the places of their names."""

import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from typing import Dict, List

HERE = os.path.dirname(os.path.abspath(__file__))
FOLDER = "reference/cpp"


def purposes_of(root: str) -> Dict[str, str]:
    """Returns what each folder is for: from the table of docs/architecture.md and from folders.txt."""
    with open(os.path.join(root, "docs/architecture.md"), encoding="utf-8") as file:
        rows = re.findall(r"^\| (\[`.*?) \| (.*?) \|$", file.read(), re.M)
    found: Dict[str, str] = {}
    for links, words in rows:
        folders = re.findall(r"\]\((?:\.\./)?(sinew/[\w/]+)\)", links)
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", words)
        parts = [words] if len(folders) == 1 else words.split("; ")  # a row of two folders has two halves
        if len(parts) == len(folders):
            found.update(zip(folders, parts))
    with open(os.path.join(HERE, "folders.txt"), encoding="utf-8") as file:
        found.update(re.findall(r"^([^#\s]\S*)\s+(.*)", file.read(), re.M))
    return {folder: words[:1].upper() + words[1:] for folder, words in found.items()}


class Reference:
    """Places of headers, folders and names in the site."""

    def __init__(self, root: str, work: str, headers: List[str]) -> None:
        self.root, self.work = root, work
        self.folders = {os.path.dirname(h) for h in headers}
        self.write_folders()
        os.makedirs(os.path.join(work, "docs", FOLDER))
        with open(os.path.join(HERE, "Doxyfile"), encoding="utf-8") as file:
            settings = f"{file.read()}\nINPUT = {work}/folders.dox {' '.join(headers)}\n"
        subprocess.run(["doxygen", "-"], input=settings, cwd=root, text=True, check=True, env={**os.environ, "WORK": work})
        self.read_places()

    def write_folders(self) -> None:
        """Gives Doxygen the purpose of each folder."""
        purposes = purposes_of(self.root)
        if missing := sorted(self.folders - set(purposes)):
            raise SystemExit(f"{missing[0]}: found no words on what it is for; expected a row in docs/architecture.md's "
                             "table of folders, or a line in tools/site/folders.txt")
        with open(os.path.join(self.work, "folders.dox"), "w", encoding="utf-8") as file:
            file.write("/** @mainpage The C++ library\n<a href=\"files.html\">Folders and headers</a>, and the "
                       "<a href=\"annotated.html\">classes</a> that they declare. */\n")
            for folder in sorted(self.folders):
                target = folder.removeprefix("sinew/").replace("/", "_")
                words = f"Target `sinew::{target}`." if folder.startswith("sinew/") else ""
                file.write(f"/** @dir {folder}\n@brief {purposes[folder]}\n\n{words} */\n")

    def folders_of(self, page: str) -> List[str]:
        """Returns the folders of headers that a page has links to."""
        with open(page, encoding="utf-8") as file:
            links = re.findall(r"\]\((?:\.\./)+((?:sinew|thesis|fmu)/[\w/.]+)", file.read())
        return list(dict.fromkeys(f for f in (re.sub(r"/[^/]*\.\w+$", "", k).rstrip("/") for k in links) if f in self.folders))

    def read_places(self) -> None:
        """Reads what Doxygen has found: the places of folders, headers and names."""
        self.places: Dict[str, str] = {}
        self.names: Dict[str, str] = {}
        self.folder_of: Dict[str, str] = {}  # of a page
        self.theory: Dict[str, Dict[str, str]] = {}  # pages with a link to a place, and their titles
        for doc in ElementTree.parse(os.path.join(self.work, "searchdata.xml")).getroot():
            kind, name, url = (doc.findtext(f"field[@name='{field}']", "") for field in ("type", "name", "url"))
            if kind == "dir":
                self.places[name.replace("::", "/")] = f"{FOLDER}/{url}"
            elif kind not in ("file", "source", "namespace", "enumvalue"):
                self.names.setdefault(name, f"{FOLDER}/{url}")
        for file in ElementTree.parse(os.path.join(self.work, "tags.xml")).iterfind("compound[@kind='file']"):
            path = os.path.relpath(file.findtext("path", "") + file.findtext("name", ""), self.root)
            self.places[path] = f"{FOLDER}/{file.findtext('filename')}"
            for page in [self.places[path], *(self.names.get(inner.text or "", "") for inner in file.findall("class"))]:
                self.folder_of[page] = os.path.dirname(path)

    def find(self, word: str, near: List[str]) -> str:
        """Returns the place of a name that a page has as code: in the folders near it, or the only one."""
        inner = "::" in word  # else no member of a class is meant
        found = [place for name, place in self.names.items() if f"::{name}".endswith(f"::{word}")
                 and (inner or name.rpartition("::")[0] not in self.names)] if re.fullmatch(r"\w+(::\w+)*", word) else []
        here = [place for folder in near for place in found if self.folder_of.get(place.split("#")[0]) == folder]
        return here[0] if here else found[0] if inner and len(found) == 1 else ""

    def write_theory(self) -> None:
        """Lets folders, headers and names lead to the theory pages that lead to them."""
        for place, pages in self.theory.items():
            page, _, anchor = place.partition("#")
            links = ", ".join(f'<a href="../../{path[:-3]}.html">{title}</a>' for path, title in pages.items())
            at = f'<a id="{anchor}" name="{anchor}"></a>' if anchor else '<div class="contents">'
            if place.startswith(FOLDER):
                with open(os.path.join(self.work, "docs", page), "r+", encoding="utf-8") as file:
                    text = file.read().replace(at, f'{at}<div class="theory">Theory: {links}</div>', 1)
                    file.seek(0)
                    file.write(text)
