#!/usr/bin/env bash
# transcripts.sh [--accept] FILE...   runs the commands of transcripts (tests/cli/*.txt) and compares
# what they print with what stands below them; --accept writes what was found into the file instead.
#
#   # Heading                   a fresh folder follows, with the shipped robots/ and experiments/
#   Text that is not indented says what the commands show.
#
#     $ sinew check robots/arm.toml         a command of bash (pipefail is set)
#     > --strict                            its next line
#     robots/arm.toml: in order             what it writes on stdout
#     ! warning: …                          what it writes on stderr, each line marked
#     [exit 1]                              its exit code, unless it is 0
#
# In what is expected a line "..." is any number of lines and "[..]" any text; a number with a decimal
# point may differ by one in its last digit. The folder of the commands is written as $HERE, the
# repository as $ROOT. Besides bash's own commands there are
#
#   edit FILE FROM TO   replaces FROM, which must stand in FILE exactly once, by TO
#   field KEY           prints the lines of a JSON text on stdin that have this key
#
# SINEW names the program, build/release/bin/sinew without it.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
SINEW=$(realpath "${SINEW:-$ROOT/build/release/bin/sinew}")
export ROOT SINEW

accept=''
[[ ${1:-} != --accept ]] || { accept=yes; shift; }
(($#)) || { echo "usage: tools/transcripts.sh [--accept] FILE..." >&2; exit 2; }

work=$(mktemp -d)
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

# Writes what a command prints as a transcript has it.
run_command() {  # run_command FOLDER COMMAND_FILE
  local code=0
  (cd "$1" && env -u SINEW_UNITS XDG_CONFIG_HOME="$1/config" LC_ALL=C.UTF-8 PATH="$work/bin:$PATH" \
    bash -o pipefail "$2" </dev/null >"$work/out" 2>"$work/err") || code=$?
  { cat "$work/out"; [[ ! -s $work/out || -z $(tail -c 1 "$work/out") ]] || echo '[no newline]'
    sed 's/^/! /' "$work/err"
    ((code == 0)) || echo "[exit $code]"
  } | sed "s|$1|\$HERE|g; s|$ROOT|\$ROOT|g; s/ *\$//"
}

run_transcript() {  # run_transcript FILE
  local blocks n folder=''
  rm -f "$work"/*.command "$work"/*.found "$work"/*.fresh "$work/accepted"
  blocks=$(awk -v work="$work" -f "$ROOT/tools/numbers.awk" -f "$ROOT/tools/transcripts.awk" split "$1")
  for ((n = 1; n <= blocks; ++n)); do
    if [[ ! $folder || -e $work/$n.fresh ]]; then
      rm -rf "$work/here"
      folder=$work/here
      mkdir "$folder"
      cp -r "$ROOT/robots" "$ROOT/experiments" "$folder"
    fi
    run_command "$folder" "$work/$n.command" >"$work/$n.found"
  done
  awk -v work="$work" -f "$ROOT/tools/numbers.awk" -f "$ROOT/tools/transcripts.awk" judge "$1" >"$work/differs" ||
    if [[ $accept ]]; then
      cp "$work/accepted" "$1"
      echo "$1: accepted"
    else
      cat "$work/differs"
      echo "$1: differs; if what is found is right: tools/transcripts.sh --accept $1"
      return 1
    fi
  commands=$((commands + blocks))
}

failed=0 commands=0
for file in "$@"; do run_transcript "$file" || failed=$((failed + 1)); done
echo "transcripts: $commands commands of $# files, $failed files differ"
((failed == 0))
