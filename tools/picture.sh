#!/usr/bin/env bash
# picture.sh [FILE]   draws a side view of the walk of experiments/walk-test-1.toml, by default as
# docs/pictures/walk.svg. pictures.sh calls it and makes the other pictures.
#
# It runs the experiment, exports its log as CSV and draws it with gnuplot (Debian: gnuplot-nox). The program is
# that of the build folder SINEW_BUILD, by default build/release.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8

picture=${1:-docs/pictures/walk.svg}
program=${SINEW_BUILD:-build/release}/bin/sinew
command -v gnuplot >/dev/null || { echo "picture.sh: needs gnuplot (gnuplot-nox)" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# --- the run, and the lengths it used [in] --------------------------------------------------------

"$program" run experiments/walk-test-1.toml -o "$work/run" --quiet >/dev/null
"$program" export "$work/run" --csv --channels '/plan/*' '/true/joint/*/angle' \
  '/true/trolley/position' '/true/foot/*' --quiet >"$work/walk.csv"

inches() {  # inches KEY: prints a value of the run, converted from SI
  "$program" show "$work/run/resolved.toml" "$1" --json | awk -f tools/flatten.awk -v digits=9 |
    awk '$1 == "[0].written" || $1 == "[0].si" { si = $2 } END { print si / 0.0254 }'
}
femur=$(inches link.femur.length)
radius=$(inches foot.radius)
table=$(inches ground.height)

# --- one line per sample: step, phase, hip x, knee x y, ankle x y, load --------------------------

awk -F, -v femur="$femur" '
  function inches(name) { return $column[name] / 0.0254 }
  NR == 1 { for (i = 1; i <= NF; ++i) { split($i, part, " "); column[part[1]] = i } next }
  $column["/plan/phase"] != "" && $column["/plan/phase"] >= 0 {
    hip = inches("/true/trolley/position")
    angle = $column["/true/joint/hip/angle"]
    printf "%d %d %.4f %.4f %.4f %.4f %.4f %d\n", $column["/plan/step"], $column["/plan/phase"], hip,
      hip + femur * cos(angle), femur * sin(angle),
      hip + inches("/true/foot/position.x"), inches("/true/foot/position.y"),
      ($column["/true/foot/force.y"] > 0)
  }' "$work/walk.csv" >"$work/walk.dat"

# The leg at every `every` samples of the second and third step, as hip - knee - ankle: dark in stance, light in
# swing; with the trolley and the foot's disc.
every=20
awk -v every=$every -v standing="$work/standing" -v swinging="$work/swinging" \
    -v hips="$work/hips" -v feet="$work/feet" -v path="$work/path" '
  $1 != 1 && $1 != 2 { next }
  { print $6, $7 >path }
  n++ % every == 0 {
    out = $8 ? standing : swinging
    printf "%s 0\n%s %s\n%s %s\n\n", $3, $4, $5, $6, $7 >out
    print $3, 0 >hips
    if ($8) print $6, $7 >feet
  }' "$work/walk.dat"

# --- the picture ----------------------------------------------------------------------------------

gnuplot <<END
set terminal svg size 1000,430 dynamic enhanced background rgb 'white' font 'sans-serif,14'
set output '$picture'
set encoding utf8

set size ratio -1
set xrange [1:42.4]
set yrange [-14.6:2.5]
set xlabel 'position along the track [in]' tc rgb '#222222'
set ylabel 'height above the hip [in]' tc rgb '#222222'
set xtics 5 out nomirror
set ytics -15,5,0 out nomirror
set border 3 lc rgb '#444444'
set tics textcolor rgb '#222222'
set key outside top center horizontal samplen 2 tc rgb '#222222' width 1 height 0.4

ground = $table - $radius
track = 1.6

# The table with its surface, and the track on which the trolley rolls.
set object 1 rectangle from graph 0, first ground-0.45 to graph 1, first ground \
  fc rgb '#e6dccb' fs solid noborder behind
set arrow 1 from graph 0, first ground to graph 1, first ground nohead lw 1.5 lc rgb '#7a6a4f'
set arrow 2 from graph 0, first track to graph 1, first track nohead lw 2.5 lc rgb '#a0a0a0'
set label 1 'track' at graph 0.99, first track+0.5 right tc rgb '#666666' font ',13'
set label 2 'table' at graph 0.99, first ground+0.5 right tc rgb '#7a6a4f' font ',13'
set style fill transparent solid 0.25 border rgb '#777777'

plot '$work/hips' using 1:(track/2):(0.8):(track/2-0.2) with boxxyerror lc rgb '#b8b8b8' lw 0.8 \
       title 'trolley', \
     '$work/swinging' with lines lw 1.3 lc rgb '#8fb3dc' title 'leg in swing', \
     '$work/standing' with lines lw 2 lc rgb '#1f4e8c' title 'leg on the table', \
     '$work/feet' using 1:2:($radius) with circles fs empty border lw 1.6 lc rgb '#1f4e8c' notitle, \
     '$work/path' using 1:2 with lines lw 2 lc rgb '#d9642c' title 'path of the ankle', \
     '$work/hips' using 1:2 with points pt 7 ps 0.4 lc rgb '#333333' notitle
END
echo "$picture"
