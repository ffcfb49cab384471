#!/usr/bin/env bash
# statements.sh [--write] [PART]...   checks the statements of figures and experiments, with class and verdict
#
#   statements.sh                 compares all with tests/claims/statements.txt; exit 1 if a line changed
#   statements.sh experiments     only those of experiments/ and experiments/rig/; or: figures
#   statements.sh --write         writes the list again; review the changes before you commit it
#   statements.sh --count         prints the list's counts by class and verdict, as in docs/evidence/evidence.md
#
# SINEW: the program, by default build/release/bin/sinew. RUNS: a folder with a run per experiment, with the names
# of the files; FIGURES: a page of figures. Both are made if they are not given.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8

list=tests/claims/statements.txt
page=docs/evidence/evidence.md  # has the table of --count
sinew=${SINEW:-build/release/bin/sinew}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

of_experiments() {
  local file name run
  for file in experiments/*.toml experiments/rig/*.toml; do
    name=${file%.toml}
    run=${RUNS:-$scratch/runs}/$name
    [[ -d $run ]] || "$sinew" run "$file" -o "$run" --quiet --no-report >/dev/null
    "$sinew" analyze "$run" --quiet --verdicts | node tools/statements.mjs run "$name"
  done
}

of_figures() {
  local made=${FIGURES:-$scratch/figures}
  # Figures are drawn by another program, which may be older than sinew.
  [[ -d $made || ! -d build/release ]] || cmake --build build/release --target sinew_thesis_program >/dev/null
  [[ -d $made ]] || "$sinew" figures --thesis -o "$made" --format csv --quiet >/dev/null
  node tools/statements.mjs figures "$made/index.json"
}

# Prints the page with its table replaced by that of the current list.
page_now() {
  awk -v table="$(node tools/statements.mjs count "$list")" '
    /^<!-- end of statements -->/ { within = 0 }
    !within
    /^<!-- statements:/ { within = 1; print table }' "$page"
}

write='' parts=()
for word in "$@"; do
  case $word in
    --write) write=yes ;;
    --count) exec node tools/statements.mjs count "$list" ;;
    experiments | figures) parts+=("$word") ;;
    -h | --help) awk 'NR > 1 && /^#/ { print substr($0, 3); next } NR > 1 { exit }' "$0"; exit 0 ;;
    *) echo "statements: no part \"$word\": experiments, figures" >&2; exit 2 ;;
  esac
done
((${#parts[@]})) || parts=(experiments figures)

for part in "${parts[@]}"; do
  "of_$part" | sort >"$scratch/$part.list"
  # Pattern of the list's lines of this part.
  [[ $part == figures ]] && mine='^figure ' || mine='^experiments/'
  touch "$list"
  if [[ $write ]]; then
    { grep -v "$mine" "$list" || true; cat "$scratch/$part.list"; } | sort >"$scratch/list"
    cp "$scratch/list" "$list"
  elif ! diff -u --label "$list" <(grep "$mine" "$list") --label "now" "$scratch/$part.list"; then
    echo "statements: $part differ from $list; if they are right: tools/statements.sh --write $part"
    exit 1
  fi
  echo "statements: $(wc -l <"$scratch/$part.list") of $part, as listed in $list"
done

if [[ $write ]]; then
  page_now >"$scratch/page" && cp "$scratch/page" "$page"
elif ! diff -u "$page" <(page_now); then
  echo "statements: the table of $page differs from $list; tools/statements.sh --write updates both"
  exit 1
fi
