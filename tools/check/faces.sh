# faces.sh - steps of ./check faces. Each prints its result in its last line.
# shellcheck shell=bash disable=SC2154  # build, logs, jobs are set by ./check

step_tools() { tools/install-dependencies.sh faces; }

# Builds everything that is installed: the program, its modules, the Python package, FMU modules, manual.
build_all() { build_preset all; }

step_modules() { build_all && echo "modules: $(find "$build/lib/sinew" -name '*.so' | wc -l), the Python package, manual and completion"; }

step_clocks() {
  build_all && cmake --build "$build" --target sinew_run_test sinew_program_test sinew_live_test &&
    run_ctest release -- -L '^clock$'
}

# Checks how often intervals contain the true value.
step_coverage() {
  build_program && cmake --build "$build" --target sinew_identify_test && run_ctest release -- -L '^coverage$'
}

# Runs each guard with its default number of tries; ./check long NAME runs many.
step_guards() {
  build_all && cmake --build "$build" --target sinew_guards_test &&
    run_ctest release -- -L '^guard$' -E 'BoardsEmulated'
}

step_web() {
  build_all || return 1
  local runs=$logs/web sinew=$build/bin/sinew name
  rm -rf "$runs"
  for name in walk-test-1 walk-test-2 one-joint cylinder-following faults/valve-stuck-open; do
    "$sinew" run "experiments/$name.toml" -o "$runs/$name" --quiet >/dev/null || return 1
  done
  for name in feedback weights-60 sealed-cylinder isometric duty-sweep; do
    "$sinew" run "experiments/rig/$name.toml" -o "$runs/$name" --quiet >/dev/null || return 1
  done
  "$sinew" run experiments/tune-in-air.toml -o "$runs/changed" --quiet --set sequence.repeat=3 --set "change=[
    { time = \"3 s\", key = \"control.gains.hip.angle\", value = \"0.4 %/count\" },
    { time = \"3.2 s\", key = \"control.gains.hip.angle\", value = \"0.6 %/count\" },
    { time = \"5 s\", key = \"control.stiffness.knee\", value = \"2 N m/rad\" },
    { time = \"7 s\", key = \"control.gains.hip.angle\", release = true }]" >/dev/null || return 1
  mkdir "$runs/design" "$runs/static"
  "$sinew" design joint --actuator robots/leg/actuator.toml --torque "20 lbf in" --angles "40 deg" --pressure "100 psi gauge" \
    --moment-arm "1 in" --report "$runs/design/report.html" --quiet >/dev/null || return 1
  "$sinew" identify static data/martens_boblan_2017/DMSP-10-250_force_map.csv --unit L_m=m --unit F_N=N \
    --map length=L_m,pressure=P_gauge_Pa,force=F_N --unit "P_gauge_Pa=Pa gauge" --rest-length "250 mm" \
    --hold-out pressure --report "$runs/static/report.html" --quiet >/dev/null || return 1
  mkdir "$runs/static-left" && for name in 200 215 232 250 rows; do
    node web/test/recording.mjs $name >"$runs/static-left/mount-$name.csv" || return 1
  done
  "$sinew" identify static "$runs"/static-left/mount-*.csv --value "mount-200:length=200 mm" --value "mount-215:length=215 mm" \
    --value "mount-232:length=232 mm" --value "mount-250:length=250 mm" --rest-length "250 mm" --json \
    --report "$runs/static-left/report.html" --quiet >"$runs/static-left/report.json" || return 1
  "$sinew" run experiments/walk-test-1.toml -o "$runs/long" --quiet --set sequence.repeat=200 \
    --set "trolley.track_length=1000 ft" >/dev/null || return 1
  "$sinew" run experiments/walk-test-1.toml -o "$runs/long-other" --quiet --no-report --set sequence.repeat=200 \
    --set "trolley.track_length=1000 ft" --set "control.gains.hip.velocity=0.0001 s/count" \
    >/dev/null || return 1
  mkdir "$runs/compare" && for name in two/walk-test-2 same/walk-test-1; do
    "$sinew" compare "$runs/walk-test-1" "$runs/${name#*/}" -o "$runs/compare/${name%/*}.html" --quiet >/dev/null || return 1
  done
  "$sinew" compare "$runs"/{walk-test-{1,2},faults/valve-stuck-open,walk-test-{2,1,2}} -o "$runs/compare/six.html" --quiet >/dev/null || return 1
  "$sinew" run experiments/rig/weights-90.toml -o "$runs/weights-90" --quiet --no-report >/dev/null || return 1
  "$sinew" compare "$runs"/weights-{6,9}0 -o "$runs/compare/stand.html" --quiet >/dev/null || return 1
  "$sinew" run experiments/one-joint.toml -o "$runs/lever" --quiet --no-report >/dev/null &&
    "$sinew" run experiments/one-joint.toml -o "$runs/lever-measured" --quiet --no-report --set 'log.channels=["/joint/*/angle"]' \
      --set "joint.lever.damping=0.7 lbf in s/rad" >/dev/null &&
    "$sinew" compare "$runs"/lever{,-measured} --align correlation --clock fit -o "$runs/compare/measured.html" --quiet >/dev/null || return 1
  "$sinew" compare "$runs/long" "$runs/long-other" -o "$runs/compare/long.html" --quiet >/dev/null || return 1
  rm "$runs"/long*/log.mcap  # large and no longer needed
  mkdir "$runs/study" && for name in walk/64 other/16; do
    "$sinew" sweep experiments/walk-test-1.toml --points "${name#*/}" --range "joint.hip.angle_gain=0.02:0.08 %/count log" \
      --range "link.femur.length=8.6:9.1 in" --vary "low_level.duty_rounding=none,truncate sum" --results "$runs/study/${name%/*}.db" \
      --report "trolley.mean_speed_m_per_s [in/s], joints.hip.tracking_rms_rad [deg], air_used_kg [g]" \
      -o "$runs/study/${name%/*}.csv" --quiet || return 1
  done
  "$sinew" tune web/test/tuning.toml --results "$runs/study/tuned.db" --quiet >/dev/null || return 1
  for name in walk tuned; do "$sinew" report "$runs/study/$name.db" --quiet || return 1; done
  "$sinew" report "$runs"/study/{walk,other}.db -o "$runs/study/pair.html" --quiet || return 1
  "$sinew" figures --thesis -o "$runs/thesis-figures" --quiet --format svg,png >/dev/null || return 1
  node web/test/unit.mjs && node web/test/study_unit.mjs && node web/test/plots_unit.mjs && SINEW=$sinew node web/test/browser.mjs "$runs" | tee "$logs/browser" || return 1
  echo "web: $(grep -c '^ok ' "$logs/browser") tests in a browser$(sed -n 's/^# 10 min:/; 10 min:/p' "$logs/browser")"
}

step_install() {
  build_all || return 1
  local prefix=$PWD/$logs/prefix
  rm -rf "$prefix"
  cmake --install "$build" --prefix "$prefix" >/dev/null || return 1
  "$prefix/bin/sinew" --version || return 1

  # Programs that use one component do not need the libraries of others.
  local other
  other=$(printf -- '-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON ' Ceres Eigen3 nlohmann_json)
  SINEW_PREFIX=$prefix SINEW_CMAKE_FLAGS=$other tools/examples.sh --cpp 04-consumer || return 1
  SINEW_PREFIX=$prefix tools/examples.sh --cpp | tee "$logs/lessons" || return 1
  rm -rf "$logs/whole" && mkdir "$logs/whole" || return 1
  printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(whole LANGUAGES CXX)' \
    'find_package(sinew REQUIRED)' 'add_executable(whole main.cpp)' \
    'target_link_libraries(whole PRIVATE sinew::sinew)' >"$logs/whole/CMakeLists.txt"
  echo 'int main() {}' >"$logs/whole/main.cpp"
  cmake -G Ninja -S "$logs/whole" -B "$logs/whole/build" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null &&
    cmake --build "$logs/whole/build" >/dev/null &&
    echo "install: find_package(sinew) works; C++ lessons: $(sed -n 's/^examples: //p' "$logs/lessons")"
}

step_package() {
  build_all || return 1
  tests/package/muscle.sh "$logs/package" && tests/package/package.sh "$build" "$logs/package"
}

step_python() {
  build_all || return 1
  python/tests/run.sh "$build" || return 1
  SINEW_BUILD=$build tools/notebooks.py || return 1
  # The HTML of a cell, which the committed notebooks do not contain.
  PYTHONPATH=$build/python /usr/bin/python3 -c 'import sinew, sys
sys.stdout.write(sinew.run(sinew.shipped("experiments/walk-test-1.toml"))._repr_html_())' >"$logs/cell.html" &&
    node python/tests/notebook_offline.mjs "$logs/cell.html" || return 1
  local prefix=$PWD/$logs/python-prefix
  rm -rf "$prefix"
  cmake --install "$build" --prefix "$prefix" >/dev/null || return 1
  SINEW_PREFIX=$prefix tools/examples.sh --python || return 1
  echo "python: types, tests, notebooks; an installed one: the lessons"  # its installation: step package
}

step_fmu() {
  build_all && fmu/tests/run.sh "$build" 2>&1 | tee "$logs/fmu-tests" || return 1
  echo "fmu: $(sed -n 's/^Ran \([0-9]*\) tests.*/\1/p' "$logs/fmu-tests") tests with a test importer"
}

step_site() {
  build_all || return 1
  /usr/bin/python3 tests/site/test_reference.py && tools/npm-ci.sh web && SINEW_BUILD=$build tools/site.sh "$logs/site" | tee "$logs/site.txt" || return 1
  node tests/site/browser.mjs "$logs/site" | tee "$logs/site-browser" || return 1
  echo "site: $(sed -n 's/^site: //p' "$logs/site.txt"); $(sed -n 's/^names: //p' "$logs/site.txt");" \
    "$(grep -c '^ok ' "$logs/site-browser") tests in a browser"
}
