#!/usr/bin/env bash
# snippets.sh   checks that program lines in pages are lines of programs that are run: C++ and Python in
# examples/*/README.md must be in main.cpp and main.py of that folder; C++, Python and sh in README.md must be in
# main.cpp, main.py and run.sh of examples/readme, and sh in docs/how-to/design.md in run.sh of lesson 14. A snippet must be one contiguous part of its file, word for
# word, except for indentation.
set -euo pipefail
cd "$(dirname "$0")/.."

check='
  function bare(text) { gsub(/^[ \t]+|[ \t\r]+$/, "", text); return text }
  function source_of(language) {
    return folder "/" (language == "sh" ? "run.sh" : "main." (language == "cpp" ? "cpp" : "py"))
  }

  # Returns whether the source has the snippet from line `at` on.
  function has_snippet(at,   k) {
    for (k = 1; k <= lines; ++k) if (source[at + k - 1] != snippet[k]) return 0
    return 1
  }
  function judge(   file, text, count, at) {
    file = source_of(language)
    count = 0
    while ((getline text < file) > 0) source[++count] = bare(text)
    close(file)
    for (at = 1; at + lines - 1 <= count; ++at) if (has_snippet(at)) { ++good; return }
    printf "%s:%d: found lines that are not in %s; expected a contiguous part of it, word for word\n", FILENAME, begin, file
    bad = 1
  }

  FNR == 1 {
    folder = FILENAME
    if (!sub(/\/[^\/]*$/, "", folder)) folder = "examples/readme"
    if (folder == "docs/how-to") folder = "examples/14-leg-on-paper"
    language = ""
  }
  /^```/ && language != "" { judge(); language = ""; next }
  /^```(cpp|python)$/ || (/^```sh$/ && FILENAME !~ /^examples/) {
    language = substr($0, 4); begin = FNR; lines = 0; next
  }
  language != "" { snippet[++lines] = bare($0) }
  END { if (bad) exit 1; print "snippets: " good " in pages, each is in its program" }
'
awk "$check" README.md docs/how-to/design.md examples/*/README.md
