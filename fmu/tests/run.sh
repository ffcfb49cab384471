#!/usr/bin/env bash
# run.sh [BUILD]   the FMUs' tests: everything in test_*.py, with the importer beside it.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$PWD/${1:-build/release}
python=${PYTHON:-/usr/bin/python3}
export PYTHONPATH=$build/python:$PWD/fmu/tests SINEW=$build/bin/sinew PYTHONDONTWRITEBYTECODE=1
[[ -e $build/python/sinew/_where.py ]] || { echo "$build has no Python package: is pybind11-dev installed?" >&2; exit 1; }
MYPYPATH=$build/python:fmu/tests "$python" -m mypy --strict --no-error-summary \
  --cache-dir "$build/python/mypy" fmu/tests/*.py
"$python" -m unittest discover -s fmu/tests -t fmu/tests "${@:2}"
