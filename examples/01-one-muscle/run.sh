#!/usr/bin/env bash
# One muscle on the command line: its tension, its stiffness, and how fast a valve fills it.
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${SINEW_BUILD:-build/release}/bin/sinew

lesson() {  # prints a command line, then its output
  local word
  printf '$ sinew'
  for word in "$@"; do
    [[ $word == *' '* ]] && word="\"$word\""
    printf ' %s' "$word"
  done
  echo
  "$program" "$@"
  echo
}

lesson actuator robots/leg/actuator.toml --length 3.4in --pressure "60 psi gauge"
lesson actuator robots/leg/actuator.toml --length 2.5in:3.9in:0.2in --pressure "60 psi gauge"
lesson actuator robots/leg/actuator.toml --length 3.4in --pressure "0 psi gauge:100 psi gauge:25 psi"
lesson valve robots/leg/valves.toml 758 --upstream "100 psi gauge" --downstream "0 psi gauge" \
  --volume "0.3 in3" --duty "0%:100%:25%" --frequency "25 Hz"

echo '$ sinew actuator … --json, two of its values'
"$program" actuator robots/leg/actuator.toml --length 3.4in --pressure "60 psi gauge" --json |
  awk -f tools/flatten.awk | grep -E '\.(tension_N|stiffness_sealed_N_per_m) '
