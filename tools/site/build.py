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
from typing import Any, Dict, List

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import yaml  # noqa: E402

import comments  # noqa: E402
from api import read_api  # noqa: E402
from cpp_pages import write_cpp_pages  # noqa: E402
from docs_pages import Pages, purposes_of, theory_of  # noqa: E402
from names import Names, Prose, page_of  # noqa: E402
from python_pages import write_python_pages  # noqa: E402
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


def run_doxygen(headers: str, out: str) -> None:
    """Doxygen over the converted headers; a warning is an error."""
    with open(os.path.join(HERE, "Doxyfile"), encoding="utf-8") as file:
        settings = file.read()
    settings += f"\nOUTPUT_DIRECTORY = \"{out}\"\nINPUT = sinew thesis fmu\n"
    made = subprocess.run(["doxygen", "-"], input=settings, cwd=headers, capture_output=True, text=True)
    if made.returncode or made.stderr.strip():
        raise SystemExit(f"{made.stderr}doxygen: found warnings; expected none. Lines are those of the headers.")


def navigation(pages: Pages, folders: List[str]) -> List[Any]:
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
    cpp = ["reference/cpp/index.md"] + [{re.sub("^sinew/", "", f): page_of(f) + ".md"} for f in folders]
    python = [{m: f"reference/python/{m.replace('.', '-')}.md"} for m in ("sinew", "sinew.gym", "sinew.identify")]
    more = take(r"")
    return [
        {"Start": start}, {"Lessons": lessons + ([{"Notebooks": notebooks}] if notebooks else [])}, {"How to": how},
        {"Theory": theory}, {"Reference": reference}, {"Evidence": evidence}, {"C++": cpp}, {"Python": python},
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
    environment: Dict[str, str] = {**os.environ, "PYTHONPATH": HERE}
    made = subprocess.run(["mkdocs", "build", "--strict", "--clean", "--config-file", config],
                          env=environment, capture_output=True, text=True)
    # The rest is what it does, which nobody asked for.
    words = re.sub(r"\x1b\[[0-9;]*m", "", made.stdout + made.stderr)  # without colours
    said = "\n".join(re.findall(r".*(?:WARNING|ERROR|CRITICAL|Error).*", words))
    if made.returncode or said:
        raise SystemExit(f"{said}\nmkdocs: found warnings; expected none")


def search_title(entry: Dict[str, str]) -> str:
    """A name with its class, where the list beside the page has it without."""
    page, _, anchor = entry["location"].partition("#")
    if page.startswith("reference/python/") and anchor.startswith("sinew."):
        return re.sub(r"\.init$", "(…)", anchor)
    if page.startswith("reference/cpp/") and "." in anchor and not anchor.endswith(".h"):
        return anchor.rpartition(".")[0].replace(".", "::") + "::" + entry["title"]
    return entry["title"]


def tidy_search(out: str) -> None:
    """Let a search lead to sections first, and name members with their classes.

    The theme shows a section's hit where its page has one too, and shows of a page what the section
    of its title has. A page with all its text would stand before its sections, which lead to the
    place itself: it is found by every word once.
    """
    path = os.path.join(out, "search/search_index.json")
    with open(path, encoding="utf-8") as file:
        index = json.load(file)
    for entry in index["docs"]:
        if "#" in entry["location"]:
            entry["title"] = search_title(entry)
        else:
            entry["text"] = " ".join(dict.fromkeys(re.findall(r"[\w']+", entry["text"].lower())))
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
    headers_in = [f for f in files if INSTALLED.search(f) and not TESTING.search(f)]
    comments.convert_tree(root, os.path.join(work, "headers"), headers_in)
    run_doxygen(os.path.join(work, "headers"), work)
    headers = read_api(os.path.join(work, "xml"), root)
    names = Names(headers)

    shown = [f for f in files if f.endswith((".md", ".ipynb"))]
    pages = Pages(root, docs, shown, headers, names)
    pages.write()
    front = Prose(names, pages.titles, "sinew/air")  # all folders' pages stand beside each other
    purposes = purposes_of(os.path.join(root, "docs/architecture.md"), os.path.join(HERE, "folders.txt"), front.line)
    folders = write_cpp_pages(docs, headers, names, pages.titles, purposes, theory_of(root, pages.titles))
    count, bare = write_python_pages(root, docs)
    if bare:
        raise SystemExit("\n".join(bare) + "\nsite: found names of the Python package without a docstring")
    sources = write_sources(root, docs, files, pages.titles)
    copy_assets(docs)
    run_mkdocs(write_config(work, out, navigation(pages, folders)))
    tidy_search(out)
    total = sum(1 for h in headers.values() for n in h.names for _ in n.all())
    print(f"site: {len(pages.titles)} pages, {total} names of C++ in {len(folders)} folders, {count} of Python, "
          f"{sources} sources")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    build(*(os.path.abspath(path) for path in sys.argv[1:]))
