#!/usr/bin/env bash
# transcripts.sh [--accept] FILE...   runs the commands of transcripts (tests/cli/*.txt) and compares their output
# with the lines below them; --accept writes the actual output into the file instead.
#
#   # Heading                   begins a new folder with the shipped robots/ and experiments/
#   Text that is not indented describes the commands.
#
#     $ sinew check robots/arm.toml         a command of bash (pipefail is set)
#     > --strict                            its next line
#     robots/arm.toml: in order             its output on stdout
#     ! warning: …                          its output on stderr, each line marked
#     [exit 1]                              its exit code, unless it is 0
#
# In expected output a line "..." matches any number of lines and "[..]" any text; a number with a decimal point
# may differ by one in its last digit. The folder of the commands is written as $HERE, the repository as $ROOT.
# Besides bash's own commands there are
#
#   edit FILE FROM TO   replaces FROM, which must occur in FILE exactly once, by TO
#   field KEY           prints the lines of a JSON text on stdin that have this key
#
# SINEW is the program, by default build/release/bin/sinew. It always uses the shipped files of the repository.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
SINEW=$(realpath "${SINEW:-$ROOT/build/release/bin/sinew}")
export ROOT SINEW

accept=''
[[ ${1:-} != --accept ]] || { accept=yes; shift; }
(($#)) || { echo "usage: tools/transcripts.sh [--accept] FILE..." >&2; exit 2; }

# Uses a folder in memory if possible, since each heading copies and removes some hundred files.
work=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$SINEW" "$work/bin/sinew"

# shellcheck disable=SC2317  # called by the transcripts' commands
edit() {
  local text before
  text=$(<"$1")
  before=${text%%"$2"*}
  [[ $before != "$text" ]] || { echo "edit: $1 does not have: $2"; return 1; }
  [[ ${text#*"$2"} != *"$2"* ]] || { echo "edit: $1 has more than once: $2"; return 1; }
  printf '%s\n' "$before$3${text#*"$2"}" >"$1"
}
# shellcheck disable=SC2317
field() { grep -F "\"$1\":"; }
export -f edit field

# The user's settings must not affect the transcripts.
unset SINEW_UNITS
export SINEW_SHARE=$ROOT XDG_CONFIG_HOME=$work/here/config LC_ALL=C.UTF-8 PATH=$work/bin:$PATH

awk_on() { awk -v work="$work" -v root="$ROOT" -f "$ROOT/tools/numbers.awk" -f "$ROOT/tools/transcripts.awk" "$@"; }

run_transcript() {  # run_transcript FILE
  local blocks n code folder=$work/here
  rm -f "$work"/*.command "$work"/*.out "$work"/*.err "$work"/*.code "$work"/*.fresh "$work/accepted"
  blocks=$(awk_on split "$1")
  for ((n = 1; n <= blocks; ++n)); do
    if ((n == 1)) || [[ -e $work/$n.fresh ]]; then
      rm -rf "$folder"
      mkdir "$folder"
      cp -r "$ROOT/robots" "$ROOT/experiments" "$folder"
    fi
    code=0
    (cd "$folder" && exec bash -o pipefail "$work/$n.command" </dev/null >"$work/$n.out" 2>"$work/$n.err") || code=$?
    echo "$code" >"$work/$n.code"
  done
  awk_on judge "$1" >"$work/differs" ||
    if [[ $accept ]]; then
      cp "$work/accepted" "$1"
      echo "$1: accepted"
    else
      cat "$work/differs"
      echo "$1: differs; if the output found is right: tools/transcripts.sh --accept $1"
      return 1
    fi
  commands=$((commands + blocks))
}

failed=0 commands=0
for file in "$@"; do run_transcript "$file" || failed=$((failed + 1)); done
echo "transcripts: $commands commands of $# files, $failed files differ"
((failed == 0))
