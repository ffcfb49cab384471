#!/usr/bin/python3
"""check_links.py SITE   every link of the built pages leads to a page and a place in it, and no page
loads anything from elsewhere. Exit 1, and a line for each that does not."""

import os
import re
import sys
from html.parser import HTMLParser
from typing import Dict, List, Set, Tuple
from urllib.parse import unquote

LOADS = {"script": "src", "img": "src", "iframe": "src", "source": "src", "link": "href"}


class Page(HTMLParser):
    """Places, links and loads of one page."""

    def __init__(self) -> None:
        super().__init__()
        self.ids: Set[str] = set()
        self.links: List[str] = []
        self.loads: List[str] = []

    def handle_starttag(self, tag: str, attrs: List[Tuple[str, str]]) -> None:
        given = dict(attrs)
        for key in ("id", "name"):
            if given.get(key):
                self.ids.add(given[key])
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        if tag in LOADS and given.get(LOADS[tag]) and given.get("rel") not in ("canonical", "next", "prev"):
            self.loads.append(given[LOADS[tag]])


def read(path: str) -> Page:
    page = Page()
    with open(path, encoding="utf-8") as file:
        text = file.read()
    # Pages of sources have thousands of lines and no links but those at their head.
    page.feed(text if "<pre><span id=" not in text else text[: text.index("<pre><span id=")])
    page.ids.update(re.findall(r'<span id="(L\d+)">', text))
    return page


def elsewhere(link: str) -> bool:
    return re.match(r"(?:[a-z]+:)?//", link) is not None


def findings(site: str) -> Tuple[List[str], int]:
    pages: Dict[str, Page] = {}
    for folder, _, names in os.walk(site):
        for name in names:
            if name.endswith(".html") and name != "404.html":
                pages[os.path.relpath(os.path.join(folder, name), site)] = read(os.path.join(folder, name))
    found, count = [], 0
    for path, page in sorted(pages.items()):
        for load in page.loads:
            if elsewhere(load):
                found.append(f"{path}: loads {load}; expected a file of the site")
        for link in page.links + [load for load in page.loads if not elsewhere(load)]:
            if re.match(r"[a-z]+:", link):
                continue
            count += 1
            target, _, place = unquote(link).partition("#")
            target = os.path.normpath(os.path.join(os.path.dirname(path), target.split("?")[0])) if target else path
            if target in pages:
                if place and place not in pages[target].ids:
                    found.append(f"{path}: {link}: the page has no such place")
            elif not os.path.isfile(os.path.join(site, target)):
                found.append(f"{path}: {link}: leads nowhere")
    return found, count


def styles(site: str) -> List[str]:
    """What style sheets load from elsewhere."""
    found = []
    for folder, _, names in os.walk(site):
        for name in (n for n in names if n.endswith(".css")):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                for load in re.findall(r"(?:url\(|@import )[\"']?((?:https?:)?//[^\"')]*)", file.read()):
                    found.append(f"{os.path.join(folder, name)}: loads {load}; expected a file of the site")
    return found


if __name__ == "__main__":
    wrong, links = findings(sys.argv[1])
    wrong += styles(sys.argv[1])
    print("\n".join(wrong + [f"links: {links} of the site lead somewhere"] if not wrong else wrong))
    sys.exit(1 if wrong else 0)
