#!/usr/bin/env bash
# npm-ci.sh FOLDER   installs the packages of the folder's lock file from the configured registry, unless they
# are already installed.
#
# A missing npm is downloaded from its registry: Debian's npm consists of 670 packages, which take longer to
# install than the compiler. Debian's is installed if the download fails, for example behind a proxy that is
# configured only for npm.
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
