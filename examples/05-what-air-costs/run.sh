#!/usr/bin/env bash
# The same four steps with three kinds of valves, and the distance walked on half a litre of air.
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${SINEW_BUILD:-build/release}/bin/sinew

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

numbers() {  # prints the numbers of a run that match a pattern
  awk -f tools/flatten.awk -v digits=3 "$work/$1/summary.json" | grep -E "$2"
  echo
}

for experiment in walk-test-1 walk-3-way walk-with-regulators; do
  echo "\$ sinew run experiments/$experiment.toml"
  "$program" run "experiments/$experiment.toml" -o "$work/$experiment" --quiet >/dev/null 2>&1
  numbers "$experiment" '^(trolley.distance_m|passiveness |air_used_per_step|air_used_kg_per_m)'
done

echo '$ sinew run experiments/endurance.toml'
"$program" run experiments/endurance.toml -o "$work/endurance" --quiet >/dev/null 2>&1
numbers endurance '^supply'

# Any option can be tried from the command line: here a leak at one muscle.
echo '$ sinew sweep experiments/walk-test-1.toml --vary "muscle.knee_flexor.leak.area=0,0.01,0.1 mm2" …'
"$program" sweep experiments/walk-test-1.toml --vary "muscle.knee_flexor.leak.area=0,0.01,0.1 mm2" \
  --report "trolley.distance_m [in]" --report "air_used_per_step_kg [g]" --quiet 2>/dev/null |
  awk -F, 'NR == 1 { print } NR > 1 { printf "%s,%.3g,%.3g,%s\n", $1, $2, $3, $4 }'
