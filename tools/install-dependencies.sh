#!/usr/bin/env bash
# install-dependencies.sh [demo|check|faces|long|card|bench|npm]   installs missing packages with apt, and no others.
#
#   demo    builds and runs Sinew
#   check   also ./check
#   faces   also ./check faces
#   long    also ./check long
#   card    builds the program for graphics cards too
#   bench   builds Sinew and its benchmarks (bench)
#   npm     for tools/npm-ci.sh, if it cannot download npm
#
# It can be run again. It needs Debian 12 or a system with the same packages, which docs/dependencies.md
# describes. If the tools come from elsewhere, SINEW_DEPENDENCIES=present skips the installation.
set -euo pipefail

# Sets are cumulative. A tool is searched for by its command, since it may come from elsewhere (Debian's npm
# conflicts with other installations of Node); a library ("-") by its package.
#   set    command             package                          reason
list='
    demo   g++                 g++                              compiles C++20
    demo   cmake               cmake                            configures the build
    demo   ninja               ninja-build                      builds
    demo   -                   libtomlplusplus-dev              reads robots and experiments
    demo   -                   libcli11-dev                     parses the command line
    demo   -                   nlohmann-json3-dev               writes logs and summaries
    demo   -                   libfmt-dev                       formats numbers and messages
    demo   -                   zlib1g-dev                       checksums of logs, smaller pages
    demo   -                   libceres-dev                     least squares of identification
    demo   -                   libsqlite3-dev                   stores studies
    demo   -                   libboost-dev                     serves pages to the browser
    demo   -                   libminizip-dev                   packs FMUs
    demo   node                nodejs                           bundles pages of runs
    npm    npm                 npm                              installs the packages of the pages
    check  -                   libgtest-dev                     tests
    check  -                   libgmock-dev                     tests
    check  -                   libsundials-dev                  a second integrator in tests
    check  -                   libpagmo-dev                     searches for better walks
    check  gnuplot             gnuplot-nox                      draws figures
    check  clang-format-14     clang-format-14                  formats code; versions differ
    check  python3             python3                          runs tools/words.py
    faces  -                   libopenmpi-dev                   sweeps over the processes of mpirun
    faces  -                   libcomedi-dev                    data acquisition cards
    faces  -                   libmatio-dev                     recordings in MATLAB files
    faces  -                   pybind11-dev                     the Python package
    faces  -                   python3-dev                      compiles it
    faces  -                   python3-numpy                    arrays in Python
    faces  -                   python3-pandas                   tables in tests
    faces  -                   mypy                             checks its types
    faces  -                   python3-nbclient                 runs notebooks
    faces  -                   python3-ipykernel                interpreter for notebooks
    faces  dpkg-shlibdeps      dpkg-dev                         finds dependencies of the .deb
    faces  file                file                             recognises programs for it
    faces  -                   mkdocs-material                  builds the docs site, with MkDocs
    faces  -                   mkdocs-literate-nav              lists its pages by folder
    faces  doxygen             doxygen                          makes the reference of headers
    faces  -                   doxygen-awesome-css              its colours, light and dark
    faces  -                   libjs-katex                      typesets its formulas
    faces  ffmpeg              ffmpeg                           makes videos of runs, in tests
    faces  mpirun              openmpi-bin                      starts them in tests
    faces  chromium-headless-shell  chromium-headless-shell     opens pages in tests
    faces  -                   fonts-dejavu-core                font of the reference pictures
    long   arm-none-eabi-g++   gcc-arm-none-eabi                embedded core for Cortex-M4F
    long   -                   libstdc++-arm-none-eabi-newlib   library for it
    long   qemu-system-arm     qemu-system-arm                  runs firmware images
    long   clang++-14          clang-14                         second compiler
    long   -                   libclang-rt-14-dev               fuzzers and sanitizers for it
    long   llvm-symbolizer-14  llvm-14                          names lines in their reports
    card   clang++-19          clang-19                         compiles the program for graphics cards
    bench  -                   libbenchmark-dev                 repeats rows, computes their statistics
    bench  -                   libbenchmark-tools               compares two records
    bench  -                   python3-scipy                    needed by that
    bench  -                   libmujoco-dev                    comparison: bodies and contacts
    bench  -                   libsundials-dev                  comparison: CVODE
'

case ${1:-demo} in
  demo) sets=' demo ' ;;
  check) sets=' demo check ' ;;
  faces) sets=' demo check faces ' ;;
  long) sets=' demo check faces long ' ;;
  card) sets=' demo card ' ;;
  bench) sets=' demo bench ' ;;
  npm) sets=' npm ' ;;
  *) echo "usage: $0 [demo|check|faces|long|card|bench|npm]" >&2; exit 2 ;;
esac

if [[ ${SINEW_DEPENDENCIES:-} == present ]]; then
  echo "dependencies: taken as present"
  exit 0
fi

has_package() { [[ $(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null) == installed ]]; }

missing=()
while read -r set command package reason; do
  [[ -n $set && $sets == *" $set "* ]] || continue
  if [[ $command == - ]]; then
    command -v dpkg-query >/dev/null && has_package "$package" && continue
  else
    command -v "$command" >/dev/null && continue
  fi
  missing+=("$package")
  printf 'missing: %-31s %s\n' "$package" "$reason"
done <<<"$list"

if ((${#missing[@]} == 0)); then
  echo "dependencies: all present"
  exit 0
fi
if ! command -v apt-get >/dev/null; then
  echo "This system has no apt-get: install the above by other means, then run again with" \
       "SINEW_DEPENDENCIES=present" >&2
  exit 1
fi

as_root=()
if [[ $(id -u) != 0 ]]; then
  command -v sudo >/dev/null || { echo "Run as root: apt-get install ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q "$@"; }

log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "installing ${#missing[@]} package(s) …"
for step in "update" "install -y --no-install-recommends ${missing[*]}"; do
  # shellcheck disable=SC2086  # words of a command
  apt $step >"$log" 2>&1 || { tail -n 30 "$log" >&2; echo "apt-get $step: failed" >&2; exit 1; }
done
echo "dependencies: installed"
