#!/usr/bin/env bash
# site.sh [OUT]   builds the docs site in build/site, or OUT: docs, examples, README.md and changelog, the
# references of the C++ library and of the Python package, and the sources, with a common search.
#
#   python3 -m http.server --bind 127.0.0.1 --directory build/site 8000
#
# serves it at http://127.0.0.1:8000. Pages also open as files, but without the search. Neither this script nor
# the site uses the network. A broken link, a warning of Doxygen or MkDocs, and an undocumented public name
# (tools/site/undocumented.py) are errors.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8

case ${1:-} in
  -*) awk 'NR > 1 && /^#/ { print substr($0, 3); next } NR > 1 { exit }' "$0"; exit 2 ;;
esac
out=${1:-build/site}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# What was there goes when the new one is whole.
/usr/bin/python3 tools/site/build.py . "$work/site" "$work/work"
/usr/bin/python3 tools/site/check_links.py "$work/site"
/usr/bin/python3 tools/site/undocumented.py "$work/work"
mkdir -p "$(dirname "$out")"
rm -rf "$out"
cp -r "$work/site" "$out"
