#!/usr/bin/env bash
# random-legs.sh [FOLDER]   runs studies/random-legs.toml, whose table of 60 MB is stored in FOLDER (by default build/random-legs) and
# can be continued after Ctrl-C, and makes from it the numbers and the picture of docs/evidence/random-legs.md:
# random-legs.csv and random-legs-distance.csv in docs/evidence/studies, docs/pictures/random-legs.png.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8
sinew=${SINEW:-build/release/bin/sinew} folder=${1:-build/random-legs} out=docs/evidence/studies
[[ -f $sinew && -x $sinew ]] || { echo "random-legs.sh: found no program $sinew; build it with ./demo, or name it by SINEW" >&2; exit 1; }
mkdir -p "$folder"
legs=$folder/legs.csv
[[ -f $legs ]] || "$sinew" sweep studies/random-legs.toml --results "$folder/legs.db" ${THREADS:+--threads "$THREADS"} -o "$legs"

# Prints the number of the column whose name begins so.
column() { head -1 "$legs" | tr ',' '\n' | grep -n -F "$1" | head -1 | cut -d: -f1; }

distance=$(column 'trolley.distance [')
parameters=$((distance - 2))   # the seed, which is before it, is no parameter

# Prints the ranks of a column in the order of the rows.
ranks() { tail -n +2 "$legs" | cut -d, -f"$1" | nl -ba | sort -k2,2g -s | awk '{ print $1, NR }' | sort -n | cut -d' ' -f2; }

# Prints the legs whose six numbers of test 1 are in the bands of experiments/walk-test-1.toml.
agreeing() {
  awk -F, -v d="$distance" -v v="$(column trolley.mean_speed)" -v t="$(column trolley.distance_from_torques)" \
      -v hip="$(column joints.hip.passiveness)" -v knee="$(column joints.knee.passiveness)" -v peak="$(column muscles.hip_extensor)" '
    function within(x, low, high) { return x >= low && x <= high }
    NR > 1 && within($d, 55, 60) && within($v, 4.275, 4.725) && within($t, 54, 66) && within($hip, 92, 96) && within($knee, 64, 68) && within($peak, 27, 33)' "$legs"
}

agreeing >"$folder/agreeing.csv"
tail -n +2 "$legs" | cut -d, -f"$distance" | sort -g >"$folder/distances"
awk '{ ++n[int($1)] } END { print "distance from [in],legs"; for (i = 0; i <= 120; ++i) print i "," n[i] + 0 }' "$folder/distances" >"$out/random-legs-distance.csv"

ranks "$distance" >"$folder/ranks"
{
  echo "parameter,from,to,rank correlation,fitted,5 % of the legs that agree,median,95 %"
  for ((c = 1; c <= parameters; ++c)); do
    name=$(head -1 "$legs" | cut -d, -f"$c")
    range=$(sed -n "s/^ *\"${name%% *}=\([^ \"]*\).*/\1/p" studies/random-legs.toml)
    fitted=$("$sinew" show experiments/walk-test-1.toml "${name%% *}" | awk 'NR == 2 { print $2 }')
    correlation=$(paste -d' ' <(ranks "$c") "$folder/ranks" | awk '
      { a += $1; b += $2; aa += $1 * $1; bb += $2 * $2; ab += $1 * $2 }
      END { printf "%.3f", (ab - a * b / NR) / sqrt((aa - a * a / NR) * (bb - b * b / NR)) }')
    quantiles=$(cut -d, -f"$c" "$folder/agreeing.csv" | sort -g |
      awk '{ x[NR] = $1 } END { printf "%.4g,%.4g,%.4g", x[int(0.05 * NR) + 1], x[int(NR / 2) + 1], x[int(0.95 * NR) + 1] }')
    echo "$name,${range/:/,},$correlation,$fitted,$quantiles"
  done
} >"$out/random-legs.csv"

awk '{ x[NR] = $1; between += $1 >= 55 && $1 <= 60; beyond += $1 > 60 } END {
  printf "%d legs, distance [in]: 5 %% %.1f, 25 %% %.1f, median %.1f, 75 %% %.1f, 95 %% %.1f, %.1f to %.1f in all\n",
    NR, x[int(0.05 * NR) + 1], x[int(NR / 4) + 1], x[int(NR / 2) + 1], x[int(3 * NR / 4) + 1], x[int(0.95 * NR) + 1], x[1], x[NR]
  printf "55 to 60 in: %.1f %%, more than the track of 60 in: %.1f %%\n", 100 * between / NR, 100 * beyond / NR }' "$folder/distances"
printf 'all six numbers of the thesis: %d legs\n' "$(wc -l <"$folder/agreeing.csv")"
gnuplot -c studies/random-legs.gp "$out/random-legs-distance.csv" "$out/random-legs.csv" docs/pictures/random-legs.png
