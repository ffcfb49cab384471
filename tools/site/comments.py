"""comments.py - a header of Sinew as Doxygen wants it.

Sinew's headers carry plain comments: the first one of a file says what the file is for, one in front
of a declaration says what that does, one behind a member what that is. Here they become Doxygen's,
with their words as they stand (verbatim), since equations, tables and indented examples are not
Markdown. Every line keeps its number, so that places in the source stay right.

Comments within functions' bodies, and those that a blank line parts from what follows, stay as they
are.
"""

import os
import re
from typing import List, Optional, Tuple

# Doxygen takes "signals:" for a keyword of Qt, so that namespace has another name in its sight.
QT_WORD, OUR_WORD = re.compile(r"\bsignals(?=::| \{)"), "signalsNamespace"

# What opens a brace, so that a comment inside it belongs to a declaration.
DECLARES = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")
# Begins the words that stand behind a member, which are not those of the members below it.
BEHIND = "<"
TEMPLATE = re.compile(r"template\s*<(?:[^<>]|<(?:[^<>]|<[^<>]*>)*>)*>")


def split_comment(line: str) -> Tuple[str, Optional[str]]:
    """Return a line's code and the text behind its //, None where it has no comment."""
    quote = ""
    i = 0
    while i < len(line):
        c = line[i]
        if quote:
            if c == "\\":
                i += 1
            elif c == quote:
                quote = ""
        elif c == '"' or (c == "'" and not (i and line[i - 1].isalnum())):
            quote = c
        elif line.startswith("//", i):
            return line[:i], line[i + 2 :]
        i += 1
    return line, None


class Scopes:
    """Follows the braces of a file: do we stand where things are declared, or in a body?"""

    def __init__(self) -> None:
        self.open: List[str] = []  # "declares", "enum" or "body" for each brace that is open
        self.statement = ""  # what has been read of the one that goes on

    def inside(self) -> str:
        return self.open[-1] if self.open else "declares"

    def take(self, code: str) -> None:
        code = re.sub(r'"(?:[^"\\]|\\.)*"', '""', code)
        code = re.sub(r"(?<![\w])'(?:[^'\\]|\\.)'", "0", code)
        if code.lstrip().startswith("#"):
            return
        for c in code:
            if c == "{":
                self.open.append(self.kind())
                self.statement = ""
            elif c == "}":
                if self.open:
                    self.open.pop()
                self.statement = ""
            elif c == ";":
                self.statement = ""
            else:
                self.statement += c
        self.statement += " "

    def kind(self) -> str:
        if self.inside() == "body":
            return "body"
        words = re.sub(r"alignas\([^()]*(?:\([^()]*\))?[^()]*\)|\[\[[^\]]*\]\]", "", TEMPLATE.sub("", self.statement))
        if not DECLARES.search(words) or re.search(r"[(=]", words):
            return "body"
        return "enum" if re.search(r"\benum\b", words) else "declares"


def verbatim(lines: List[str], marker: str) -> List[str]:
    """Doxygen comments of the texts, as many lines."""
    out = [f"{marker}{text}" for text in lines]
    out[0] = f"{marker} @verbatim{BEHIND if marker.endswith('<') else ''}{lines[0] or ' '}"
    out[-1] += " @endverbatim"
    return out


def file_comment(lines: List[str]) -> int:
    """How many lines the file's own comment has."""
    count = 0
    while count < len(lines) and lines[count].startswith("//"):
        count += 1
    return count


def own_lines(lines: List[str], i: int, out: List[str]) -> int:
    """Convert the comment that has lines of its own from i on; return the line behind it."""
    end = i
    while end < len(lines) and re.match(r"\s*//", lines[end]):
        end += 1
    if end < len(lines) and re.match(r"\s*[^\s}#]", lines[end]):
        before = lines[i][: lines[i].index("//")]
        out += verbatim([split_comment(line)[1] or "" for line in lines[i:end]], before + "///")
    else:
        out += lines[i:end]
    return end


def behind(lines: List[str], i: int, code: str, out: List[str]) -> int:
    """Convert the comment behind the code of line i, and what of it stands below itself."""
    end = i + 1
    goes_on = re.compile(r"\s{%d}//" % len(split_comment(lines[i])[0]))
    while end < len(lines) and goes_on.match(lines[end]):
        end += 1
    if end == i + 1 and re.match(r"\s*enum\b", code):
        # Behind an enum Doxygen would give the words to its last value.
        words = split_comment(lines[i])[1]
        margin = code[: len(code) - len(code.lstrip())]
        out.append(f"{margin}/** @verbatim{BEHIND}{words} @endverbatim */ {code.strip()}")
        return end
    made = verbatim([split_comment(line)[1] or "" for line in lines[i:end]], "///<")
    out.append(code + made[0])
    out += [" " * len(code) + line for line in made[1:]]
    return end


def convert(lines: List[str]) -> List[str]:
    """Return the header's lines with Doxygen's comments, as many."""
    out: List[str] = []
    scopes = Scopes()
    i = file_comment(lines)
    if i:
        # "@file" takes a line of its own, for which #pragma once makes room.
        out = ["/// @file"] + verbatim([line[2:] for line in lines[:i]], "///")
        if i < len(lines) and lines[i].startswith("#pragma once"):
            i += 1
        else:
            raise ValueError(f"found {lines[i:i + 1]} below the file's comment; expected #pragma once")
    while i < len(lines):
        code, text = split_comment(lines[i])
        if text is not None and not code.strip() and scopes.inside() != "body":
            i = own_lines(lines, i, out)
            continue
        scopes.take(code)
        code = QT_WORD.sub(OUR_WORD, code)
        member = code.rstrip().endswith((";", ",", "}")) or scopes.inside() == "enum"
        if text is not None and scopes.inside() != "body" and member:
            i = behind(lines, i, code, out)
        else:
            out.append(code + lines[i][len(split_comment(lines[i])[0]) :])
            i += 1
    return out


def convert_tree(folder: str, out: str, files: List[str]) -> None:
    """Write the converted files of a folder into another one."""
    for name in files:
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            lines = file.read().splitlines()
        path = os.path.join(out, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        try:
            made = convert(lines)
        except ValueError as error:
            raise SystemExit(f"{name}:1: {error}")
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(made) + "\n")
