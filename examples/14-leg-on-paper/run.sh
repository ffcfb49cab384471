#!/usr/bin/env bash
# From a leg on paper to parts to order: joint, valves, bottle and life of a leg of a six-legged robot of 3 kg, and the
# designed joint in a simulation. docs/how-to/design.md explains each command.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(cd "$root" && realpath "${SINEW_BUILD:-build/release}/bin/sinew")
export SINEW_UNITS=metric

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cp "$here/forces.csv" "$here/robot.toml" "$here/lift.toml" .

sinew() {  # prints a command line, then its output
  local word
  printf '$ sinew'
  for word in "$@"; do
    [[ $word == *[' ()*']* ]] && word="\"$word\""
    printf ' %s' "$word"
  done
  echo
  "$program" "$@" 2>&1 | sed -E 's/[0-9.]+ s in [0-9.]+ s, kept/kept/'
  echo
}

# --- the muscle, from forces of five of its make ---
sinew identify static forces.csv --diameter "20 mm" --name festo20 --no-report --quiet -o muscle.toml | sed -n '1,2p'

# --- the joint: a third of 3 kg at 150 mm, 60 deg in 0.3 s, 6 bar ---
sinew design joint --actuator muscle.toml --rest-length "140 mm:240 mm:20 mm" --load "1 kg" --lever "150 mm" \
  --time "0.3 s" --angles "60 deg" --pressure "6 bar gauge" --external-volume "5 cm3" --moment-arm "8 mm:16 mm:2 mm"
sinew identify scale muscle.toml --rest-length "140 mm" --quiet -o leg-muscle.toml
sinew design joint --actuator leg-muscle.toml --load "1 kg" --lever "150 mm" --time "0.3 s" --angles "60 deg" \
  --pressure "6 bar gauge" --external-volume "5 cm3" --moment-arm "8 mm" --base robot.toml --joint knee -o leg.toml

# --- its valves ---
sinew design valve --actuator leg-muscle.toml --length "139 mm" --contracted-length "131 mm" \
  --external-volume "5 cm3" --supply "6 bar gauge" --pressure "4 bar gauge" --fill-time "0.3 s" --vent-time "0.45 s" \
  --frequency "25 Hz"

# --- the designed joint in a simulation ---
sinew run lift.toml -o lifted

# --- its bottle, and how long its muscles last: six legs of three joints, one stroke per second ---
sinew design air --use leg-muscle.toml --muscles 36 --cycles "1 Hz" --length "139 mm" --contraction "6 %" \
  --muscle-pressure "4 bar gauge" --line "6 bar gauge" --volume "1 L" --pressure "200 bar gauge"
sinew design life --actuator leg-muscle.toml --made swaged --contraction "6 %" --cycles "1 Hz" --muscles 36 \
  --duration "1000 h"
