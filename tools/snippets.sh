#!/usr/bin/env bash
# snippets.sh   the lines of C++ and Python in examples/*/README.md stand in main.cpp and main.py beside it, one
# after the other; how far they are indented does not matter.
set -euo pipefail
cd "$(dirname "$0")/.."

check='
  function bare(text) { gsub(/^[ \t]+|[ \t\r]+$/, "", text); return text }
  function source_of(language) { return folder "/main." (language == "cpp" ? "cpp" : "py") }

  # Does the snippet stand in the source from its line `at` on?
  function stands(at,   k) {
    for (k = 1; k <= lines; ++k) if (source[at + k - 1] != snippet[k]) return 0
    return 1
  }
  function judge(   file, text, count, at) {
    file = source_of(language)
    count = 0
    while ((getline text < file) > 0) source[++count] = bare(text)
    close(file)
    for (at = 1; at + lines - 1 <= count; ++at) if (stands(at)) { ++good; return }
    printf "%s:%d: found lines that do not stand in %s; expected a piece of it, word for word\n", FILENAME, begin, file
    bad = 1
  }

  FNR == 1 { folder = FILENAME; sub(/\/[^\/]*$/, "", folder); language = "" }
  /^```/ && language != "" { judge(); language = ""; next }
  /^```(cpp|python)$/ { language = substr($0, 4); begin = FNR; lines = 0; next }
  language != "" { snippet[++lines] = bare($0) }
  END { if (bad) exit 1; print "snippets: " good " in the READMEs of examples/, each stands in its program" }
'
awk "$check" examples/*/README.md
