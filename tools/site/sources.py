"""sources.py - the repository's text files as plain pages with numbered lines, and its folders as
lists, below source/. They are no part of the search."""

import html
import os
import re
from typing import Dict, List

LARGEST = 300_000  # bytes; what is larger is named and not shown
COMMENT = {
    ".h": "//", ".cpp": "//", ".mjs": "//", ".ts": "//", ".toml": "#", ".py": "#", ".pyi": "#",
    ".sh": "#", ".cmake": "#", ".txt": "#", ".in": "#", "": "#",
}

PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{path} - Sinew</title>
<meta name="viewport" content="width=device-width,initial-scale=1">
<link rel="icon" href="{up}assets/images/favicon.png">
<link rel="stylesheet" href="{up}assets/source.css">
<script src="{up}assets/source.js" data-root="{up}"></script></head>
<body><nav>{crumbs}</nav>
{body}
</body></html>
"""


def crumbs(path: str, up: str) -> str:
    """The way from the front page to a file, each step of it a link."""
    parts = [f'<a href="{up}index.html">Sinew</a>', f'<a href="{up}source/index.html">sources</a>']
    steps = path.split("/") if path else []
    for i, step in enumerate(steps[:-1]):
        parts.append(f'<a href="{up}source/{"/".join(steps[: i + 1])}/index.html">{step}</a>')
    return " / ".join(parts + [f"<b>{step}</b>" for step in steps[-1:]])


def shown_text(path: str, text: str) -> str:
    sign = COMMENT.get(os.path.splitext(path)[1])
    lines = []
    for number, line in enumerate(text.rstrip("\n").split("\n"), 1):
        inner = html.escape(line, quote=False)
        if sign and (match := re.search(rf"(^|\s){sign}(\s|$).*", inner)):
            inner = f"{inner[: match.start()]}<i>{match.group(0)}</i>"
        lines.append(f'<span id="L{number}">{inner}</span>')
    return "<pre>" + "\n".join(lines) + "</pre>"


def write(out: str, path: str, body: str) -> None:
    where = os.path.join(out, "source", path)
    os.makedirs(os.path.dirname(where), exist_ok=True)
    up = "../" * (path.count("/") + 1)
    shown = re.sub(r"(^|/)index\.html$|\.html$", "", path)
    with open(where, "w", encoding="utf-8") as file:
        file.write(PAGE.format(path=shown or "sources", up=up, crumbs=crumbs(shown, up), body=body))


def write_sources(root: str, out: str, files: List[str], pages: Dict[str, str]) -> int:
    """Write a page for each file and folder; `pages` are Markdown files that have one already."""
    folders: Dict[str, Dict[str, str]] = {"": {}}
    count = 0
    for path in files:
        name = os.path.basename(path)
        up = "../" * (path.count("/") + 1)
        link = ""
        full = os.path.join(root, path)
        if path in pages:
            html_of = re.sub(r"README\.html$", "index.html", path[:-3] + ".html")
            link = up + html_of
        elif os.path.getsize(full) <= LARGEST:
            try:
                with open(full, encoding="utf-8") as file:
                    write(out, path + ".html", shown_text(path, file.read()))
                link = name + ".html"
                count += 1
            except UnicodeDecodeError:
                pass  # no text: it is named alone
        label = html.escape(name)
        folder = os.path.dirname(path)
        folders.setdefault(folder, {})[name] = f'<a href="{link}">{label}</a>' if link else label
        while folder:
            above, last = os.path.split(folder)
            folders.setdefault(above, {})[last + "/"] = f'<a href="{last}/index.html">{last}/</a>'
            folder = above
    for folder, entries in folders.items():
        rows = "\n".join(f"<li>{entries[k]}</li>" for k in sorted(entries, key=lambda k: (not k.endswith("/"), k)))
        write(out, os.path.join(folder, "index.html"), f"<ul>{rows}</ul>")
    return count
