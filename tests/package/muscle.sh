#!/usr/bin/env bash
# muscle.sh FOLDER   builds sinew::muscle alone, on a machine that seems to have no library but the
# compiler's, installs it below FOLDER, and builds and runs two outside programs with it.
set -euo pipefail
cd "$(dirname "$0")/../.."
mkdir -p "$1"
folder=$(cd "$1" && pwd)
build=$folder/muscle-build prefix=$folder/muscle-prefix
rm -rf "$prefix" "$folder/one"

fail() { echo "muscle: $*" >&2; exit 1; }

# find_package of any of these would fail, required or not.
outside=(fmt nlohmann_json ZLIB Threads CLI11 Boost Ceres Eigen3 SQLite3 GTest SUNDIALS MPI Pagmo Python pybind11)
without="--no-warn-unused-cli $(printf -- '-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON ' "${outside[@]}")"
read -ra flags <<<"$without"

begin=$SECONDS
cmake -G Ninja -S . -B "$build" -DSINEW_ONLY=muscle "${flags[@]}" >"$folder/muscle.log" &&
  cmake --build "$build" >>"$folder/muscle.log" && cmake --install "$build" --prefix "$prefix" >>"$folder/muscle.log" ||
  { cat "$folder/muscle.log"; fail "does not build"; }
seconds=$((SECONDS - begin))

# No outside header was read, and no installed header includes one.
read_there=$(ninja -C "$build" -t deps | grep -oE '/(fmt|nlohmann|ceres|eigen3|boost|CLI|toml[+]*)/[^ ]*' | sort -u || true)
[[ ! $read_there ]] || fail "reads $read_there"
asked=$(grep -rhoE '#include ["<](fmt|nlohmann|ceres|Eigen|boost|CLI|toml[+]*)/[^">]*' "$prefix/include" || true)
[[ ! $asked ]] || fail "installed headers have: $asked"

# Lesson 04 prints the same as with the whole of Sinew.
SINEW_PREFIX=$prefix SINEW_CMAKE_FLAGS=$without tools/examples.sh 04-consumer

# sinew/muscle.h is the first and only header of this one.
cmake -G Ninja -S tests/package/muscle -B "$folder/one" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror -Wno-missing-field-initializers" "${flags[@]}" >"$folder/muscle.log" &&
  cmake --build "$folder/one" >>"$folder/muscle.log" || { cat "$folder/muscle.log"; fail "muscle.h does not serve"; }
"$folder/one/one_muscle"

# A request for another component fails with a list of the components.
mkdir -p "$folder/more"
printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(more LANGUAGES CXX)' \
  'find_package(sinew REQUIRED COMPONENTS experiment)' >"$folder/more/CMakeLists.txt"
if cmake -G Ninja -S "$folder/more" -B "$folder/more/build" -DCMAKE_PREFIX_PATH="$prefix" >"$folder/muscle.log" 2>&1; then
  fail "component experiment was found in it"
fi
tr -s ' \n' ' ' <"$folder/muscle.log" | grep -q 'component experiment: found in none of this installation' ||
  { cat "$folder/muscle.log"; fail "does not say that component experiment is missing"; }

size=$(du -cb "$prefix"/lib/*.a | awk 'END { printf "%.1f", $1 / 1e6 }')
echo "muscle: alone, $(find "$prefix" -name '*.a' | wc -l) archives of $size MB together, built in $seconds s"
