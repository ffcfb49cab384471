#!/usr/bin/env bash
# npm-ci.sh FOLDER   installs what the folder's lock file says, from whatever registry npm is set up
# for; nothing where that is done already.
#
# Where there is no npm, it is fetched from its own registry: Debian's is 670 packages, which take
# longer to install than the compiler does. Debian's is installed where that fails, as behind a proxy,
# of which only npm knows.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=$1
if grep -q '"resolved"' "$folder/package-lock.json"; then
  echo "$folder/package-lock.json names a registry: npm install --omit-lockfile-registry-resolved" >&2
  exit 1
fi
[[ $folder/node_modules/.package-lock.json -nt $folder/package-lock.json ]] && exit

npm=(npm)
if ! command -v npm >/dev/null; then
  if node --no-warnings tools/fetch-npm.mjs build/npm; then
    npm=(node build/npm/package/bin/npm-cli.js)
  else
    echo "npm-ci.sh: trying Debian's npm"
    tools/install-dependencies.sh npm
  fi
fi
"${npm[@]}" ci --prefix "$folder" --ignore-scripts --no-audit --no-fund
