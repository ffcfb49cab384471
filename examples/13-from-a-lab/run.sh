#!/usr/bin/env bash
# Files of a laboratory, used without an editor: from a rig's table to a muscle, from the muscle to a robot, and a
# recording of the machine compared with the simulated one. Every command takes less than five seconds.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(cd "$root" && realpath "${SINEW_BUILD:-build/release}/bin/sinew")
export SINEW_UNITS=metric

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cp "$here/kennlinie.csv" "$here/aufnahme.csv" .

slowest=5  # longest time of a command [s]
lesson() {  # prints a command line, then its output
  local word before=$EPOCHREALTIME after
  printf '$ sinew'
  for word in "$@"; do
    [[ $word == *[' ()*']* ]] && word="\"$word\""
    printf ' %s' "$word"
  done
  echo
  "$program" "$@" 2>&1 | sed -E 's/[0-9.]+ s in [0-9.]+ s, kept/kept/; s/, [0-9.]+ MB$//'
  echo
  after=$EPOCHREALTIME
  ((${after/[.,]/} - ${before/[.,]/} < slowest * 1000000)) || { echo "this took longer than $slowest s" && exit 1; }
}

# --- rig: identification of the muscle ---
lesson identify static kennlinie.csv --map length=Länge,pressure=Druck,force=Kraft --unit "Druck=bar gauge" \
  --rest-length "200 mm" --name muskel -o muskel.toml

# --- joint with two muscles, and its experiment ---
lesson new robot arm --metric --actuator muskel.toml
lesson new experiment heben --metric --of arm/robot.toml
lesson run heben.toml --set sequence.repeat=10 -o gerechnet

# --- recording of the machine ---
lesson import aufnahme.csv --experiment heben.toml --set sequence.repeat=10 --map /joint/lever/angle=Winkel \
  --map "/muscle/flexor/pressure=Druck Beuger" --map "/muscle/extensor/pressure=Druck Strecker" \
  --unit "Druck Beuger=bar gauge" --unit "Druck Strecker=bar gauge" --save-mapping aufnahme.toml -o gemessen
lesson compare gemessen gerechnet --align correlation --clock fit -o vergleich.html

# --- the same with measured mass and friction ---
lesson run heben.toml --set sequence.repeat=10 --set "link.lever.mass=300 g" --set "link.lever.inertia=580 kg mm2" \
  --set "joint.lever.damping=0.12 N m s/rad" --set "joint.lever.dry_friction=0.09 N m" -o gewogen
lesson compare gemessen gewogen --align correlation --clock fit -o vergleich-2.html

# --- figure for a report ---
lesson figures gemessen gewogen --label gemessen --label gerechnet --align correlation --clock fit \
  --channels "/joint/lever/angle,/muscle/*/pressure" --format pdf --width "84 mm" -o bilder
ls bilder
