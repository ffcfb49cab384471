#!/usr/bin/env bash
# compare-results.sh keep FILE                      writes the results of every shipped experiment as a table
# compare-results.sh compare BEFORE NOW [OPTION]    compares the tables of two builds
#
#   SINEW=build/release/bin/sinew tools/compare-results.sh keep before.tsv
#   … change the code, build …
#   tools/compare-results.sh keep now.tsv
#   tools/compare-results.sh compare before.tsv now.tsv --tolerance 1e-6
#
#   --tolerance R   relative difference up to which two numbers agree; 0 by default: to the last digit
#   --floor A       numbers up to this size count as equal, in SI; 1e-12 by default
#
# A line of the table has experiment, key and value, separated by tabs. Keys are those of summary.json
# (without `host`, which depends on the computer); `verdict KEY: REPORTED` with class and verdict; `log` with
# a hash of the output of `sinew export --csv`, every digit of every channel; `exit` with the run's exit code.
# Tables are not committed; make one with the earlier build.
#
# compare prints a line for each result that differs, is missing or is new, then a summary. It exits with 1
# if there is any, except for logs and state hashes, which are counted only.
#
# SINEW: the program, by default build/release/bin/sinew. JOBS: number of parallel runs, by default 1. ONLY:
# experiment files, by default all of experiments/.
set -euo pipefail
export LC_ALL=C.UTF-8

usage() { awk 'NR > 1 && /^#/ { print substr($0, 3); next } NR > 1 { exit }' "$0"; }

here=$(cd "$(dirname "$0")" && pwd)

# Writes the lines of one experiment into WORK/parts.
result_of() {  # result_of FILE WORK
  local file=$1 work=$2 name=${1%.toml} run code=0
  run=$work/runs/$name
  mkdir -p "$(dirname "$run")" "$(dirname "$work/parts/$name")"
  "$SINEW" run "$file" -o "$run" --quiet --no-report >/dev/null 2>&1 || code=$?
  {
    printf 'exit\t%d\n' "$code"
    [[ ! -f $run/summary.json ]] ||
      awk -f "$here/flatten.awk" -v digits=17 "$run/summary.json" | sed 's/ /\t/' | grep -v '^host'
    ((code)) ||
      "$SINEW" analyze "$run" --quiet --verdicts | node "$here/statements.mjs" run x |
      awk -F ' [|] ' '{ printf "verdict %s\t%s, %s\n", $2, $3, $4 }'
    [[ ! -f $run/log.mcap ]] ||
      printf 'log\t%s\n' "$("$SINEW" export "$run" --csv 2>/dev/null | sha256sum | cut -c 1-32)"
  } | awk -v name="$name" '{ print name "\t" $0 }' >"$work/parts/$name"
  rm -rf "$run"  # large and no longer needed
}

