#!/usr/bin/env bash
# npm-ci.sh FOLDER   installs what the folder's lock file says, from whatever registry npm is set up
# for; nothing where that is done already.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$1
if grep -q '"resolved"' "$folder/package-lock.json"; then
  echo "$folder/package-lock.json names a registry: npm install --omit-lockfile-registry-resolved" >&2
  exit 1
fi
[[ $folder/node_modules/.package-lock.json -nt $folder/package-lock.json ]] && exit
npm ci --prefix "$folder" --ignore-scripts --no-audit --no-fund
