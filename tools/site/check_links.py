#!/usr/bin/python3
"""check_links.py SITE   every link of the built pages leads to a page and a place in it, and no page
loads anything from elsewhere. Exit 1, and a line for each that does not."""

import glob
import os
import re
import sys
from typing import Dict, List, Set
from urllib.parse import unquote

LINK = re.compile(r'<(?:a|script|img|iframe|source|link|form)\b[^>]*?\s(?:href|src|action)="([^"]*)"[^>]*>')
LOADS = re.compile(r'<(?:script|img|iframe|source|link)\b(?![^>]*rel="(?:canonical|next|prev)")[^>]*\s(?:href|src)="((?:https?:)?//[^"]*)"')
PLACE = re.compile(r'\s(?:id|name)="([^"]+)"')
STYLE = re.compile(r"(?:url\(|@import )[\"']?((?:https?:)?//[^\"')]*)")
# Doxygen lists it for classes whose inner classes are all private, too; reference.css hides it.
DEAD = "#nested-classes"


def read(path: str) -> str:
    with open(path, encoding="utf-8") as file:
        return file.read()


def main(site: str) -> int:
    texts = {os.path.relpath(p, site): read(p) for p in glob.glob(f"{site}/**/*.html", recursive=True)}
    texts.pop("404.html", None)
    places: Dict[str, Set[str]] = {path: set(PLACE.findall(text)) for path, text in texts.items()}
    found: List[str] = []
    count = 0
    for path, text in sorted(texts.items()):
        found += [f"{path}: loads {load}; expected a file of the site" for load in LOADS.findall(text)]
        for link in dict.fromkeys(LINK.findall(text)):
            if re.match(r"[a-z]+:|//", link) or link in ("", "#", DEAD):
                continue
            count += 1
            target, _, place = unquote(link.replace("&amp;", "&")).partition("#")
            target = os.path.normpath(os.path.join(os.path.dirname(path), target.split("?")[0])) if target else path
            if target in texts and place and place not in places[target]:
                found.append(f"{path}: {link}: the page has no such place")
            elif target not in texts and not os.path.isfile(os.path.join(site, target)):
                found.append(f"{path}: {link}: leads nowhere")
    for path in glob.glob(f"{site}/**/*.css", recursive=True):
        found += [f"{path}: loads {load}; expected a file of the site" for load in STYLE.findall(read(path))]
    print("\n".join(found) or f"links: {count} of the site lead somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
