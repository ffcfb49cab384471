#!/usr/bin/env bash
# run.sh [SINEW]   makes the tables of docs/studies again; some minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
sinew=${1:-build/release/bin/sinew}
for plan in studies/*.toml; do
  "$sinew" sweep "$plan" -o "docs/studies/$(basename "$plan" .toml).csv" --force
done
