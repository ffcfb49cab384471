#!/usr/bin/env bash
# designs.sh [FOLDER]   which change of the leg's design buys most speed: studies/faster-walk.toml again for each of them, by two
# seeds of the tuner, a quarter as long. About 10 minutes of one processor. The studies stand in FOLDER, build/designs.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8
sinew=${SINEW:-build/release/bin/sinew} folder=${1:-build/designs}
mkdir -p "$folder"

# name, then what is set
designs='
    as-it-is
    hip-flexor-of-three   muscle.hip_flexor.count=3
    hip-extensor-of-three muscle.hip_extensor.count=3
    cams-1.25-in          joint.hip.moment_arm=1.25_in joint.knee.moment_arm=1.25_in
    cams-0.8-in           joint.hip.moment_arm=0.8_in joint.knee.moment_arm=0.8_in
    valves-twice-as-wide  valve.inlet.flow.area=19.548e-6_ft2 valve.exhaust.flow.area=42.84e-6_ft2
    half-the-dead-times   valve.inlet.opening_delay=0.0845_ms valve.inlet.closing_delay=0.13_ms valve.exhaust.opening_delay=0.304_ms valve.exhaust.closing_delay=0.722_ms
'

printf '%-24s %10s %10s   %s\n' design 'seed 1' 'seed 2' 'best speed [in/s]'
while read -r name sets; do
  [[ -n $name ]] || continue
  options=() speeds=()
  for set in $sets; do options+=(--set "${set//_in/ in}"); done
  options=("${options[@]//_ft2/ ft2}") options=("${options[@]//_ms/ ms}")
  for seed in 1 2; do
    plan=$folder/plan-$seed.toml
    sed -e "s|^experiment .*|experiment = \"$PWD/experiments/tuned/faster-walk-front.toml\"|" \
        -e "s/^tuner_seed.*/tuner_seed = $seed/" -e 's/^generations.*/generations = 40/' -e '/^seeds /d' \
        studies/faster-walk.toml >"$plan"
    "$sinew" tune "$plan" "${options[@]}" --results "$folder/$name-$seed.db" --quiet --json >"$folder/$name-$seed.json" || true
    speeds+=("$(sed -n '/"best"/,$ s/.*"trolley.mean_speed \[in\/s\]": \([0-9.]*\).*/\1/p' "$folder/$name-$seed.json" | head -1)")
  done
  printf '%-24s %10.5s %10.5s\n' "$name" "${speeds[@]}"
done <<<"$designs"
