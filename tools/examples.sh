#!/usr/bin/env bash
# examples.sh [--accept] [--program] [--cpp] [--python] [NAME]...   runs the lessons in examples/, all of them
# without a name, and compares what they print with what they are expected to; --accept writes that anew instead.
#
#   --program   run.sh, which asks the program            expected.txt
#   --cpp       main.cpp, built against an installation   expected-program.txt, of a lesson without run.sh expected.txt
#   --python    main.py, with an installation's package   the same, or expected-python.txt where there is one
#
# examples/readme has the lines that README.md shows; it is run as a lesson is.
#
# Without one of the three: all that a lesson has. SINEW_BUILD names the build folder, build/release without it.
# SINEW_PREFIX names an installation that is there already; without it the build is installed into a folder that is
# thrown away. SINEW_CMAKE_FLAGS are for the lessons in C++. Those that are named are each built as a project of its
# own, as yours would be; all of them as one.
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
asked=${ways[*]}
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

# Optimised little: what computes is in the library.
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
  [[ $package ]] || echo "$prefix has no Python package: main.py is left out"
}

run() {  # run WAY NAME: prints what the lesson prints
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

run_side_by_side() {  # run_side_by_side WAY: what each prints goes to $work/WAY-NAME
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
  # What C++ has written, Python has to print too.
  if [[ $accept && ! ${accepted[$expected]:-} ]]; then
    cp "$found" "$expected"
    accepted[$expected]=yes
    echo "$2: $1 accepted"
    return
  fi
  awk -f tools/numbers.awk -f tools/compare.awk "$expected" "$found" || {
    echo "$2: ${source[$1]} prints something else than $expected; if that is right:" \
      "tools/examples.sh --accept --$1 $2" >&2
    return 1
  }
  echo "$2: $1 as expected"
}

for name in "${names[@]}"; do
  [[ -d examples/$name ]] || { echo "examples/$name: not there" >&2; exit 1; }
done
count=0
for way in "${ways[@]}"; do
  [[ $way == program ]] || find_prefix
  [[ $way != cpp ]] || compile_lessons
  if [[ $way == python ]]; then
    find_package
    [[ $package ]] || { [[ ! $asked ]] && continue || exit 1; }
  fi
  run_side_by_side "$way"
  for name in "${names[@]}"; do
    has "$way" "$name" || continue
    judge "$way" "$name"
    count=$((count + 1))
  done
done
((count)) || { echo "examples.sh: ${names[*]}: nothing there to run as ${ways[*]}" >&2; exit 1; }
echo "examples: $count as expected"
