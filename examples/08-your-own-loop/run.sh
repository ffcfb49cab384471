#!/usr/bin/env bash
# Installs Sinew into a folder of its own, builds the program beside this script against it, runs it.
# SINEW_PREFIX names an installation that is there already.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
prefix=${SINEW_PREFIX:-$work/prefix}
if [[ ! ${SINEW_PREFIX:-} ]]; then
  cmake --install "$root/${SINEW_BUILD:-build/release}" --prefix "$prefix" >/dev/null
fi

read -ra flags <<<"${SINEW_CMAKE_FLAGS:-}"
cmake -G Ninja -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
  "${flags[@]}" >/dev/null
cmake --build "$work/build" >/dev/null
"$work/build/own_loop" "$here/muscle.toml"
