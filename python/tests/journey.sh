#!/usr/bin/env bash
# journey.sh PREFIX   an installed package, in an environment with nothing else: 200 gains are swept
# and the best is found, then 10,000 steps of an environment are made.
set -euo pipefail
prefix=$(cd "$1" && pwd)
folder=$(cd "$(dirname "$0")" && pwd)
package=$(dirname "$(find "$prefix/lib" -path '*/sinew/__init__.py' -print -quit)")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
env -i PATH=/usr/bin:/bin HOME="$work" PYTHONPATH="$(dirname "$package")" PYTHONDONTWRITEBYTECODE=1 \
  "${PYTHON:-/usr/bin/python3}" "$folder/journey.py"
