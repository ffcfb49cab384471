#!/usr/bin/env bash
# examples.sh [--accept] [--program] [--cpp] [--python] [NAME]...   runs lessons of examples/, by default all, and
# compares their output with the expected one; --accept overwrites the expected output instead.
#
#   --program   run.sh, which calls the program           expected.txt
#   --cpp       main.cpp, built against an installation   expected-program.txt; expected.txt if there is no run.sh
#   --python    main.py, with an installation's package   the same, or expected-python.txt if it exists
#
# examples/readme has the lines that README.md shows; it is run like a lesson.
#
# Without any of the three options, all that a lesson has are run. SINEW_BUILD is the build folder, by default
# build/release. SINEW_PREFIX is an existing installation; without it the build is installed into a temporary
# folder. SINEW_CMAKE_FLAGS are passed to the lessons in C++. Named lessons are each built as a separate
# project, as yours would be; without names, all are built as one.
set -euo pipefail
cd "$(dirname "$0")/.."

accept='' ways=() names=()
for word in "$@"; do
  case $word in
    --accept) accept=yes ;;
    --program | --cpp | --python) ways+=("${word#--}") ;;
    -*) echo "examples.sh: found $word; expected --accept, --program, --cpp, --python or names" >&2; exit 2 ;;
    *) names+=("$word") ;;
  esac
done
requested=${ways[*]}
((${#ways[@]})) || ways=(program cpp python)
together=''
if ((${#names[@]} == 0)); then
  together=yes
  for folder in examples/[0-9]*/ examples/readme/; do names+=("$(basename "$folder")"); done
fi

build=$PWD/${SINEW_BUILD:-build/release} work=$(mktemp -d)
[[ ${SINEW_BUILD:-} != /* ]] || build=$SINEW_BUILD
trap 'rm -rf "$work"' EXIT
declare -A accepted=() source=([program]=run.sh [cpp]=main.cpp [python]=main.py)

has() { [[ -e examples/$2/${source[$1]} ]]; }  # has WAY NAME

expected_file() {  # expected_file WAY NAME
  local file=expected.txt
  [[ $1 == program ]] || ! has program "$2" || file=expected-program.txt
  [[ $1 != python || ! -e examples/$2/expected-python.txt ]] || file=expected-python.txt
  echo "examples/$2/$file"
}

prefix=${SINEW_PREFIX:-$work/prefix}
find_prefix() {
  [[ -e $prefix ]] || cmake --install "$build" --prefix "$prefix" >/dev/null
  prefix=$(cd "$prefix" && pwd)
}

# Uses -O1, since the computations are in the library.
compile() {  # compile SOURCE BUILD
  local flags
  read -ra flags <<<"${SINEW_CMAKE_FLAGS:-}"
  cmake -G Ninja -S "$1" -B "$2" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE=-O1 "${flags[@]}" >"$2.log" 2>&1 &&
    cmake --build "$2" >>"$2.log" 2>&1 || { cat "$2.log"; echo "$1: does not build" >&2; return 1; }
}

compile_lessons() {
  local name
  if [[ $together ]]; then
    compile examples "$work/lessons"
    return
  fi
  mkdir -p "$work/lessons"
  for name in "${names[@]}"; do
    ! has cpp "$name" || compile "examples/$name" "$work/lessons/$name" || return 1
  done
}

find_package() {
  package=$(find "$prefix/lib" -path '*/sinew/__init__.py' -print -quit 2>/dev/null || true)
  package=${package%/sinew/__init__.py}
  [[ $package ]] || echo "$prefix has no Python package: main.py is not run"
}

run() {  # run WAY NAME: runs a lesson
  case $1 in
    program) "examples/$2/run.sh" ;;
    cpp)
      cd "examples/$2" && "$(find "$work/lessons/$2" -maxdepth 1 -type f -executable)" "$prefix/share/sinew"
      ;;
    python)
      cd "examples/$2" && PYTHONPATH=$package PYTHONDONTWRITEBYTECODE=1 "${PYTHON:-/usr/bin/python3}" main.py
      ;;
  esac
}

run_in_parallel() {  # run_in_parallel WAY: writes the output of each lesson to $work/WAY-NAME
  local name
  for name in "${names[@]}"; do
    has "$1" "$name" || continue
    (run "$1" "$name" >"$work/$1-$name" 2>"$work/$1-$name.words" || touch "$work/$1-$name.failed") &
    while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n || true; done
  done
  wait
}

judge() {  # judge WAY NAME
  local found=$work/$1-$2 expected
  expected=$(expected_file "$1" "$2")
  [[ ! -e $found.failed ]] || { cat "$found" "$found.words"; echo "$2: examples/$2/${source[$1]} failed" >&2; return 1; }
  # The output accepted for C++ is also expected of Python.
  if [[ $accept && ! ${accepted[$expected]:-} ]]; then
    cp "$found" "$expected"
    accepted[$expected]=yes
    echo "$2: $1 accepted"
    return
  fi
  awk -f tools/numbers.awk -f tools/compare.awk "$expected" "$found" || {
    echo "$2: the output of ${source[$1]} differs from $expected; if it is right:" \
      "tools/examples.sh --accept --$1 $2" >&2
    return 1
  }
  echo "$2: $1 as expected"
}

for name in "${names[@]}"; do
  [[ -d examples/$name ]] || { echo "examples/$name: does not exist" >&2; exit 1; }
done
count=0
for way in "${ways[@]}"; do
  [[ $way == program ]] || find_prefix
  [[ $way != cpp ]] || compile_lessons
  if [[ $way == python ]]; then
    find_package
    [[ $package ]] || { [[ ! $requested ]] && continue || exit 1; }
  fi
  run_in_parallel "$way"
  for name in "${names[@]}"; do
    has "$way" "$name" || continue
    judge "$way" "$name"
    count=$((count + 1))
  done
done
((count)) || { echo "examples.sh: ${names[*]}: nothing to run as ${ways[*]}" >&2; exit 1; }
echo "examples: $count as expected"
