#!/usr/bin/env bash
# pictures.sh   makes the pictures of README.md and docs/ from runs: walk.gif, walk.svg, report.png, compare.png,
# stand.png, fit.png and study.png in docs/pictures.
#
# Needs gnuplot, chromium-headless-shell (or chromium) and node, as ./check faces does. The program is that of
# the build folder SINEW_BUILD, by default build/release. With the same version of chromium the same runs give
# the same bytes.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8

program=$PWD/${SINEW_BUILD:-build/release}/bin/sinew
tools/npm-ci.sh web
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

tools/picture.sh docs/pictures/walk.svg

"$program" run experiments/walk-test-1.toml -o "$work/walk" --quiet >/dev/null
node web/animation.mjs "$work/walk/report.html" docs/pictures/walk.gif 1000 530
node web/picture.mjs "$work/walk/report.html" docs/pictures/report.png 7.4

"$program" run experiments/walk-test-2.toml -o "$work/faster" --quiet >/dev/null
"$program" compare "$work/walk" "$work/faster" -o "$work/compare.html" --quiet >/dev/null
node web/picture.mjs "$work/compare.html" docs/pictures/compare.png 3.9

"$program" run experiments/rig/feedback.toml -o "$work/stand" --quiet >/dev/null
node web/picture.mjs "$work/stand/report.html" docs/pictures/stand.png 7

# As in docs/how-to/studies.md.
"$program" sweep experiments/walk-test-1.toml --points 32 --range "joint.hip.angle_gain=0.02:0.08 %/count log" \
  --range "joint.knee.angle_gain=0.02:0.12 %/count" --range "phase.swing.duration=0.5:1 s" \
  --vary "low_level.duty_rounding=none,truncate sum" --results "$work/study.db" -o "$work/study.csv" --quiet \
  --report "trolley.mean_speed_m_per_s [in/s], joints.hip.tracking_rms_rad [deg], air_used_kg [g], joints.hip.passiveness [%]"
"$program" report "$work/study.db" --quiet
node web/picture.mjs "$work/study.html" docs/pictures/study.png 17 light 960

# As in examples/06-characterise.
for psi in 10 20 30 40 50 60 70 80 90 100; do
  "$program" run examples/06-characterise/pressures.toml --set "charge.pressure=$psi psi gauge" \
    -o "$work/$psi" --quiet >/dev/null
  [[ $psi != 10 ]] || head -1 "$work/10/measured.csv" | cut -d, -f2- >"$work/forces.csv"
  tail -n +2 "$work/$psi/measured.csv" | cut -d, -f2- >>"$work/forces.csv"
done
cd "$work"
"$program" identify geometry --trapezoids 37,16 --side "0.057 in" -o mesh.toml --quiet >/dev/null
"$program" identify static forces.csv --actuator mesh.toml --hold-out pressure -o static.toml \
  --quiet >/dev/null
cd - >/dev/null
node web/picture.mjs "$work/static.html" docs/pictures/fit.png
ls -l docs/pictures/walk.gif docs/pictures/walk.svg docs/pictures/{report,compare,stand,fit,study}.png
