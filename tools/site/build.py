#!/usr/bin/python3
"""build.py ROOT OUT WORK   the docs site of the repository ROOT in OUT; WORK is for what lies between.

tools/site.sh calls it, which says more.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from typing import Any, List

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import yaml  # noqa: E402

from docs_pages import Pages, title_of  # noqa: E402
from python_pages import write_python_pages  # noqa: E402
from reference import FOLDER, Reference  # noqa: E402
from sources import write_sources  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
KATEX = "/usr/share/javascript/katex"
OTHERS = re.compile(r"(^|/)(\.[^/]+|node_modules|runs|__pycache__|build[^/]*)(/|$)")
INSTALLED = re.compile(r"^(sinew|thesis|fmu)/.*\.h$")
TESTING = re.compile(r"(_test|/testing)\.h$|/test_[^/]*\.h$")


def all_files(root: str) -> List[str]:
    """What the repository has; without git, what is there and was not built."""
    if os.path.exists(os.path.join(root, ".git")) and shutil.which("git"):
        listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root, capture_output=True, text=True, check=True)
        found = listed.stdout.split("\0")
    else:
        found = [os.path.relpath(os.path.join(top, name), root) for top, _, names in os.walk(root) for name in names]
    return sorted(f for f in found if f and not OTHERS.search(f) and os.path.isfile(os.path.join(root, f)))


def navigation(pages: Pages) -> List[Any]:
    """Tabs, and what stands below them. A page of docs/ that no rule names stands below "More"."""
    titles = dict(pages.titles)

    def take(pattern: str) -> List[Any]:
        chosen = [p for p in titles if re.search(pattern, p)]
        return [{titles.pop(p): p} for p in sorted(chosen)]

    titles.pop("README.md")
    start: List[Any] = ["README.md"] + take(r"^docs/(README|architecture)\.md$") + take(r"^docs/learn/")
    lessons = take(r"^examples/README\.md$") + take(r"^examples/[^/]+/README\.md$")
    notebooks = [f[: -len(".ipynb")] + ".md" for f in pages.files if f.endswith(".ipynb")]
    how = take(r"^docs/how-to/")
    theory = take(r"^docs/theory/")
    evidence = take(r"^docs/(evidence/.*|tuned|calibration|reliability)\.md$")
    reference = take(r"^docs/(reference/.*|dependencies)\.md$")
    python = [{m: f"reference/python/{m.replace('.', '-')}.md"} for m in ("sinew", "sinew.gym", "sinew.identify")]
    more = take(r"")
    return [
        {"Start": start}, {"Lessons": lessons + ([{"Notebooks": notebooks}] if notebooks else [])}, {"How to": how},
        {"Theory": theory}, {"Reference": reference}, {"Evidence": evidence}, {"C++": f"{FOLDER}/files.html"}, {"Python": python},
        {"More": more + [{"Sources": "source/index.html"}]},
    ]


def write_config(work: str, out: str, nav: List[Any]) -> str:
    with open(os.path.join(HERE, "mkdocs.yml"), encoding="utf-8") as file:
        text = file.read().replace("CUSTOM_DIR", os.path.join(HERE, "theme"))
    text += "\n" + yaml.safe_dump({"docs_dir": os.path.join(work, "docs"), "site_dir": out, "nav": nav},
                                  allow_unicode=True, sort_keys=False)
    path = os.path.join(work, "mkdocs.yml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def run_mkdocs(config: str) -> None:
    """MkDocs, strict: a link that leads nowhere is an error."""
    made = subprocess.run(["mkdocs", "build", "--strict", "--clean", "--config-file", config], capture_output=True, text=True)
    # The rest is what it does, which nobody asked for.
    words = re.sub(r"\x1b\[[0-9;]*m", "", made.stdout + made.stderr)  # without colours
    said = "\n".join(re.findall(r".*(?:WARNING|ERROR|CRITICAL|Error).*", words))
    if made.returncode or said:
        raise SystemExit(f"{said}\nmkdocs: found warnings; expected none")


def join_search(out: str, found: str) -> None:
    """Adds the names of Doxygen's pages to the search, and lets a search lead to sections first.

    The theme shows a section's hit where its page has one too. A page with all its text would be
    before its sections, which lead to the place itself: it is found by each of its words once.
    """
    path = os.path.join(out, "search/search_index.json")
    with open(path, encoding="utf-8") as file:
        index = json.load(file)
    for entry in index["docs"]:
        if "#" not in entry["location"]:
            entry["text"] = " ".join(dict.fromkeys(re.findall(r"[\w']+", entry["text"].lower())))
        elif entry["location"].startswith("reference/python/") and "#sinew." in entry["location"]:
            entry["title"] = re.sub(r"\.init$", "(…)", entry["location"].partition("#")[2])
    for doc in ElementTree.parse(found).getroot():
        field = {f.get("name"): f.text or "" for f in doc}
        if field["type"] not in ("source", "dir", "namespace"):
            index["docs"].append({"location": f"{FOLDER}/{field['url']}", "text": field.get("text", ""),
                                  "title": re.sub(r"^sinew::(\w+::(?=\w+::))?", "", field["name"])})
    with open(path, "w", encoding="utf-8") as file:
        json.dump(index, file, ensure_ascii=False, separators=(",", ":"))


def copy_assets(docs: str) -> None:
    shutil.copytree(os.path.join(HERE, "assets"), os.path.join(docs, "assets"), dirs_exist_ok=True)
    katex = os.path.join(docs, "assets/katex")
    os.makedirs(katex)
    for name in ("katex.min.js", "katex.min.css"):
        shutil.copyfile(os.path.join(KATEX, name), os.path.join(katex, name))
    shutil.copytree(os.path.realpath(os.path.join(KATEX, "fonts")), os.path.join(katex, "fonts"),
                    ignore=shutil.ignore_patterns("*.ttf", "*.woff"))


def build(root: str, out: str, work: str) -> None:
    shutil.rmtree(work, ignore_errors=True)
    docs = os.path.join(work, "docs")
    os.makedirs(docs)
    files = all_files(root)
    headers = [f for f in files if INSTALLED.search(f) and not TESTING.search(f)]
    theory = {f: title_of(os.path.join(root, f)) for f in files if re.match(r"docs/theory/.*\.md$", f)}
    reference = Reference(root, work, headers, theory)
    pages = Pages(root, docs, [f for f in files if f.endswith((".md", ".ipynb"))], reference)
    pages.write()
    count, bare = write_python_pages(os.path.join(root, "python"), os.path.join(docs, "reference/python"))
    if bare:
        raise SystemExit("\n".join(bare) + "\nsite: found names of the Python package without a docstring")
    sources = write_sources(root, docs, files, pages.titles)
    copy_assets(docs)
    run_mkdocs(write_config(work, out, navigation(pages)))
    join_search(out, os.path.join(work, "searchdata.xml"))
    print(f"site: {len(pages.titles)} pages, {sum(map(len, reference.names.values()))} names of C++ in "
          f"{len(headers)} headers, {count} of Python, {sources} sources")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    build(*(os.path.abspath(path) for path in sys.argv[1:]))
