"""Text files of the repository as pages with numbered lines, and its folders as lists, below source/.
Headers and Markdown have pages of their own. The search does not cover sources."""

import html
import os
import re
from typing import Callable, Dict, List

from docs_pages import PICTURES

LARGEST = 300_000  # bytes; larger files are not shown

PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{title} - Sinew</title>
<meta name="viewport" content="width=device-width,initial-scale=1">
<link rel="icon" href="{up}assets/images/favicon.png">
<link rel="stylesheet" href="{up}assets/source.css">
<script src="{up}assets/source.js" data-root="{up}"></script></head>
<body><nav>{crumbs}</nav>
{body}
</body></html>
"""


def write(out: str, path: str, name: str, body: str) -> None:
    """Writes the page source/`path` of the file or folder `name`."""
    up = "../" * (path.count("/") + 1)
    steps = name.split("/")
    links = [f'<a href="{up}index.html">Sinew</a>', f'<a href="{up}source/index.html">sources</a>']
    links += [f'<a href="{up}source/{"/".join(steps[:i])}/index.html">{steps[i - 1]}</a>' for i in range(1, len(steps))]
    where = os.path.join(out, "source", path)
    os.makedirs(os.path.dirname(where), exist_ok=True)
    with open(where, "w", encoding="utf-8") as file:
        file.write(PAGE.format(title=name or "sources", up=up, crumbs=" / ".join([*links, f"<b>{steps[-1]}</b>"]), body=body))


def write_sources(root: str, out: str, files: List[str], target: Callable[[str], str]) -> int:
    """Writes the pages; `target` gives the page that a file has. Returns the number of sources."""
    folders: Dict[str, Dict[str, str]] = {"": {}}
    count = 0
    for path in files:
        folder, name = os.path.split(path)
        link = os.path.relpath(re.sub(r"(README)?\.md$", lambda m: "index.html" if m[1] else ".html", target(path)),
                               os.path.join("source", folder))
        full = os.path.join(root, path)
        if link == f"{name}.html":
            try:
                with open(full, encoding="utf-8") as file:
                    lines = file.read().rstrip("\n").split("\n") if os.path.getsize(full) <= LARGEST else []
            except UnicodeDecodeError:
                lines = []
            rows = (f'<span id="L{i}">{html.escape(line, quote=False)}</span>' for i, line in enumerate(lines, 1))
            write(out, f"{path}.html", path, "<pre>" + "\n".join(rows) + "</pre>" if lines else "<p>It is not shown here.</p>")
            count += 1
        elif path.endswith(PICTURES) and not os.path.isfile(os.path.join(out, path)):
            link = ""  # no page shows it
        label = html.escape(name)
        folders.setdefault(folder, {})[name] = f'<a href="{link}">{label}</a>' if link else label
        while folder:
            above, last = os.path.split(folder)
            folders.setdefault(above, {})[last + "/"] = f'<a href="{last}/index.html">{last}/</a>'
            folder = above
    for folder, entries in folders.items():
        rows = (f"<li>{entries[k]}</li>" for k in sorted(entries, key=lambda k: (not k.endswith("/"), k)))
        write(out, os.path.join(folder, "index.html"), folder, "<ul>" + "\n".join(rows) + "</ul>")
    return count
