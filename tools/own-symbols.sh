#!/usr/bin/env bash
# own-symbols.sh ARCHIVE WIDTH   checks that every external symbol of lanes_WIDTH.cpp has the width in its name
# (cmake/lanes.cmake has the reason), and that none of its code runs at start-up.
#
# Prints what is wrong; exit 1 if a check fails.

set -euo pipefail
export LC_ALL=C.UTF-8

if (($# != 2)); then
  echo "usage: $0 ARCHIVE WIDTH" >&2
  exit 2
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
object=lanes_$2.cpp.o
(cd "$folder" && ar x "$1" "$object")

shared=$(nm --defined-only --extern-only --format=posix "$folder/$object" | cut -d ' ' -f 1)
strangers=$(grep -Fv "Li$2E" <<<"$shared" | grep -vxE 'DW\.ref\.__gxx_personality_v0|__clang_call_terminate' || true)
if [[ -z $shared ]]; then
  echo "$object: defines nothing"
  exit 1
fi
if [[ -n $strangers ]]; then
  echo "$object: $(wc -l <<<"$strangers") symbols without the width, such as $(head -1 <<<"$strangers" | c++filt)"
  exit 1
fi
if objdump --section-headers "$folder/$object" | grep -qE ' \.(init_array|ctors)'; then
  echo "$object: has code that runs before main, on any processor"
  exit 1
fi
