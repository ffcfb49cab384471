#!/usr/bin/env bash
# run.sh [BUILD]   the Python package's tests: types, then everything in test_*.py.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=$PWD/${1:-build/release}
python=${PYTHON:-/usr/bin/python3}
export PYTHONPATH=$build/python:$PWD/python/tests SINEW=$build/bin/sinew PYTHONDONTWRITEBYTECODE=1
[[ -e $build/python/sinew/_where.py ]] || { echo "$build has no Python package: is pybind11-dev installed?" >&2; exit 1; }
mypy=("$python" -m mypy --strict --no-error-summary --cache-dir "$build/python/mypy")
MYPYPATH=$build/python "${mypy[@]}" -p sinew
MYPYPATH=$build/python:python/tests "${mypy[@]}" python/tests/*.py
for script in examples/*/*.py; do
  MYPYPATH=$build/python "${mypy[@]}" "$script"
done
# _sinew.pyi says what the module has. That pybind11's classes have a metaclass, and that those which
# nobody makes have no constructor, it need not say.
differs=$(MYPYPATH=$build/python "$python" -m mypy.stubtest sinew._sinew --concise 2>&1 |
  grep -v 'metaclass differs$\|__init__ is inconsistent, stub does not have \*args argument' || true)
[[ -z $differs ]] || { echo "$differs"; echo "python/sinew/_sinew.pyi: differs from the module" >&2; exit 1; }
"$python" -m unittest discover -s python/tests -t python/tests "${@:2}"
