#!/usr/bin/python3
"""undocumented.py [--all] WORK   the public names of the installed headers that no comment describes.

WORK is the folder that build.py has read the headers in. A function, class, struct, enum or concept
has words if a comment stands in front of it, behind it, or in front of the declarations that it
stands with; or if it is what its file is for; or if each of its members has some. Exit 1 if one of
the folders that people begin with has a name without words; --all: lists those of the others too.
"""

import os
import re
import sys
from typing import Dict, List

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from api import Header, documented, read_api  # noqa: E402

# Where a program of somebody else begins; all that is below these too.
COMPLETE = ("sinew/actuator", "sinew/air", "sinew/analysis", "sinew/config", "sinew/control/board",
            "sinew/control/gait", "sinew/control/joint", "sinew/control/setup", "sinew/control/supervise",
            "sinew/experiment", "sinew/files", "sinew/gas", "sinew/host", "sinew/identify", "sinew/live", "sinew/log",
            "sinew/muscle.h", "sinew/robot", "sinew/run", "sinew/signals", "sinew/tune", "sinew/units")
KINDS = {"function", "class", "struct", "union", "enum", "concept"}


def without_words(headers: Dict[str, Header]) -> List[str]:
    found = []
    for header in headers.values():
        if header.path.endswith(".fields.h"):
            continue  # tables of keys, each with its own words
        for top in header.names:
            found += [f"{header.path}:{name.line}: {name.kind} {name.short}: no comment says what it is"
                      for name in top.all() if name.kind in KINDS and not documented(name)]
    return found


def main() -> int:
    every = "--all" in sys.argv
    work = sys.argv[-1]
    headers = read_api(os.path.join(work, "xml"), os.path.join(work, "headers"))
    total = sum(1 for h in headers.values() for top in h.names for n in top.all() if n.kind in KINDS)
    found = without_words(headers)
    begin = re.compile(rf"({'|'.join(re.escape(folder) for folder in COMPLETE)})[/:]")
    wrong = [line for line in found if begin.match(line)]
    print("\n".join(found if every else wrong))
    others = len(found) - len(wrong)
    print(f"names: {total - len(found)} of {total} have words; {len(wrong)} without in the folders that must have them, "
          f"{others} elsewhere")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
