#!/bin/sh
# worst-tick.sh BUILD_DIR: counts the instructions of the application's ticks in the emulator, while
# the leg's machine is run with all kinds of commands, and compares them with worst_tick.txt: a
# figure that has grown by more than 5 % fails. BUILD_DIR is the firmware's build folder, built.
# Prints a notice and exits with 0 if the emulator is not installed.
set -eu

if [ $# -ne 1 ]; then
  echo "usage: $0 BUILD_DIR" >&2
  exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
if ! command -v qemu-system-arm >/dev/null; then
  echo "worst-tick: skipped, qemu-system-arm is not installed"
  exit 0
fi

timeout 120 qemu-system-arm -M mps2-an386 -display none -monitor none -serial none \
  -icount shift=10,sleep=off -semihosting-config enable=on,target=native \
  -kernel "$1/firmware/application-counted.elf" >"$1/worst-tick" 2>&1 ||
  { cat "$1/worst-tick" >&2; exit 1; }
awk '
  /^#/ { next }
  NR == FNR { kept[$1] = $2; next }
  $1 in kept { ++seen; said = said ", " $1 " " $2; if ($2 > 1.05 * kept[$1]) { bad = 1; print "worst-tick: " $1 " was " kept[$1] ", is " $2 } }
  END {
    for (key in kept) ++wanted
    if (seen != wanted) { print "worst-tick: the image did not say all figures"; exit 1 }
    if (!bad) print "worst-tick: " substr(said, 3)
    exit bad
  }' "$here/worst_tick.txt" "$1/worst-tick"
