#!/usr/bin/env bash
# fine.sh [FOLDER [PLAN...]]   repeats maps of this folder with a hundred times as many points as the tables of docs/evidence/studies
# have: FOLDER/PLAN.csv, by default in build/fine. The last four search for a gain at each point and take most of the hour that a
# processor needs. studies/fine.gp plots them as docs/pictures/maps.png and largest-gains.png.
set -euo pipefail
cd "$(dirname "$0")/.."
sinew=${SINEW:-build/release/bin/sinew} folder=${1:-build/fine}
plans=$(sed -n 's/^\([a-z-]*\)|.*/\1/p' studies/fine.sh | tr '\n' ' ')
for plan in "${@:2}"; do
  [[ -n $plan && " $plans " == *" $plan "* ]] || { echo "fine.sh: found the plan \"$plan\"; expected some of: $plans" >&2; exit 2; }
done
[[ -f $sinew && -x $sinew ]] || { echo "fine.sh: found no program $sinew; build it with ./demo, or name it by SINEW" >&2; exit 1; }
mkdir -p "$folder"

# Prints the plan with other values in place of its own.
fine() {  # fine PLAN LINE
  sed -e "s|^experiment .*|experiment = \"$PWD/$(sed -n 's|^experiment .*"\.\./\(.*\)".*|\1|p' "studies/$1.toml")\"|" -e "s|^vary .*|$2|" "studies/$1.toml"
}

while IFS='|' read -r plan values; do
  [[ $# -lt 2 || " ${*:2} " == *" $plan "* ]] || continue
  fine "$plan" "$values" >"$folder/$plan.toml"
  "$sinew" sweep "$folder/$plan.toml" -o "$folder/$plan.csv" ${THREADS:+--threads "$THREADS"} --quiet --force
done <<END
range-stiffness|vary = ["control.stiffness.hip=5:75:1500 lbf in/rad"]
table-height|vary = ["ground.height=-14.5:-12.5:900 in"]
table-height-felt|vary = ["ground.height=-14.5:-12.5:900 in"]
velocity-gain|range = ["control.gains.hip.velocity=0.001:1 % s/count log"]\nsample = "latin"\npoints = 900
payload|vary = ["trolley.payload=0:40:600 lb"]
repeat-damping|vary = ["joint.hip.damping=0.2:2.07:50 lbf in s/rad", "joint.knee.damping=0.2:2.07:50 lbf in s/rad"]
gain-stiffness|vary = ["control.stiffness.hip=5:75:1500 lbf in/rad"]
gain-stiffness-gain|vary = ["joint.hip.stiffness_gain=0:13:900 %/(lbf in/rad)"]
gain-duration|vary = ["phase.swing.duration=0.5:3:700 s"]
gain-inertia|vary = ["link.femur.inertia=10.36:300:800 lb in2"]
END
