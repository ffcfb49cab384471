#!/usr/bin/env bash
# Your own muscle: from measurements to a leg that walks with it. The stand is simulated, and its muscle is
# known, so that the result can be checked.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
program=$(cd "$root" && realpath "${SINEW_BUILD:-build/release}/bin/sinew")

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cp "$here/weights.csv" .

lesson() {  # prints a command line, then its output
  local word
  printf '$ sinew'
  for word in "$@"; do
    [[ $word == *' '* ]] && word="\"$word\""
    printf ' %s' "$word"
  done
  echo
  "$program" "$@" 2>&1
  echo
}

# --- mesh ---
lesson identify geometry --trapezoids 37,16 --side "0.057 in" --name bpa -o mesh.toml

# --- force cell ---
lesson identify sensor weights.csv -o cell.toml

# --- force at ten pressures ---
for psi in 10 20 30 40 50 60 70 80 90 100; do
  "$program" run "$here/pressures.toml" --set "charge.pressure=$psi psi gauge" -o "$psi" --quiet \
    >/dev/null
done
{ cut -d, -f2- 10/measured.csv | head -1
  for psi in 10 20 30 40 50 60 70 80 90 100; do tail -n +2 "$psi/measured.csv" | cut -d, -f2-; done
} >forces.csv
head -3 forces.csv
echo "… $(wc -l <forces.csv) lines"
echo
lesson identify static forces.csv --actuator mesh.toml --hold-out pressure --name bpa -o static.toml

# --- losses ---
"$program" run "$here/decay.toml" -o decay --quiet >/dev/null
cp decay/measured.csv decay.csv
lesson identify dynamic decay.csv --actuator static.toml --mass "6 lb" \
  --external-volume "0.114 in3" -o my-actuator.toml

# --- use of the result ---
lesson check my-actuator.toml
lesson actuator my-actuator.toml --length "80 mm" --pressure "50 psi gauge:110 psi gauge:20 psi"

# the stand's own, to compare
sed "s#\"../leg#\"$root/robots/leg#" "$root/robots/stand/equations.toml" >equations.toml
lesson actuator equations.toml --length "80 mm" --pressure "50 psi gauge:110 psi gauge:20 psi"

cat >my-leg.toml <<END
format = "sinew.robot/1"
base   = "$root/robots/leg/robot.toml"
files  = { actuator = "my-actuator.toml" }
END
cat >my-walk.toml <<END
format = "sinew.experiment/2"
base   = "$root/experiments/walk-test-1.toml"
robot  = "my-leg.toml"
END
echo '$ sinew run my-walk.toml'
"$program" run my-walk.toml -o walk --quiet
echo

# --- published table ---
cp "$root/data/martens_boblan_2017/DMSP-10-250_force_map.csv" map.csv
lesson identify static map.csv --map length=L_m,pressure=P_gauge_Pa,force=F_N \
  --unit L_m=m --unit "P_gauge_Pa=Pa gauge" --unit F_N=N --rest-length "250 mm" \
  --hold-out pressure --name dmsp-10-250 -o dmsp.toml

# --- data that are refused ---
echo '$ sinew identify static one-pressure.csv'
cut -d, -f2- 60/measured.csv >one-pressure.csv
"$program" identify static one-pressure.csv 2>&1 || echo "exit code $?"
