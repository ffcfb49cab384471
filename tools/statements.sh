#!/usr/bin/env bash
# statements.sh [--write] [PART]...   what is stated of figures and experiments, with class and verdict
#
#   statements.sh                 all of it against tests/claims/statements.txt; exit 1 if a line changed
#   statements.sh experiments     only those of experiments/ and experiments/rig/; or: figures
#   statements.sh --write         makes the list anew: look at what changed before you keep it
#   statements.sh --count         the list's numbers by class and verdict, as docs/evidence/evidence.md has them
#
# SINEW: the program, build/release/bin/sinew. RUNS: a folder with a run per experiment, named as the
# files are; FIGURES: a page of figures. What is not given is made.
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
  # The program of its own that draws them may be older than sinew.
  [[ -d $made || ! -d build/release ]] || cmake --build build/release --target sinew_thesis_program >/dev/null
  [[ -d $made ]] || "$sinew" figures --thesis -o "$made" --format csv --quiet >/dev/null
  node tools/statements.mjs figures "$made/index.json"
}

# The page with the list's table in the place of the one that it has.
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
  # The list's own lines of that part, and the other ones.
  [[ $part == figures ]] && mine='^figure ' || mine='^experiments/'
  touch "$list"
  if [[ $write ]]; then
    { grep -v "$mine" "$list" || true; cat "$scratch/$part.list"; } | sort >"$scratch/list"
    cp "$scratch/list" "$list"
  elif ! diff -u --label "$list" <(grep "$mine" "$list") --label "now" "$scratch/$part.list"; then
    echo "statements: $part are not as $list has them; if they are right: tools/statements.sh --write $part"
    exit 1
  fi
  echo "statements: $(wc -l <"$scratch/$part.list") of $part, as $list has them"
done

if [[ $write ]]; then
  page_now >"$scratch/page" && cp "$scratch/page" "$page"
elif ! diff -u "$page" <(page_now); then
  echo "statements: the table of $page is not that of $list; tools/statements.sh --write makes both"
  exit 1
fi
