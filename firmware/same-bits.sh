#!/bin/sh
# same-bits.sh BUILD_DIR: the self-test of joint controller and wire on the host and on an emulated Cortex-M4F
# and Cortex-M7 (one image for both) must print the same hash. BUILD_DIR is the firmware's build folder, or an empty one to build in.
# Prints a notice and exits with 0 if the cross compiler or the emulator is not installed.
set -eu

if [ $# -ne 1 ]; then
  echo "usage: $0 BUILD_DIR" >&2
  exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$here")

for tool in arm-none-eabi-g++ qemu-system-arm; do
  if ! command -v "$tool" >/dev/null; then
    echo "same-bits: skipped, $tool is not installed (Debian: gcc-arm-none-eabi," \
         "libstdc++-arm-none-eabi-newlib, qemu-system-arm)"
    exit 0
  fi
done

mkdir -p "$1"
build=$(cd "$1" && pwd)
cmake -S "$root" -B "$build" --toolchain "$here/cortex-m4f.cmake" -DCMAKE_BUILD_TYPE=Release \
  >"$build/same-bits.log"
cmake --build "$build" >>"$build/same-bits.log" || { cat "$build/same-bits.log" >&2; exit 1; }
on() {  # on MACHINE: prints the image's output
  timeout 120 qemu-system-arm -M "$1" -nographic -monitor none -serial none \
    -semihosting-config enable=on,target=native -kernel "$build/firmware/same-bits.elf" 2>&1
}
board=$(on mps2-an386)
larger=$(on mps2-an500)
if [ "$board" != "$larger" ]; then
  echo "same-bits: Cortex-M4F $board, Cortex-M7 $larger" >&2
  exit 1
fi

# The host is tested at two levels of optimisation, since results must not depend on the compiler.
for level in -O0 -O3; do
  ${CXX:-g++} -std=c++20 $level -ffp-contract=off -fno-math-errno -I"$root" -o "$build/same-bits-host" \
    "$here/same_bits.cpp" "$here/same_bits_link.cpp" "$root"/sinew/control/joint/config.cpp \
    "$root"/sinew/control/joint/joint_controller.cpp \
    "$root"/sinew/control/supervise/supervisor.cpp "$root"/sinew/control/supervise/safety.cpp \
    "$root"/sinew/control/supervise/output_stage.cpp "$root"/sinew/control/link/baud.cpp \
    "$root"/sinew/control/link/configuration.cpp "$root"/sinew/control/link/frame.cpp \
    "$root"/sinew/control/link/telemetry.cpp "$root"/sinew/control/link/thesis_bytes.cpp
  host=$("$build/same-bits-host")
  if [ -z "$host" ] || [ "$host" != "$board" ]; then
    echo "same-bits: host ($level) $host, Cortex-M4F $board" >&2
    exit 1
  fi
done
echo "same-bits: host, Cortex-M4F and Cortex-M7 agree: $host"
