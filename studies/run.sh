#!/usr/bin/env bash
# run.sh [SINEW]   makes the tables of docs/evidence/studies again; some minutes. Tunings have commands of their own, in docs/tuned.md.
set -euo pipefail
cd "$(dirname "$0")/.."
sinew=${1:-build/release/bin/sinew}
for plan in studies/*.toml; do
  ! grep -q '"sinew.tuning/1"' "$plan" || continue
  "$sinew" sweep "$plan" -o "docs/evidence/studies/$(basename "$plan" .toml).csv" --force
done
