#!/usr/bin/env bash
# The command lines of README.md, run in a separate folder, and one number of the output of each block.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(cd "$root" && realpath "${SINEW_BUILD:-build/release}/bin/sinew")
sinew() { "$program" "$@"; }

work=$(mktemp -d)
trap 'status=$?; [[ $status == 0 ]] || cat "$work"/*.log >&2; rm -rf "$work"' EXIT
cd "$work"
ln -s "$root/robots" "$root/experiments" .
cp "$root"/examples/13-from-a-lab/{kennlinie,aufnahme}.csv .

{
  sinew run experiments/walk-test-1.toml
  sinew run experiments/walk-test-1.toml --set "joint.hip.angle_gain=0.07 %/count"
  sinew compare runs/walk-test-1/1 runs/walk-test-1/2 -o gain.html
} >walks.log 2>&1
grep '^trolley\.distance .*\(agrees\|differs\)' walks.log

{
  sinew identify static kennlinie.csv --map length=Länge,pressure=Druck,force=Kraft --unit "Druck=bar gauge" --rest-length "200 mm" -o muskel.toml
  sinew new robot arm --metric --actuator muskel.toml
  sinew new experiment heben --metric --of arm/robot.toml
  sinew run heben.toml
  sinew import aufnahme.csv --experiment heben.toml --map /joint/lever/angle=Winkel -o gemessen
  sinew compare gemessen runs/heben/1 --align correlation --clock fit -o vergleich.html
} >muscle.log 2>&1
grep -e '<- chosen' -e '^/joint/lever/angle' muscle.log

ls -- *.html
