#!/usr/bin/env bash
# designs.sh [FOLDER [SEED]]   compares changes of the leg's design: for each design it computes the front of
# faster-walk-front.toml, then runs faster-walk-one-seed.toml from that front's fastest walk with 90 % passiveness. It takes
# an hour per seed on one core. docs/evidence/studies/designs.csv has its output for seeds 1 and 2 (the dead times only for
# 1), and designs.gp plots it as docs/pictures/designs.png.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8
sinew=${SINEW:-build/release/bin/sinew} folder=${1:-build/designs} seed=${2:-1}
[[ -f $sinew && -x $sinew ]] || { echo "designs.sh: found no program $sinew; build it with ./demo, or name it by SINEW" >&2; exit 1; }
experiments=$PWD/experiments
mkdir -p "$folder"

# bundle MUSCLE SCALE   three actuators instead of two: 1.5 times the external volume, and a transducer with 1.5 times the range.
bundle() {
  echo "muscle.$1.count=3
    muscle.$1.external_volume=0.249 in3
    sensor.$1_tension.real.scale=$2 V/lbf
    sensor.$1_tension.assumed.scale=0.11333 V/lbf"
}
cams() { printf 'joint.%s.moment_arm=%s\n' hip "$1" knee "$1"; }
valves() { printf 'valve.inlet.flow.area=%s ft2\nvalve.exhaust.flow.area=%s ft2\n' "$1" "$2"; }
delays() { printf 'valve.inlet.opening_delay=%s ms\nvalve.inlet.closing_delay=%s ms\nvalve.exhaust.opening_delay=%s ms\nvalve.exhaust.closing_delay=%s ms\n' "$@"; }

sets_of() {
  case $1 in
    as-it-is) ;;
    hip-flexor-of-three) bundle hip_flexor 0.1126 ;;
    hip-extensor-of-three) bundle hip_extensor 0.10733 ;;
    cams-of-0.8-in) cams '0.8 in' ;;
    cams-of-1.25-in) cams '1.25 in' ;;
    valves-half-as-wide) valves 4.887e-6 1.071e-5 ;;
    valves-twice-as-wide) valves 1.9548e-5 4.284e-5 ;;
    delays-halved) delays 0.0845 0.13 0.304 0.722 ;;
    delays-doubled) delays 0.338 0.52 1.216 2.888 ;;
  esac
}

# Prints number and speed of the fastest candidate that satisfies all constraints, and has 90 % passiveness if that is an objective.
fastest() {
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i ~ /^trolley.mean_speed \[/) v = i; if ($i ~ /^passiveness \[/) p = i }; next }
           $3 == "true" && (!p || $p + 0 >= 90) && $v + 0 > best { best = $v + 0; which = $1 } END { print which, best }' "$1"
}

echo 'design,tuner_seed,front at 90 % [in/s],from there [in/s]'
for design in ${DESIGNS:-as-it-is hip-flexor-of-three hip-extensor-of-three cams-of-0.8-in cams-of-1.25-in \
                         valves-half-as-wide valves-twice-as-wide delays-halved delays-doubled}; do
  at=$folder/$design-$seed
  sets=()
  while IFS= read -r set; do
    [[ -z $set ]] || sets+=(--set "${set#"${set%%[! ]*}"}")
  done <<<"$(sets_of "$design")"

  for plan in faster-walk-front faster-walk-one-seed; do
    sed -e "s|^experiment .*|experiment = \"$experiments/walk-test-1.toml\"|" -e "s/^tuner_seed .*/tuner_seed = $seed/" "studies/$plan.toml" >"$at-$plan.toml"
  done
  "$sinew" tune "$at-faster-walk-front.toml" "${sets[@]}" --results "$at-front.db" -o "$at-front.csv" --threads 1 --quiet --force >/dev/null
  read -r which speed < <(fastest "$at-front.csv")
  "$sinew" tune "$at-faster-walk-front.toml" "${sets[@]}" --results "$at-front.db" --candidate "$which" --best "$at-start.toml" --threads 1 --quiet --force >/dev/null
  sed -i -e "s|^experiment .*|experiment = \"$at-start.toml\"|" "$at-faster-walk-one-seed.toml"
  "$sinew" tune "$at-faster-walk-one-seed.toml" --results "$at-best.db" -o "$at-best.csv" --threads 1 --quiet --force >/dev/null
  echo "$design,$seed,$speed,$(fastest "$at-best.csv" | cut -d' ' -f2)"
done
