#!/usr/bin/env bash
# one-after-the-other.sh [FOLDER]   compares tuning all joints at once with tuning joint after joint: the four gains of
# studies/gains-again.toml at once, or the hip's two, then the knee's two with the hip's best, then the hip's again, each
# from the current best. It takes some minutes. FOLDER/history.csv has the best so far over candidates:
# docs/evidence/studies/one-after-the-other.csv, plotted by gains.gp as docs/pictures/gains.png.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8
sinew=${SINEW:-build/release/bin/sinew} folder=${1:-build/one-after-the-other}
[[ -f $sinew && -x $sinew ]] || { echo "one-after-the-other.sh: found no program $sinew; build it with ./demo, or name it by SINEW" >&2; exit 1; }
mkdir -p "$folder"
experiment=$PWD/experiments/leg-in-air.toml

# plan JOINTS GENERATIONS SEED   prints the plan with only the ranges of these joints (a pattern).
plan() {
  sed -E -e "s|^experiment .*|experiment = \"$experiment\"|" -e "s/^generations .*/generations = $2\ntuner_seed = $3/" \
      -e "/^  \"joint\.($1)\./!{/^  \"joint\./d}" studies/gains-again.toml
}
goal() { sed -n '/"best"/,$ s/.*"foot.tracking_rms \[in\]": \([0-9.]*\).*/\1/p' "$1" | head -1; }
# Prints the values of the best candidate as options.
sets() { sed -n '/"best"/,$ s/^ *"\(joint\.[a-z_.]*\)": "\(.*\)",*$/--set\n\1=\2/p' "$1"; }

# history WAY SEED BEFORE CSV   appends the least error so far [in]; BEFORE is the number of earlier candidates.
history() {
  awk -F, -v way="$1" -v seed="$2" -v before="$3" -v best="${least:-1e9}" '
    NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /^foot.tracking_rms/) v = i; next }
    $3 == "true" && $v + 0 < best { best = $v + 0; print way "," seed "," before + $1 + 1 "," best }
    END { print way "," seed "," before + NR - 1 "," best }' "$4" >>"$folder/history.csv"
  least=$(tail -1 "$folder/history.csv" | cut -d, -f4)
}

echo "way,seed,candidates,least error [in]" >"$folder/history.csv"
printf '%-6s %-20s %12s %12s\n' seed way candidates 'error [in]'
for seed in 1 2 3; do
  plan 'hip|knee' 60 $seed >"$folder/both.toml"
  "$sinew" tune "$folder/both.toml" --results "$folder/both-$seed.db" -o "$folder/both.csv" --force --quiet --json >"$folder/both.json" || true
  least='' && history together $seed 0 "$folder/both.csv"
  printf '%-6s %-20s %12s %12.5s\n' $seed 'all four at once' 960 "$(goal "$folder/both.json")"

  hip=() knee=() candidates=0 least=''
  for turn in 1 2 3; do
    for joint in hip knee; do
      plan $joint 10 $seed >"$folder/$joint.toml"
      "$sinew" tune "$folder/$joint.toml" "${hip[@]}" "${knee[@]}" --results "$folder/$joint-$turn-$seed.db" \
        -o "$folder/$joint.csv" --force --quiet --json >"$folder/$joint.json" || true
      history turns $seed $candidates "$folder/$joint.csv"
      candidates=$((candidates + 160))
      mapfile -t "$joint" < <(sets "$folder/$joint.json")
      printf '%-6s %-20s %12s %12.5s\n' $seed "turn $turn, $joint" $candidates "$(goal "$folder/$joint.json")"
    done
  done
done
