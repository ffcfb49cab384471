#!/usr/bin/env bash
# Fifteen generations of gaits: some ten seconds.
set -euo pipefail
cd "$(dirname "$0")/../.."
PYTHONPATH=${SINEW_BUILD:-build/release}/python PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 examples/10-train-a-walk/train.py
