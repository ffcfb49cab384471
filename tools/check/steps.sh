# steps.sh - functions of ./check, which reads this file: each prints what it found in its last line.
# shellcheck shell=bash disable=SC2154  # build, logs, jobs are set by ./check

step_dependencies() { tools/install-dependencies.sh check; }

step_format() { tools/format.sh && echo "clang-format: in order"; }

step_layers() { tools/layers.sh && tools/layers.sh --self-test; }

step_shell() {
  local count=0 file first
  while IFS= read -r file; do
    read -r first <"$file" || true
    case $first in
      '#!'*bash*) bash -n "$file" || return 1 ;;
      '#!'*/sh*) sh -n "$file" || return 1 ;;
      *) continue ;;
    esac
    [[ -x $file ]] || { echo "$file: is a script but not executable"; return 1; }
    count=$((count + 1))
  done < <(find . \( -name build -o -name node_modules -o -name .git -o -name runs \) -prune -o \
             -type f \( -name '*.sh' -o -path ./demo -o -path ./check -o -path ./.ci/run \) -print)
  tools/compare-results.sh --self-test || return 1
  echo "shell: $count scripts"
}

step_docs() {
  local version
  version=$(sed -n 's/^project(sinew VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
  grep -qx "version: $version" CITATION.cff || { echo "CITATION.cff: expected version: $version"; return 1; }
  tools/links.sh && tools/snippets.sh
}

# Configures and builds PRESET, one step at a time: ./check faces runs some beside others.
build_preset() {  # build_preset PRESET
  flock 9 && tools/npm-ci.sh web && cmake --preset release && cmake --build --preset "$1"
} 9>"$logs/building"

build_program() { build_preset release; }

step_build() {
  build_program && cmake --build --preset tests && "$build/bin/sinew" --version
}

step_tests() {
  build_program && cmake --build --preset tests && run_ctest release -- -L '^tests$' && slow_tests_have_reasons
}

# A test of more than a second has a reason in tests/slow.txt. Three, so that a busy computer does not decide.
slow_tests_have_reasons() {
  awk '
    NR == FNR { if (!/^#/ && sub(/   .*/, "")) known[$0]; next }
    / Test: / { name = $0; sub(/^.* Test: /, "", name) }
    /^Test time = / && $4 > 3 {
      for (k in known) if (index(name, k) == 1) next
      print name ": took " $4 " s; make it quicker, or say in tests/slow.txt why it cannot be"
      wrong = 1
    }
    END { exit wrong }' tests/slow.txt "$build/Testing/Temporary/LastTest.log"
}

step_experiments() {
  build_program || return 1
  "$build/bin/sinew" check robots/*/*.toml experiments/*.toml experiments/{rig,faults,tuned}/*.toml || return 1

  local file count=0 runs=$PWD/$logs/runs
  rm -rf "$runs"
  for file in experiments/*.toml experiments/rig/*.toml; do
    "$build/bin/sinew" run "$file" -o "$runs/${file%.toml}" --quiet || return 1
    count=$((count + 1))
  done
  # What each is reported to do, with class and verdict, is as the list has it.
  SINEW=$build/bin/sinew RUNS=$runs tools/statements.sh experiments || return 1
  rm -rf "$runs"  # large, and done with
  echo "experiments: $count run, their statements are as listed"
}

step_examples() {
  build_program || return 1
  SINEW_BUILD=$build tools/examples.sh --program  # in C++: step install; in Python: step python
}

step_mcap() {
  build_program && tools/npm-ci.sh tests/mcap || return 1
  local run=$logs/mcap sinew=$build/bin/sinew reader=tests/mcap/check.mjs size share
  rm -rf "$run" "$run-killed"
  "$sinew" run experiments/one-joint.toml -o "$run" >/dev/null || return 1
  node "$reader" whole "$run/log.mcap" || return 1

  # A finished log of which the end is lost: chunks are read up to the torn one.
  size=$(stat -c %s "$run/log.mcap")
  for share in 50 99; do
    head -c $((size * share / 100)) "$run/log.mcap" >"$run/cut.mcap"
    node "$reader" cut "$run/cut.mcap" || return 1
  done

  # A run that is killed: no chunks yet, every message is its own.
  "$sinew" run experiments/one-joint.toml -o "$run-killed" --pace 4 --quiet >/dev/null &
  sleep 1.5
  kill -9 $! && { wait $! || true; }
  node "$reader" cut "$run-killed/log.mcap" || return 1
  echo "mcap: whole, cut and killed runs can be read"
}

step_figures() {
  build_program && cmake --build --preset release --target sinew_thesis_program || return 1
  local out=$logs/figures count file
  rm -rf "$out"
  "$build/bin/sinew" figures --thesis -o "$out" --format svg,png || return 1
  for file in "$out"/*.gp; do
    [[ -s ${file%.gp}.svg && -s ${file%.gp}.png ]] || { echo "$file: not drawn"; return 1; }
  done
  # What is stated of them, with class and verdict, is as the list has it.
  FIGURES=$out tools/statements.sh figures || return 1
  count=$(grep -c '"figure":' "$out/index.json")
  echo "figures: $count drawn, their statements are as listed"
}

# --- what they share ------------------------------------------------------------------------------
run_ctest() {  # run_ctest PRESET [COMMAND...] -- OPTIONS...: ctest, by way of the command
  local preset=$1 log=$logs/ctest-$1 through=()
  shift
  while [[ $1 != -- ]]; do
    through+=("$1")
    shift
  done
  shift
  if ! "${through[@]}" ctest --preset "$preset" --parallel "$jobs" --no-tests=error "$@" | tee "$log"; then
    show_failed_tests "$log"
    return 1
  fi
  summary "$log" ''
}

# Prints the tests that failed with their output again, and their names once more at the end, since
# ./check shows the end of what a step prints.
show_failed_tests() {  # show_failed_tests LOG
  awk '/^ +Start +[0-9]+: / { fails = 0 }
    /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / { fails = /\*\*\*/ && !/\*\*\*Skipped/; if (fails) names = names $0 "\n" }
    fails
    END { printf "\nFailed:\n%s", names }' "$1"
}

summary() {  # summary LOG WORDS: the step's last line
  local passed
  passed=$(grep 'tests passed' "$1") || return 1
  echo "${2:-$passed}"
}
