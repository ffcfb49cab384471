#!/usr/bin/env bash
# card-ptx.sh FILE        checks that a program for graphics cards (PTX) has a processor's operations: no fused
#                         ones, no approximations, no functions of a library. Its results then have the same bits.
# card-ptx.sh --self-test
#
# Prints "file:line: message" for each finding; exit 1 if there is any.
set -euo pipefail
export LC_ALL=C.UTF-8

# shellcheck disable=SC2016  # $ belongs to awk
program='
function report(what) { print FILENAME ":" FNR ": " what ": " $0; findings = 1 }
{ sub(/\/\/.*/, "") }
/\.extern/                               { report("a function or a variable of another program") }
/\.callprototype/                        { report("a call through a pointer") }
/(^|[^A-Za-z_])(fma|mad)\.[a-z0-9.]*f(16|32|64)/ { report("a fused operation") }
/\.approx|\.full\.f32/                   { report("an approximation") }
/\.ftz/                                  { report("small numbers are replaced by zero") }
# Without a rounding, the compiler of the driver may fuse an operation with the next one.
/(^|[^A-Za-z_])(add|sub|mul)\.f(32|64)/  { report("an operation without a rounding") }
match($0, /\.param [^;]*\[[0-9]+\]/)      { n = substr($0, RSTART, RLENGTH); sub(/.*\[/, "", n); if (n + 0 > 4352) report("a parameter that is too large for a card") }
/\.visible \.entry walk\(/               { ++entries }
END {
  if (entries != 1) { print FILENAME ": expected the kernel walk"; findings = 1 }
  exit findings ? 1 : 0
}'

self_test() {
  folder=$(mktemp -d)  # not local, since the trap runs after this function
  trap 'rm -rf "$folder"' EXIT
  local failed=0 count=0
  expect() {  # expect FINDING LINE   ("" for none)
    local found
    printf '.version 7.0\n.visible .entry walk(\n)\n%s\n' "$2" >"$folder/a.ptx"
    found=$(awk "$program" "$folder/a.ptx") || true
    count=$((count + 1))
    [[ ${1:+x} == "${found:+x}" && $found == *"$1"* ]] ||
      { echo "card-ptx.sh --self-test: expected \"$1\" in \"$2\", found \"$found\""; failed=1; }
  }
  expect '' 'add.rn.f64 %fd1, %fd2, %fd3;'
  expect '' 'mad.lo.s32 %r1, %r2, %r3, %r4;'
  expect '' 'div.rn.f32 %f1, %f2, %f3;  // not fma.rn.f32'
  expect '' 'call.uni (retval0), helper, (param0);'
  expect 'fused' 'fma.rn.f64 %fd1, %fd2, %fd3, %fd4;'
  expect 'fused' '@%p1 mad.rn.f32 %f1, %f2, %f3, %f4;'
  expect 'without a rounding' 'mul.f64 %fd1, %fd2, %fd3;'
  expect 'another program' '.extern .func (.param .b64 func_retval0) sin'
  expect 'a pointer' 'prototype_0 : .callprototype ()_ (.param .b64 _);'
  expect 'approximation' 'rcp.approx.ftz.f64 %fd1, %fd2;'
  expect 'approximation' 'div.full.f32 %f1, %f2, %f3;'
  expect 'zero' 'add.rn.ftz.f32 %f1, %f2, %f3;'
  expect 'too large' '.param .align 8 .b8 retval0[4360];'
  expect '' '.param .align 8 .b8 retval0[3840];'
  ((failed == 0)) || exit 1
  echo "card-ptx: $count cases of the self-test"
}

case ${1:-} in
  --self-test) self_test ;;
  '' | -*) echo "usage: $0 FILE | --self-test" >&2; exit 2 ;;
  *) awk "$program" "$1" && echo "card-ptx: $(wc -l <"$1") lines have the operations of a processor" ;;
esac
