#!/usr/bin/env bash
# run.sh [SINEW]   makes the tables of docs/evidence/studies again, in some minutes, but for that of random-legs.sh. The commands of
# tunings are in docs/tuned.md.
set -euo pipefail
cd "$(dirname "$0")/.."
sinew=${1:-build/release/bin/sinew}
for plan in studies/*.toml; do
  ! grep -q '"sinew.tuning/1"' "$plan" || continue
  [[ $plan != studies/random-legs.toml ]] || continue
  "$sinew" sweep "$plan" -o "docs/evidence/studies/$(basename "$plan" .toml).csv" --force
done
