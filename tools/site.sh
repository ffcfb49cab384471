#!/usr/bin/env bash
# site.sh [OUT]   builds the docs site in build/site, or OUT: docs, examples, README and changelog,
# the reference of the C++ library and of the Python package, and the sources, with one search.
#
#   python3 -m http.server --bind 127.0.0.1 --directory build/site 8000
#
# then shows it at http://127.0.0.1:8000; pages alone also open as files, their search does not.
# The Python package is that of the build in build/release, or SINEW_BUILD. No network is used,
# neither by this nor by the site. A link that leads nowhere, a warning of Doxygen or MkDocs, and a
# public name without a comment are errors.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C.UTF-8

case ${1:-} in
  -*) awk 'NR > 1 && /^#/ { print substr($0, 3); next } NR > 1 { exit }' "$0"; exit 2 ;;
esac
out=${1:-build/site}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

package=${SINEW_BUILD:-build/release}/python
[[ -e $package/sinew/__init__.py ]] ||
  { echo "site.sh: found no Python package in $package; build it first: ninja -C ${package%/python} sinew_python"; exit 1; }

# Files of the repository; without git, those that were not built.
files() {
  { git ls-files --cached --others --exclude-standard 2>/dev/null || find . -type f -printf '%P\n'; } |
    grep -vE '(^|/)(\.[^/]+|node_modules|runs|__pycache__|build[^/]*)(/|$)' | sort
}
export SITE_DOCS=$work/docs
mkdir -p "$SITE_DOCS/assets/katex/fonts"
cp tools/site/assets/* "$SITE_DOCS/assets"
cp /usr/share/javascript/katex/katex.min.{js,css} "$SITE_DOCS/assets/katex"
cp -L /usr/share/javascript/katex/fonts/*.woff2 "$SITE_DOCS/assets/katex/fonts"
files | PYTHONPATH=$package /usr/bin/python3 tools/site/build.py . "$work"
find "$SITE_DOCS/reference/cpp" -name '*-members.html' -delete  # no page leads there
mkdocs build --quiet --strict --config-file tools/site/mkdocs.yml --site-dir "$work/site"

/usr/bin/python3 tools/site/check_links.py "$work/site"
awk -f tools/site/undocumented.awk "$work/searchdata.xml" "$work/doxygen.txt"

# The old site is removed once the new one is complete.
mkdir -p "$(dirname "$out")"
rm -rf "$out"
mv "$work/site" "$out"
