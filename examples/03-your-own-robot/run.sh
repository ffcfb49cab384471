#!/usr/bin/env bash
# Your own robot: a lever on a bench, described only in TOML, and its best gain.
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${SINEW_BUILD:-build/release}/bin/sinew

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo '$ sinew show experiments/one-joint.toml joint.lever.angle_gain joint.lever.stiffness_gain'
"$program" show experiments/one-joint.toml joint.lever.angle_gain joint.lever.stiffness_gain
echo

number() {  # prints one of a run's numbers
  awk -f tools/flatten.awk -v digits=3 "$1/summary.json" |
    awk -v key="$2" '$1 == key { print $2 }'
}

echo '$ sinew run experiments/one-joint.toml --set "joint.lever.angle_gain=… %/count"'
row='%-16s %14s %15s %12s\n'
printf "$row" 'gain [%/count]' 'tracking [rad]' 'passiveness [-]' 'air [kg]'
for gain in 0.03 0.06 0.12 0.24 0.48; do
  run=$work/$gain
  "$program" run experiments/one-joint.toml --set "joint.lever.angle_gain=$gain %/count" -o "$run" \
    --quiet >/dev/null
  printf "$row" "$gain" "$(number "$run" joints.lever.tracking_rms_rad)" \
    "$(number "$run" passiveness)" "$(number "$run" air_used_kg)"
done
echo

echo '$ sinew run experiments/one-joint.toml --set "joint.lever.angle_gian=0.3 %/count"'
"$program" run experiments/one-joint.toml --set "joint.lever.angle_gian=0.3 %/count" \
  -o "$work/typo" 2>&1 || echo "exit code $?"
