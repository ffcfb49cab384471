# long.sh - steps of ./check long. Each prints its result in its last line.
# shellcheck shell=bash disable=SC2154  # build, logs, jobs are set by ./check

step_tools_long() { tools/install-dependencies.sh long; }

# Runs without address space randomization. The thread sanitizer ends before the first test if the kernel
# randomizes more bits than it supports.
step_threads() {
  cmake --preset tsan && cmake --build --preset tsan || return 1
  local same_layout=(setarch "$(uname -m)" -R)
  "${same_layout[@]}" true 2>/dev/null || same_layout=()
  if ! "${same_layout[@]}" build/tsan/tests/sinew_threads_test --gtest_list_tests >"$logs/threads" 2>&1; then
    cat "$logs/threads"
    [[ ${same_layout[*]} ]] || echo "threads: the sanitizer does not start and setarch -R is not permitted" \
      "here; try: docker run --security-opt seccomp=unconfined, or as root sysctl vm.mmap_rnd_bits=28"
    return 1
  fi
  run_ctest tsan "${same_layout[@]}" -- -R "^threads:"
}

# Runs all tests of one program under the address and undefined-behaviour sanitizers; "transcripts" runs
# those of tests/cli/*.txt with the program built in this way.
step_asan() {  # step_asan PROGRAM
  cmake --preset asan || return 1
  if [[ $1 == transcripts ]]; then
    cmake --build build/asan --target sinew sinew_thesis_program sinew_fake_card && run_ctest asan -- -R '^transcript:'
  else
    cmake --build build/asan --target "sinew_$1_test" && run_ctest asan -- -R "^$1: " -L '^(tests|clock)$'
  fi
}

step_firmware() {
  cmake --preset firmware && cmake --build --preset firmware || return 1
  # The script skips its comparison without the tools; here they are installed.
  firmware/same-bits.sh build/firmware | tee "$logs/same-bits" && grep -q agree "$logs/same-bits" || return 1
  firmware/worst-tick.sh build/firmware | tee "$logs/worst-tick" && grep -q '^worst-tick: worst_tick' "$logs/worst-tick" || return 1
  # The emulator runs in real time: one test at a time.
  build_program && cmake --build "$build" --target sinew_firmware_test && jobs=1 run_ctest release -- -L '^long$' -R '^firmware: '
}

step_fuzz() {
  cmake --preset fuzz && cmake --build --preset fuzz || return 1
  local names=() name
  for name in tests/fuzz/*_fuzz.cpp; do
    name=${name##*/}
    names+=("${name%_fuzz.cpp}")
  done
  printf '%s\n' "${names[@]}" | xargs -P "$jobs" -I'{}' tools/fuzz.sh '{}' "$logs/fuzz" \
    "${SINEW_FUZZ_SECONDS:-60}" || return 1
  echo "fuzz: ${#names[@]} harnesses, $(cat "$logs"/fuzz/*/tries | awk '{ n += $1 } END { print n }') inputs, nothing found"
}

# Checks that every header compiles as the first include of a file.
step_headers() {
  # The FMI function headers must be included after the header that declares the models.
  find sinew thesis fmu -name '*.h' ! -name 'fmi*_functions.h' -print0 | xargs -0 -I'{}' -P "$jobs" \
    g++ -std=c++20 -fsyntax-only -Wall -Wextra -Werror -Wno-missing-field-initializers -I. \
      -include '{}' -x c++ /dev/null || return 1
  echo "headers: each of $(find sinew thesis fmu -name '*.h' ! -name 'fmi*_functions.h' | wc -l) compiles by itself"
}

step_clang() {
  cmake --preset clang && cmake --build --preset clang && run_ctest clang -- -L '^tests$'
}

# Repeats the tunings. Each file of experiments/tuned names its candidate. The comparison ignores comments,
# the path of the base, and the sources of values.
step_tunings() {
  build_program || return 1
  local file name number again=$logs/tunings count=0
  local words='/^#/d; /^base = /d; s/, source = "[^"]*"//'
  mkdir -p "$again"
  for file in experiments/tuned/*.toml; do
    name=$(basename "$file" .toml)
    number=$(sed -n '1s/^# Candidate \([0-9]*\) .*/\1/p' "$file")
    [[ $number ]] || { echo "$file: the first line does not name the candidate; expected \"# Candidate N ...\""; return 1; }
    rm -f "$again/$name".*
    "$build/bin/sinew" tune "studies/$name.toml" --results "$again/$name.db" --candidate "$number" \
      --best "$again/$name.toml" -o "$again/$name.csv" || return 1
    diff <(sed "$words" "$file") <(sed "$words" "$again/$name.toml") || return 1
    count=$((count + 1))
  done
  echo "tunings: $count repeated with equal results"
}

step_resets() {
  build_all && SINEW_RESETS=100000 python/tests/run.sh "$build" -k Memory || return 1
  grep -o 'memory: .*' "$logs/resets.log" | tail -n 1
}

# Compares runs on a graphics card with the processor's. It is only run by its name.
step_device() {
  build_program && cmake --build "$build" --target sinew_device_test || return 1
  SINEW_GUARD_COUNT=${SINEW_GUARD_COUNT:-$(column device 4)} "$build/tests/sinew_device_test" | tee "$logs/device-test" || return 1
  grep '^device: ' "$logs/device-test" || echo "device: NOT CHECKED: $(grep -m1 '^found ' "$logs/device-test")"
}

# Runs a guard of the table with many tries, or a program under sanitizers: asan-PROGRAM.
step_guard() {  # step_guard NAME
  [[ $1 != asan-* ]] || { step_asan "${1#asan-}"; return; }
  local log=$logs/guard-$1 tries suite
  tries=${SINEW_GUARD_COUNT:-$(column "$1" 4)}
  # The tests of a guard are those of its file.
  suite=$(sed -nE 's/^TEST(_F|_P)?\(([A-Za-z]+),.*/\2/p' "tests/guards/${1//-/_}_test.cpp" | sort -u | paste -s -d '|')
  build_all && cmake --build "$build" --target sinew_guards_test || return 1
  SINEW_GUARD_COUNT=$tries ctest --preset release --no-tests=error --verbose --parallel "$jobs" --timeout 7200 \
    -L guard -R "^guards: (.*/)?($suite)[./]" | tee "$log" || return 1
  summary "$log" "$(sed -nE 's/^[0-9]+: (guard: )?([0-9]+ [a-z].*)/\2/p' "$log" | paste -s -d ';' | sed 's/;/; /g')"
}
