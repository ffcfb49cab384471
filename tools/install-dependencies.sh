#!/usr/bin/env bash
# install-dependencies.sh [demo|check|faces|long|bench|npm]   installs with apt what is missing, no more.
#
#   demo    to build and run Sinew
#   check   and for ./check
#   faces   and for ./check faces
#   long    and for ./check long
#   bench   to build Sinew and what measures it beside others (bench)
#   npm     where tools/npm-ci.sh cannot fetch npm
#
# Can be run again. Needs Debian 12 or a system with the same packages; docs/dependencies.md tells
# more about each. Where you have the tools from elsewhere, SINEW_DEPENDENCIES=present skips this.
set -euo pipefail

# Sets add up. A tool is looked for by its command, since it may come from elsewhere (Debian's npm
# conflicts with other installations of Node); a library by its package ("-").
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
    demo   -                   libsqlite3-dev                   keeps studies
    demo   -                   libboost-dev                     serves pages to the browser here
    demo   -                   libminizip-dev                   packs FMUs
    demo   node                nodejs                           bundles the page that shows a run
    npm    npm                 npm                              installs what that needs
    check  -                   libgtest-dev                     tests
    check  -                   libgmock-dev                     tests
    check  -                   libsundials-dev                  a second integrator in tests
    check  -                   libpagmo-dev                     searches for better walks
    check  gnuplot             gnuplot-nox                      draws figures
    check  clang-format-14     clang-format-14                  one layout of code; versions differ
    faces  -                   libopenmpi-dev                   sweeps over the processes of mpirun
    faces  -                   libcomedi-dev                    a machine at a card
    faces  -                   libmatio-dev                     recordings in files of MATLAB
    faces  -                   pybind11-dev                     the Python package
    faces  -                   python3-dev                      what that is compiled with
    faces  -                   python3-numpy                    its arrays
    faces  -                   python3-pandas                   tables of them, in tests
    faces  -                   mypy                             types of its interface
    faces  -                   python3-nbclient                 runs notebooks
    faces  -                   python3-ipykernel                their interpreter
    faces  dpkg-shlibdeps      dpkg-dev                         finds what the .deb depend on
    faces  file                file                             tells programs from other files there
    faces  -                   mkdocs-material                  builds the docs site, with MkDocs
    faces  -                   mkdocs-literate-nav              lists its pages by folder
    faces  doxygen             doxygen                          makes its reference of the headers
    faces  -                   doxygen-awesome-css              colours of that, light and dark
    faces  -                   libjs-katex                      sets its formulas
    faces  ffmpeg              ffmpeg                           makes videos of runs, in tests
    faces  mpirun              openmpi-bin                      starts them in tests
    faces  chromium-headless-shell  chromium-headless-shell     opens that page in tests
    faces  -                   fonts-dejavu-core                what its reference pictures are set in
    long   arm-none-eabi-g++   gcc-arm-none-eabi                embedded core for Cortex-M4F
    long   -                   libstdc++-arm-none-eabi-newlib   its headers
    long   qemu-system-arm     qemu-system-arm                  runs it
    long   clang++-14          clang-14                         the other compiler
    long   -                   libclang-rt-14-dev               fuzzers and sanitizers for it
    long   llvm-symbolizer-14  llvm-14                          names lines in what they find
    bench  -                   libbenchmark-dev                 times parts of a walk
    bench  -                   libmujoco-dev                    a peer: bodies and contacts
    bench  -                   libsundials-dev                  a peer: CVODE
'

case ${1:-demo} in
  demo) sets=' demo ' ;;
  check) sets=' demo check ' ;;
  faces) sets=' demo check faces ' ;;
  long) sets=' demo check faces long ' ;;
  bench) sets=' demo bench ' ;;
  npm) sets=' npm ' ;;
  *) echo "usage: $0 [demo|check|faces|long|bench|npm]" >&2; exit 2 ;;
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
