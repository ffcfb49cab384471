#!/usr/bin/env bash
# fine.sh [FOLDER [PLAN...]]   repeats the maps of this folder with a hundred times the points of the files in docs/evidence/studies:
# FOLDER/PLAN.csv, by default in build/fine. Those without a search, the first six, take four minutes of a processor; each of the
# others takes ten to twenty. studies/fine.gp plots the six as docs/pictures/maps.png.
set -euo pipefail
cd "$(dirname "$0")/.."
sinew=${SINEW:-build/release/bin/sinew} folder=${1:-build/fine}
mkdir -p "$folder"

# Prints the plan with other values in place of its own.
fine() {  # fine PLAN LINE
  sed -e "s|^experiment .*|experiment = \"$PWD/$(sed -n 's|^experiment .*"\.\./\(.*\)".*|\1|p' "studies/$1.toml")\"|" -e "s|^vary .*|$2|" "studies/$1.toml"
}

noise='sensor.hip_angle.real.noise=0.5,1.5,4 count' gain='joint.hip.velocity_gain=0:0.032:600 % s/count'
while IFS='|' read -r plan values; do
  [[ $# -lt 2 || " ${*:2} " == *" $plan "* ]] || continue

  fine "$plan" "$values" >"$folder/$plan.toml"
  "$sinew" sweep "$folder/$plan.toml" -o "$folder/$plan.csv" --threads "${THREADS:-0}" --quiet --force
done <<END
range-stiffness|vary = ["control.stiffness.hip=5:75:1500 lbf in/rad"]
table-height|vary = ["ground.height=-14.5:-12.5:900 in"]
table-height-felt|vary = ["ground.height=-14.5:-12.5:900 in"]
velocity-gain|range = ["control.gains.hip.velocity=0.001:1 % s/count log"]\nsample = "latin"\npoints = 900
payload|vary = ["trolley.payload=0:40:600 lb"]
repeat-damping|vary = ["joint.hip.damping=0.2:2.07:50 lbf in s/rad", "joint.knee.damping=0.2:2.07:50 lbf in s/rad"]
gain-duration|vary = ["phase.swing.duration=0.5:3:700 s"]
gain-inertia|vary = ["link.femur.inertia=10.36:300:800 lb in2"]
gain-stiffness-gain|vary = ["joint.hip.stiffness_gain=0:13:900 %/(lbf in/rad)"]
gain-stiffness|vary = ["control.stiffness.hip=5:75:1500 lbf in/rad"]
gain-inertia-knee|vary = ["link.tibia.inertia=1.527:150:800 lb in2"]
usable-gain-damper|vary = ["joint.hip.damper=0:8:600 lbf in s/rad"]
usable-gain-difference|vary = ["$noise", "$gain"]
usable-gain-kalman|vary = ["$noise", "$gain"]
usable-gain-average|vary = ["$noise", "$gain"]
usable-gain-bounded|vary = ["$noise", "$gain"]
usable-gain-sensor|vary = ["sensor.hip_velocity.real.noise=0,3,10 count", "$gain"]
END
