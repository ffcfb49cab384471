#!/usr/bin/env bash
# Four steps of the thesis's leg: runs them and prints their numbers.
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${SINEW_BUILD:-build/release}/bin/sinew

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

numbers() {  # prints the numbers of a run that match a pattern
  awk -f tools/flatten.awk -v digits=3 "$work/$1/summary.json" | grep -E "$2"
  echo
}

echo '$ sinew run experiments/walk-test-1.toml'
"$program" run experiments/walk-test-1.toml -o "$work/walk" --quiet |
  sed -E 's/( +)(agrees|differs|not applicable|source).*/\1\2/'  # sources are long
echo

echo '$ awk -f tools/flatten.awk summary.json | grep …'
numbers walk '^(trolley.(distance|mean_speed|distance_from_torques)_m|joints.*passiveness |passiveness |foot.stick_share|air_used)'

echo '$ sinew run experiments/walk-test-1.toml --set "trolley.drag=0 lbf"'
"$program" run experiments/walk-test-1.toml --set "trolley.drag=0 lbf" -o "$work/easy" --quiet >/dev/null
numbers easy '^trolley.distance_m|^trolley.mean_speed_m'

# The same numbers can be computed again from the log.
"$program" analyze "$work/walk" --json | awk -f tools/flatten.awk | grep -v '^host' >"$work/again"
awk -f tools/flatten.awk "$work/walk/summary.json" | grep -v '^host' >"$work/first"
cmp "$work/first" "$work/again" && echo 'sinew analyze: the same numbers from the log'
