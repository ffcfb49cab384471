#!/usr/bin/env bash
# format.sh [--fix]   checks that C++ files are formatted according to .clang-format; --fix formats them.
set -euo pipefail
cd "$(dirname "$0")/.."

case ${1:-} in
  '') how=(--dry-run -Werror) ;;
  --fix) how=(-i) ;;
  *) echo "usage: $0 [--fix]" >&2; exit 2 ;;
esac

# Versions of clang-format give different results, so this one is required.
version=14
tool=
for candidate in clang-format-$version clang-format; do
  [[ $("$candidate" --version 2>/dev/null) == *"version $version."* ]] && { tool=$candidate; break; }
done
[[ -n $tool ]] || { echo "format.sh: needs clang-format $version" >&2; exit 1; }

folders=()
for folder in sinew thesis cli python fmu firmware tests bench examples; do [[ -d $folder ]] && folders+=("$folder"); done
found=$(mktemp)
trap 'rm -f "$found"' EXIT
find "${folders[@]}" -name node_modules -prune -o -type f \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 -r -P "$(nproc)" -n 20 "$tool" "${how[@]}" 2>"$found" && exit

# One line per file is enough, since --fix formats the whole file.
grep -E '^[^ ]+: (error|warning): ' "$found" | awk -F: '!seen[$1]++ { print $1 ":" $2 ": not formatted" }' |
  sort || cat "$found"
echo "format.sh: tools/format.sh --fix formats them"
exit 1
