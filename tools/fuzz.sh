#!/usr/bin/env bash
# fuzz.sh NAME OUT SECONDS   runs one harness of tests/fuzz, built by preset `fuzz`, for this time.
#
# Starts from tests/fuzz/corpus/NAME and from the inputs that earlier calls stored in OUT/NAME/kept. An input
# that violates a law, crashes, hangs for 10 s or takes 2 GB is stored in OUT/NAME, and the command that repeats
# it is printed; exit 1. The number of inputs is written into OUT/NAME/tries.
set -euo pipefail
cd "$(dirname "$0")/.."

name=$1 out=$2/$1 seconds=$3
program=build/fuzz/tests/fuzz/${name}_fuzz
rm -f "$out"/{crash,leak,timeout,oom}-*
mkdir -p "$out/kept"
echo 0 >"$out/tries"

code=0
ASAN_OPTIONS=${ASAN_OPTIONS:-allocator_may_return_null=1} "$program" "$out/kept" "tests/fuzz/corpus/$name" \
  -max_total_time="$seconds" -max_len=65536 -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
  -artifact_prefix="$out/" >"$out/log" 2>&1 || code=$?
sed -n 's/^stat::number_of_executed_units: *//p' "$out/log" >"$out/tries"
if ((code == 0)); then
  echo "$name: $(cat "$out/tries") inputs"
  exit
fi
tail -n 60 "$out/log"
for found in "$out"/{crash,leak,timeout,oom}-*; do
  [[ -e $found ]] || continue
  echo "fuzz: $name: $program $found repeats it; after the fix, add it to tests/fuzz/corpus/$name"
done
exit 1
