#!/usr/bin/env bash
# examples.sh [--accept] [NAME]...   runs examples/NAME/run.sh (all of them without a name) and
# compares what it prints with expected.txt; --accept writes expected.txt anew instead.
#
# SINEW_BUILD names the build folder whose program they run; build/release without it.
set -euo pipefail
cd "$(dirname "$0")/.."

accept=
[[ ${1:-} != --accept ]] || { accept=yes; shift; }
names=("$@")
if ((${#names[@]} == 0)); then
  for script in examples/*/run.sh; do names+=("$(basename "$(dirname "$script")")"); done
fi

found=$(mktemp)
trap 'rm -f "$found"' EXIT
for name in "${names[@]}"; do
  folder=examples/$name
  [[ -x $folder/run.sh ]] || { echo "$folder/run.sh: not there, or not a program" >&2; exit 1; }
  "$folder/run.sh" >"$found" || { cat "$found"; echo "$name: run.sh failed" >&2; exit 1; }
  if [[ $accept ]]; then
    cp "$found" "$folder/expected.txt"
    echo "$name: accepted"
    continue
  fi
  awk -f tools/compare.awk "$folder/expected.txt" "$found" || {
    echo "$name: prints something else; if that is right: tools/examples.sh --accept $name" >&2
    exit 1
  }
  echo "$name: as expected"
done
