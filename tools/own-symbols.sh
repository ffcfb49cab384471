#!/usr/bin/env bash
# own-symbols.sh OBJECT ENTRY   does an object that is compiled for some processors alone keep all
# that it defines to itself, but ENTRY (cmake/lanes.cmake says why), and run nothing at start-up?
#
# Prints what is wrong; exit 1 if anything is.

set -euo pipefail
export LC_ALL=C.UTF-8

if (($# != 2)); then
  echo "usage: $0 OBJECT ENTRY" >&2
  exit 2
fi
object=$1 entry=$2 wrong=0

seen=$(nm --defined-only --extern-only --format=posix "$object" | cut -d ' ' -f 1)
shared=$(grep -Fvx "$entry" <<<"$seen" || true)
if [[ -n $shared ]]; then
  echo "$object: other objects see $(wc -l <<<"$shared") of its symbols, such as $(head -1 <<<"$shared" | c++filt)"
  wrong=1
fi
if ! grep -Fqx "$entry" <<<"$seen"; then
  echo "$object: does not define $entry"
  wrong=1
fi
sections=$(objdump --section-headers "$object")
if grep -qE ' \.(init_array|ctors)' <<<"$sections"; then
  echo "$object: has code that runs before main, on any processor"
  wrong=1
fi
exit $wrong
