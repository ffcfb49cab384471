# steps.sh - steps of ./check. Each prints its result in its last line.
# shellcheck shell=bash disable=SC2154  # build, logs, jobs are set by ./check

step_dependencies() { tools/install-dependencies.sh check; }

step_format() { tools/format.sh && echo "clang-format: all files are formatted"; }

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
  tools/compare-results.sh --self-test && tools/card-ptx.sh --self-test || return 1
  echo "shell: $count scripts"
}

step_docs() {
  local version
  version=$(sed -n 's/^project(sinew VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
  grep -qx "version: $version" CITATION.cff || { echo "CITATION.cff: expected version: $version"; return 1; }
  tools/links.sh && tools/snippets.sh && tools/words.py
}

# Configures and builds PRESET; a lock serializes builds, since ./check faces runs some steps in parallel.
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

# Checks that slow tests have a reason in tests/slow.txt. The limit of a test is one second; three are allowed
# here, since the computer may be busy.
slow_tests_have_reasons() {
  awk '
    NR == FNR { if (!/^#/ && sub(/   .*/, "")) known[$0]; next }
    / Test: / { name = $0; sub(/^.* Test: /, "", name) }
    /^Test time = / && $4 > 3 {
      for (k in known) if (index(name, k) == 1) next
      print name ": took " $4 " s; make it faster, or state in tests/slow.txt why it cannot be"
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
  # Compares the reported results, with class and verdict, with the list.
  SINEW=$build/bin/sinew RUNS=$runs tools/statements.sh experiments || return 1
  rm -rf "$runs"  # large and no longer needed
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

  # In a truncated log, chunks are read up to the incomplete one.
  size=$(stat -c %s "$run/log.mcap")
  for share in 50 99; do
    head -c $((size * share / 100)) "$run/log.mcap" >"$run/cut.mcap"
    node "$reader" cut "$run/cut.mcap" || return 1
  done

  # The log of a killed run has no chunks yet, only single messages.
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
  # Compares their claims, with class and verdict, with the list.
  FIGURES=$out tools/statements.sh figures || return 1
  count=$(grep -c '"figure":' "$out/index.json")
  echo "figures: $count drawn, their statements are as listed"
}

# --- common functions -----------------------------------------------------------------------------
run_ctest() {  # run_ctest PRESET [COMMAND...] -- OPTIONS...: runs ctest, as an argument of COMMAND if given
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

# Prints the failed tests with their output again, and their names at the end, since ./check shows the end
# of the output of a step.
show_failed_tests() {  # show_failed_tests LOG
  awk '/^ +Start +[0-9]+: / { fails = 0 }
    /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / { fails = /\*\*\*/ && !/\*\*\*Skipped/; if (fails) names = names $0 "\n" }
    fails
    END { printf "\nFailed:\n%s", names }' "$1"
}

summary() {  # summary LOG WORDS: prints the step's last line
  local passed
  passed=$(grep 'tests passed' "$1") || return 1
  echo "${2:-$passed}"
}
