#!/usr/bin/env python3
"""words.py [KIND] [PATH]...   finds turns of phrase that plain English does without.

Reads comments and strings of C++, Python and JavaScript, comments of scripts and TOML files, and the
prose of Markdown pages; not tests. tools/words.txt has the turns, one kind a line, and what to write
instead. A use that is right is in tools/words_accepted.txt with its reason. Prints the other lines,
all or of one kind, and then fails.
"""
import fnmatch
import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NOT_OURS = {".git", "build", "node_modules", "runs", "__pycache__"}
NOT_READ = re.compile(r"_test\.|(^|/)tests?/|(^|/)test_|\.test\.|/pictures/|\.bib$|package-lock|^tools/words")
C_LIKE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|`[^`]*`', re.S)
PYTHON = re.compile(r'"""(?:.*?)"""|#[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)
HASH = re.compile(r'"(?:\\.|[^"\\\n])*"|#[^\n]*')
READ = (".h", ".cpp", ".c", ".py", ".pyi", ".js", ".mjs", ".css", ".sh", ".awk", ".cmake", ".toml", ".md", ".html", "")
CODE_IN_PROSE = re.compile(r"`[^`\n]*`|\]\([^)\n]*\)|<!--.*?-->")


def pieces(path, text):
    """Yields (line number, text) for each line of a comment, a string of several words or a paragraph."""
    suffix = path.suffix
    if suffix == ".md":
        fenced = False
        for number, line in enumerate(text.split("\n"), 1):
            if re.match(r"\s*(```|~~~)", line):
                fenced = not fenced
            elif not fenced:
                yield number, CODE_IN_PROSE.sub("", line)
        return
    if suffix in (".h", ".cpp", ".c", ".js", ".mjs", ".css"):
        pattern = C_LIKE
    elif suffix in (".py", ".pyi"):
        pattern = PYTHON
    else:
        pattern = HASH
    for match in pattern.finditer(text):
        piece = match.group()
        is_string = piece[0] in "\"'`R" and not piece.startswith('"""')
        if is_string and " " not in piece:
            continue
        if is_string and suffix in ("", ".sh", ".awk", ".cmake"):
            continue  # parts of commands
        first = text.count("\n", 0, match.start()) + 1
        own_line = not text[text.rfind("\n", 0, match.start()) + 1 : match.start()].strip()
        for offset, line in enumerate(piece.split("\n")):
            yield first + offset, (line.lstrip() if own_line else line)


def table(name):
    rows = (ROOT / "tools" / name).read_text().split("\n")
    return [re.split(r"\t+", row) for row in rows if row.strip() and not row.startswith("#")]


def files_under(path):
    """Yields the names of the repository's files at or below a path, without those that were built."""
    if path.is_file():
        yield str(path.relative_to(ROOT))
    for folder, folders, names in os.walk(path):
        folders[:] = sorted(f for f in folders if f not in NOT_OURS)
        for name in sorted(names):
            yield str((Path(folder) / name).relative_to(ROOT))


def hits_of(name, kinds, accepted):
    path = ROOT / name
    here = [pattern for glob, pattern, _ in accepted if fnmatch.fnmatch(name, glob)]
    found = {}
    previous_comment = 0
    for number, text in pieces(path, path.read_text(errors="replace")):
        continues = text.startswith("//") and previous_comment == number - 1
        if text.startswith("//"):
            previous_comment = number
        left = text
        for pattern in here:
            left = pattern.sub("", left)
        for kind, (pattern, _) in kinds.items():
            if number in found or (kind == "verbless" and continues):
                continue
            if pattern.search(left):
                found[number] = (kind, text.strip())
    return found


def main(words):
    kinds = {row[0]: (re.compile(row[1], re.I if row[0] != "verbless" else 0), row[2]) for row in table("words.txt")}
    accepted = [(glob, re.compile(text, re.I), reason) for glob, text, reason in table("words_accepted.txt")]
    only = words.pop(0) if words and words[0] in kinds else None
    names = [n for word in words or ["."] for n in files_under((ROOT / word).resolve())]
    names = [n for n in names if not NOT_READ.search(n) and Path(n).suffix in READ]
    count = 0
    for name in names:
        for number, (kind, text) in sorted(hits_of(name, kinds, accepted).items()):
            if only in (None, kind):
                print(f"{name}:{number}: {kind}: {text}   write: {kinds[kind][1]}")
                count += 1
    print(f"words: {len(names)} files read, {count or 'no'} lines to reword")
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
