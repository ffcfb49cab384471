#!/usr/bin/env bash
# A walk, a sweep and the laws of a muscle from Python.
set -euo pipefail
cd "$(dirname "$0")/../.."
PYTHONPATH=${SINEW_BUILD:-build/release}/python PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 examples/09-python/look.py
