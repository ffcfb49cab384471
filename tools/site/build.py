#!/usr/bin/python3
"""build.py ROOT WORK <FILES   pages for MkDocs in WORK/docs, of the repository ROOT, which has FILES.

tools/site.sh calls it.
"""

import os
import re
import sys
from typing import List

from docs_pages import Pages
from python_pages import write_python_pages
from reference import Reference
from sources import write_sources


def build(root: str, work: str, files: List[str]) -> None:
    docs = os.path.join(work, "docs")
    headers = [f for f in files if re.match(r"(sinew|thesis|fmu)/.*\.h$", f) and not re.search(r"_test\.h|/testing\.h|/test_", f)]
    reference = Reference(root, work, headers)
    pages = Pages(root, docs, [f for f in files if f.endswith((".md", ".ipynb"))], reference)
    pages.write()
    reference.write_theory()
    count = write_python_pages(os.path.join(root, "python"), os.path.join(docs, "reference/python"))
    sources = write_sources(root, docs, files, pages.target)
    print(f"site: {len(pages.titles)} pages, {len(reference.names)} names of C++ in {len(headers)} headers, {count} of Python, {sources} sources")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    build(*map(os.path.abspath, sys.argv[1:]), [name for name in sys.stdin.read().split("\n") if os.path.isfile(name)])
