#!/usr/bin/env bash
# layers.sh [--self-test]   checks which folders include which, and a few rules that a compiler does not check.
#
# Prints "file:line: message" for each finding; exit 1 if there is any.

set -euo pipefail
export LC_ALL=C.UTF-8
root=$(cd "$(dirname "$0")/.." && pwd)

# A folder of sinew/ may include itself, the folders of its row sinew_folder(NAME FOLDERS...) in CMakeLists.txt,
# and everything that those may include. A name includes its subfolders: `mechanism` includes mechanism/planar.
# Every folder with sources needs a row. thesis/ may include all of them; cli/, python/ and fmu/ also thesis/;
# cli/ and python/ also fmu/.
layers="
    muscle.h        world/driven
$(awk '
    /^ *sinew_folder\(/ { row = ""; within = 1 }
    within { row = row " " $0 }
    within && /\)/ { sub(/^ *sinew_folder\(/, "", row); sub(/\).*/, "", row); print row; within = 0 }
  ' "$root"/CMakeLists.txt "$root"/cmake/*.cmake)
"

# Folders that only tests (*_test.cpp, *_test.h, test_*.h, testing.h) may include in addition. Tests of any
# folder may include config, to read files of robots/ or experiments/.
test_layers='
    *               config
    mechanism/planar  world
'

# Each external library is used in one folder only. Tests may also use the JSON library directly.
libraries='
    toml[+][+]/     sinew/config
    zlib[.]h        sinew/log
    mcap/           sinew/log
    cvode/          sinew/world
    CLI/            cli
    pybind11/       python/binding
    minizip/        fmu/export
    boost/(asio|beast|system)  sinew/live
    boost/random/   sinew/tune
    sqlite3[.]h     sinew/tune/results
    mpi[.]h         sinew/tune/mpi/module
    pagmo/          sinew/tune/optimizer/module
    comedi          sinew/port/comedi/module
    matio[.]h       sinew/recording/module
    nlohmann/       sinew/json
    ceres/          sinew/identify/contest
    Eigen/          sinew/identify/contest
'

# Largest number of lines of a file, except for tables (*.fields.h) and tests.
longest_file=800

check_tree() {  # check_tree ROOT: findings on stdout, status 1 if there are any
  (
    cd "$1"
    find sinew thesis cli python fmu -type f \( -name '*.h' -o -name '*.cpp' \) 2>/dev/null | sort |
      awk -v layers="$layers" -v test_layers="$test_layers" -v libraries="$libraries" \
          -v longest_file="$longest_file" "$program"
  )
}

# shellcheck disable=SC2016  # $ belongs to awk
program='
function report(file, line, what) { print file ":" line ": " what; findings = 1 }

# Returns the longest row that is the path or a parent of it; "" without one.
function row_of(path) {
  while (path != "") {
    if (path in row) return path
    if (!sub(/\/[^\/]*$/, "", path)) path = ""
  }
  return ""
}
function below(path, name) { return path == name || index(path, name "/") == 1 }

# Fills reach[a, b]: a may include b, directly or through other rows.
function read_tables(   lines, words, n, i, j, k, m, a, b, c, again) {
  n = split(layers, lines, "\n")
  for (i = 1; i <= n; ++i) {
    m = split(lines[i], words, " ")
    if (m > 0) row[words[1]] = lines[i]
  }
  for (a in row) {
    reach[a, a] = 1
    m = split(row[a], words, " ")
    for (j = 2; j <= m; ++j) for (b in row) if (below(b, words[j])) reach[a, b] = 1
  }
  do {
    again = 0
    for (a in row) for (b in row) if ((a, b) in reach)
      for (c in row) if ((b, c) in reach && !((a, c) in reach)) reach[a, c] = again = 1
  } while (again)

  n = split(test_layers, lines, "\n")
  for (i = 1; i <= n; ++i) {
    m = split(lines[i], words, " ")
    for (j = 2; j <= m; ++j) for (b in row) if (below(b, words[j]))
      for (c in row) if ((b, c) in reach) test_reach[words[1], c] = 1
  }

  n = split(libraries, lines, "\n")
  for (i = 1; i <= n; ++i) if (split(lines[i], words, " ") == 2) library[words[1]] = words[2]
}

# Returns code without comments and without the contents of quotes.
function code_of(text,   at) {
  if (in_comment) {
    at = index(text, "*/")
    if (!at) return ""
    text = substr(text, at + 2)
    in_comment = 0
  }
  gsub(/\047([^\047\\]|\\.)\047/, "0", text)
  gsub(/"([^"\\]|\\.)*"/, "\"\"", text)
  sub(/\/\/.*/, "", text)
  gsub(/\/\*[^*]*\*+([^\/*][^*]*\*+)*\//, " ", text)
  at = index(text, "/*")
  if (at) { text = substr(text, 1, at - 1); in_comment = 1 }
  return text
}

function check_include(file, line, target,   folder, mine, theirs, name) {
  for (name in library)
    if (target ~ ("^" name) && !below(file, library[name]) && !(is_test && name == "nlohmann/"))
      report(file, line, "<" target "> may only be included in " library[name])
  if (file ~ /^sinew\// && target ~ /^(thesis|cli|python|fmu)\//) report(file, line, "sinew may not include " target)
  if (file ~ /^fmu\// && target ~ /^(cli|python)\//) report(file, line, "fmu may not include " target)
  if (file ~ /^thesis\// && target ~ /^(cli|python|fmu)\//) report(file, line, "thesis may not include " target)
  if (target !~ /^sinew\//) return
  if (file !~ /^sinew\//) return

  folder = file
  sub(/^sinew\//, "", folder); sub(/\/[^\/]*$/, "", folder)
  sub(/^sinew\//, "", target); sub(/\/[^\/]*$/, "", target)
  mine = row_of(folder)
  theirs = row_of(target)
  if (mine == "") { unknown(file, line, folder); return }
  if (theirs == "") { unknown(file, line, target); return }
  if ((mine, theirs) in reach) return
  if (is_test && (("*", theirs) in test_reach || (mine, theirs) in test_reach)) return
  report(file, line, mine " may not include " theirs)
}
function unknown(file, line, folder) {
  report(file, line, "sinew/" folder " has no row sinew_folder(...) in CMakeLists.txt")
}

function check_file(file,   text, line, code, name, folder) {
  name = file
  sub(/.*\//, "", name)
  is_test = name ~ /_test\.(cpp|h)$|^test_.*\.h$|^testing\.h$/
  in_comment = 0
  line = 0

  if (file ~ /^sinew\//) {
    folder = file
    sub(/^sinew\//, "", folder); sub(/\/[^\/]*$/, "", folder)
    if (row_of(folder) == "" && !(folder in reported)) { unknown(file, 1, folder); reported[folder] = 1 }
  }

  while ((getline text < file) > 0) {
    ++line
    if (!in_comment && match(text, /^[ \t]*#[ \t]*include[ \t]*[<"][^>"]+[>"]/)) {
      text = substr(text, RSTART, RLENGTH - 1)
      sub(/.*[<"]/, "", text)
      check_include(file, line, text)
      continue
    }
    # Permitted are "--set", which show and resolved.toml print as the source of a value, and options of cmake,
    # which build a missing part.
    if (file ~ /^sinew\// && !is_test && text !~ /^[ \t]*\/\// && text !~ /"--set"|cmake --/ &&
        text ~ /"([^"\\]|\\.)*--[a-z]/)
      report(file, line, "an option in a message: the library names settings, `key=value`")
    code = code_of(text)
    if (code ~ /(^|[^A-Za-z0-9_])virtual($|[^A-Za-z0-9_])/ && file != "sinew/signals/port.h" && !is_test)
      report(file, line, "virtual: only sinew/signals/port.h may have virtual functions")
    if (code ~ /^[ \t]*#[ \t]*define[ \t]+[A-Za-z0-9_]+\(/ && !is_test)
      report(file, line, "a macro with arguments: write a function instead")
    if (file ~ /^(sinew|thesis|fmu)\// && !is_test &&
        (code ~ /std::(cout|cerr|clog)/ || code ~ /(^|[^A-Za-z0-9_])v?(printf|puts|putchar)[ \t]*\(/ ||
         code ~ /(^|[^A-Za-z0-9_])fprintf[ \t]*\([ \t]*std(out|err)/ || code ~ /fmt::print(ln)?[ \t]*\(/))
      report(file, line, "the library does not print: return it, or throw it")
  }
  close(file)
  if (line > longest_file && !is_test && name !~ /\.fields\.h$/)
    report(file, line, line " lines, more than " longest_file ": split it")
}

BEGIN { read_tables() }
{ check_file($0) }
END { exit findings ? 1 : 0 }
'

# Tests each rule with code that violates it, and with similar code that does not.
self_test() {
  local count=0 failed=0
  tree=$(mktemp -d)  # not local, since the trap runs after this function
  trap 'rm -rf "$tree"' EXIT

  file() { mkdir -p "$tree/$(dirname "$1")"; printf '%b\n' "$2" >"$tree/$1"; }
  report() { echo "layers.sh --self-test: $1"; failed=1; }
  expect() {  # expect FILE TEXT FINDING   ("" for none)
    count=$((count + 1))
    rm -rf "${tree:?}"/*
    file "$1" "$2"
    local found
    found=$(check_tree "$tree" 2>&1) || true
    if [[ -z $3 ]]; then
      [[ -z $found ]] || report "$1: expected no finding in: $2, found: $found"
    else
      [[ $found == *"$1:"*"$3"* ]] || report "$1: expected \"$3\" in: $2, found: $found"
    fi
  }

  expect sinew/units/a.h          '#include "sinew/gas/air.h"'                 'units may not include gas'
  expect sinew/air/a.h         '#include "sinew/units/unit.h"'              ''  # through gas
  expect sinew/control/joint/a.h  '#include "sinew/units/unit.h"'              'control/joint may not include units'
  expect sinew/control/joint/a.h  '#include "sinew/control/gait/a.h"'          'may not include control/gait'
  expect sinew/control/supervise/a.h '#include "sinew/control/joint/a.h"'      ''
  expect sinew/control/joint/a.h  '#include "sinew/control/supervise/a.h"'     'may not include control/supervise'
  expect sinew/control/link/a.h   '#include "sinew/control/supervise/a.h"'     ''
  expect sinew/control/supervise/a.h '#include "sinew/control/link/a.h"'       'may not include control/link'
  expect sinew/mechanism/planar/a.cpp '#include "sinew/log/writer.h"'          'mechanism/planar may not include log'
  expect sinew/port/recorded/a.h  '#include "sinew/log/reader.h"'              ''
  expect sinew/run/setup/a.h      '#include "sinew/mechanism/planar/a.h"'      ''  # mechanism includes it
  expect sinew/experiment/a.h     '#include "sinew/world/kernel/world.h"'             'experiment may not include world'
  expect sinew/experiment/a.h     '#include "sinew/control/setup/a.h"'         'experiment may not include control/setup'
  expect sinew/control/setup/a.h  '#include "sinew/control/supervise/a.h"'     ''
  expect sinew/control/setup/a.h  '#include "sinew/experiment/a.h"'            'control/setup may not include experiment'
  expect sinew/analysis/a.cpp     '#include "sinew/control/gait/a.h"'          'analysis may not include control/gait'
  expect sinew/gas/a_test.cpp     '#include "sinew/config/reader.h"'           ''
  expect sinew/gas/a.cpp          '#include "sinew/config/reader.h"'           'gas may not include config'
  expect sinew/identify/motion/a_test.cpp '#include "sinew/world/stand.h"'      ''
  expect sinew/identify/sensor/a.cpp '#include "sinew/world/stand.h"'           'identify/sensor may not include world'
  expect sinew/novelty/a.h        'int a;'                                     'no row'
  expect sinew/gas/a.h            '#include "sinew/novelty/a.h"'               'no row'
  expect sinew/gas/a.cpp          '#include <toml++/toml.h>'                   'may only be included in sinew/config'
  expect sinew/config/a.cpp       '#include <toml++/toml.h>'                   ''
  expect sinew/report/a.cpp       '#include "thesis/figures/a.h"'              'sinew may not include'
  expect sinew/report/a.cpp       '#include "cli/terminal.h"'                  'sinew may not include'
  expect thesis/figures/a.cpp     '#include "cli/terminal.h"'                  'thesis may not include'
  expect thesis/figures/a.cpp     '#include "sinew/report/a.h"'                ''
  expect sinew/report/a.cpp       '#include "fmu/export/export.h"'             'sinew may not include'
  expect fmu/export/a.cpp         '#include "sinew/report/a.h"'                ''
  expect thesis/figures/a.cpp     'void f() { std::cout << 1; }'               'does not print'
  expect cli/a.cpp                '#include <zlib.h>'                          'may only be included in sinew/log'
  expect cli/a.cpp                '#include <CLI/CLI.hpp>'                     ''
  expect sinew/log/a.cpp          '#include <pybind11/stl.h>'                  'may only be included in python/binding'
  expect python/binding/a.cpp     '#include <pybind11/stl.h>'                  ''
  expect sinew/report/a.cpp       '#include "python/binding/bind.h"'           'sinew may not include'
  expect sinew/log/a.cpp          '#include <CLI/CLI.hpp>'                     'may only be included in cli'
  expect sinew/gas/a.h            'struct A { virtual void f(); };'            'virtual'
  expect sinew/gas/a.h            'int a;  // virtual work'                    ''
  expect sinew/gas/a.h            '/* virtual\n   virtual work */ int a;'      ''
  expect sinew/gas/a.h            'auto t = "virtual";'                        ''
  expect sinew/signals/port.h     'struct A { virtual void f(); };'            ''
  expect sinew/gas/a.h            '#define twice(x) (2 * (x))'                 'macro'
  expect sinew/gas/a_test.cpp     '#define twice(x) (2 * (x))'                 ''
  expect sinew/gas/a.h            '#define version 3'                          ''
  expect sinew/gas/a.cpp          'void f() { std::cout << 1; }'               'does not print'
  expect sinew/gas/a.cpp          'void f() { printf("a"); }'                  'does not print'
  expect sinew/gas/a.cpp          'void f() { std::snprintf(b, 3, "a"); }'     ''
  expect cli/a.cpp                'void f() { std::cout << 1; }'               ''
  expect sinew/gas/a.cpp          'auto t = "or --map force=NAME";'             'names settings'
  expect sinew/gas/a.cpp          'auto t = "or names.force=NAME";'             ''
  expect sinew/gas/a.cpp          '// "--map" of the program'                   ''
  expect sinew/gas/a_test.cpp     'auto t = "--map";'                           ''
  expect sinew/gas/a.cpp          'auto t = "try cmake --preset release";'      ''
  expect cli/a.cpp                'auto t = "--map";'                           ''
  expect sinew/gas/a.cpp          "$(printf '\\n%.0s' {1..801})"               'more than 800'
  expect sinew/gas/a.fields.h     "$(printf '\\n%.0s' {1..801})"               ''

  if ((failed)); then exit 1; fi
  echo "layers: $count cases of the self-test"
}

case ${1:-} in
  '') check_tree "$root" || exit 1; echo "layers: no violations" ;;
  --self-test) self_test ;;
  *) echo "usage: $0 [--self-test]" >&2; exit 2 ;;
esac