keep() {
  [[ $# == 1 ]] || { usage >&2; exit 2; }
  local out count
  out=$(realpath "$1")
  work=$(mktemp -d)  # not local, since the trap runs after this function
  trap 'rm -rf "$work"' EXIT
  SINEW=$(realpath "${SINEW:-$here/../build/release/bin/sinew}")
  cd "$here/.."
  export SINEW here
  export -f result_of
  # shellcheck disable=SC2016,SC2086  # $0 is of the inner shell; ONLY is a list
  { [[ ${ONLY:-} ]] && printf '%s\n' $ONLY || find experiments -name '*.toml'; } |
    xargs -P "${JOBS:-1}" -I'{}' bash -euo pipefail -c 'result_of "$0" "$1"' '{}' "$work"
  find "$work/parts" -type f -exec cat '{}' + | sort >"$out"
  count=$(find "$work/parts" -type f | wc -l)
  echo "compare-results: $count experiments, $(wc -l <"$out") results in $out"
}

compare() {
  local files=() tolerance=0 floor=1e-12
  while (($#)); do
    case $1 in
      --tolerance) tolerance=${2:?}; shift ;;
      --floor) floor=${2:?}; shift ;;
      -*) usage >&2; exit 2 ;;
      *) files+=("$1") ;;
    esac
    shift
  done
  [[ ${#files[@]} == 2 && -r ${files[0]} && -r ${files[1]} ]] || { usage >&2; exit 2; }
  awk -F '\t' -v tolerance="$tolerance" -v floor="$floor" "$program" "${files[@]}"
}

# shellcheck disable=SC2016  # $ belongs to awk
program='
function is_number(text) { return text ~ /^-?[0-9.]+([eE][-+]?[0-9]+)?$/ }
function size(x) { return x < 0 ? -x : x }

# Returns the relative difference of two numbers; 0 if both are at most the floor.
function difference(a, b,   larger) {
  larger = size(a) > size(b) ? size(a) : size(b)
  return larger <= floor ? 0 : size(a - b) / larger
}

# Compares one result, prints it if it differs, and counts it.
function compare(key, a, b,   off, kind) {
  kind = key ~ / (log|state_hash)$/ ? "logs" : key ~ / verdict / ? "verdicts" : "results"
  ++all[kind]
  off = is_number(a) && is_number(b) ? difference(a, b) : (a != b)
  if (off > most && kind == "results") { most = off; where = " (" key ")" }
  if (off <= tolerance) return
  ++other[kind]
  print key ": " a " -> " b
}

FNR == NR { before[$1 " " $2] = $3; next }
!(($1 " " $2) in before) { print $1 " " $2 ": new"; ++gone; next }
{ compare($1 " " $2, before[$1 " " $2], $3); seen[$1 " " $2] }

END {
  for (key in before) if (!(key in seen)) { print key ": missing"; ++gone }
  printf "%d of %d results differ by more than %s, largest difference %.1e%s; %d of %d logs have other bits; %d of %d verdicts changed\n", \
    other["results"], all["results"], tolerance, most, where, other["logs"], all["logs"], other["verdicts"], all["verdicts"]
  exit (other["results"] + other["verdicts"] + gone > 0)
}
'

# Checks each kind of difference once, and cases without a difference.
self_test() {
  local before now found failed=0
  before=$(mktemp) now=$(mktemp)
  expect() {  # expect CODE WORDS OPTIONS...
    local code=0
    found=$("$0" compare "$before" "$now" "${@:3}") || code=$?
    [[ $code == "$1" && $found == *"$2"* ]] && return
    echo "compare-results --self-test: expected $1 and \"$2\", found $code and: $found"
    failed=1
  }
  line() { printf '%s\t' "${@:1:$#-1}"; printf '%s\n' "${@: -1}"; }

  { line e1 speed_m 1.5; line e1 log abc; line e1 title walk; line e1 'verdict speed_m: 1 m' 'fitted, agrees'; } >"$before"
  cp "$before" "$now"
  expect 0 '0 of 2 results differ by more than 0, largest difference 0.0e+00; 0 of 1 logs have other bits; 0 of 1 verdicts changed'
  sed -i 's/1[.]5$/1.5000003/' "$now"
  expect 1 'e1 speed_m: 1.5 -> 1.5000003'
  expect 0 '0 of 2 results differ by more than 1e-6, largest difference 2.0e-07 (e1 speed_m)' --tolerance 1e-6
  expect 0 '0 of 2 results differ' --floor 2
  { cat "$before"; line e2 speed_m 2; } >"$now"
  expect 1 'e2 speed_m: new'
  sed 1d "$before" >"$now"
  expect 1 'e1 speed_m: missing'
  sed 's/agrees/differs/' "$before" >"$now"
  expect 1 'e1 verdict speed_m: 1 m: fitted, agrees -> fitted, differs'
  sed 's/abc/def/' "$before" >"$now"
  expect 0 'e1 log: abc -> def'
  sed 's/walk/run/' "$before" >"$now"
  expect 1 'e1 title: walk -> run'
  rm "$before" "$now"
  ((failed)) && exit 1
  echo "compare-results: 8 cases of the self-test"
}

case ${1:-} in
  --self-test) self_test ;;
  keep) shift; keep "$@" ;;
  compare) shift; compare "$@" ;;
  -h | --help) usage ;;
  *) usage >&2; exit 2 ;;
esac
