#!/usr/bin/env bash
# links.sh   checks that every relative link in a *.md file leads to a file or folder of the repository.
set -euo pipefail
cd "$(dirname "$0")/.."

find . \( -name build -o -name node_modules -o -name .git -o -name runs \) -prune -o -name '*.md' -print |
  sort | xargs -r awk '
    FNR == 1 { fenced = 0 }
    /^[ \t]*(```|~~~)/ { fenced = !fenced }
    fenced { next }
    {
      gsub(/`[^`]*`/, "code")
      while (match($0, /\]\([^() ]+[^()]*\)/)) {
        target = substr($0, RSTART + 2, RLENGTH - 3)
        $0 = substr($0, RSTART + RLENGTH)
        sub(/[ \t].*/, "", target)  # a title
        sub(/#.*/, "", target)      # a heading
        if (target == "" || target ~ /^[a-z]+:/) continue
        folder = FILENAME
        sub(/[^\/]*$/, "", folder)
        print FILENAME ":" FNR "\t" folder target
      }
    }' |
  {
    count=0 missing=0
    while IFS=$'\t' read -r where path; do
      count=$((count + 1))
      [[ -e $path ]] || { echo "${where#./}: link to a missing file: ${path#./}"; missing=$((missing + 1)); }
    done
    ((missing == 0)) || exit 1
    echo "links: $count are valid"
  }
