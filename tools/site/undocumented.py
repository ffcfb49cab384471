#!/usr/bin/python3
"""undocumented.py WORK   the public names of the installed headers that no comment describes.

WORK is the folder that build.py has read the headers in. A function, class, struct, enum or concept
has words if a comment stands in front of it, behind it, or in front of the declarations that it
stands with; or if it is what its file is for; or if each of its members has some. Exit 1 if one has
none.
"""

import os
import sys
from typing import Dict, List

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from api import Header, documented, read_api  # noqa: E402

KINDS = {"function", "class", "struct", "union", "enum", "concept"}


def without_words(headers: Dict[str, Header]) -> List[str]:
    found = []
    for header in headers.values():
        if header.path.endswith(".fields.h"):
            continue  # tables of keys, each with its own words
        for top in header.names:
            found += [f"{name.file}:{name.line}: {name.kind} {name.short}: no comment says what it is"
                      for name in top.all() if name.kind in KINDS and not documented(name)]
    return found


def main() -> int:
    work = sys.argv[1]
    headers = read_api(os.path.join(work, "xml"), os.path.join(work, "headers"))
    total = sum(1 for h in headers.values() for top in h.names for n in top.all() if n.kind in KINDS)
    found = without_words(headers)
    if found:
        print("\n".join(found))
    print(f"names: {total - len(found)} of {total} have words")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
