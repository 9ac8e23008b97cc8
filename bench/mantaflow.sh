#!/bin/sh
# One explosion in an open box of 4 m, by Brisance and by Mantaflow in Blender, the same simulated time, both writing their
# cache; one after the other. Prints the seconds of each, those of the solvers alone, and the ratios.
# usage: bench/mantaflow.sh [CELLS... [-- FRAMES]], after ./dev build; as it is: 64 128 -- 24.
set -eu
sizes=
frames=24
while [ $# -gt 0 ]; do
  if [ "$1" = -- ]; then
    frames=$2
    break
  fi
  sizes="$sizes $1"
  shift
done
time_scale=0.32
here=$(cd "$(dirname "$0")" && pwd)
program=$here/../build/release/bin/brisance
if ! command -v blender >/dev/null 2>&1; then
  echo "mantaflow: skipped: blender is not installed (Debian package blender)"
  exit 0
fi
if [ ! -x "$program" ]; then
  echo "mantaflow: $program: must be built first (./dev build)" >&2
  exit 1
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT INT TERM

# The explosion of scenes/window.toml, without the window.
scene() {
  cat <<TOML
[scene]
seed = 22
frames = $frames
fps = 24
time_scale = $time_scale

[gas]
corner = [-2.0, 0.0, -2.0]
size = [4.0, 4.0, 4.0]
cells = [$1, $1, $1]
cooling_rate = 7800
buoyancy = 5e-3
vorticity_confinement = 0.5

[explosion]
mass = 6.67e-3
burn_rate = 0.0695
gas_per_mass = 0.6
heat_per_mass = 137400
heating = 75000
drag = 5.8
soot_threshold = 3.7e-4
soot_position_spread = 0.05
soot_burn_rate = 2.0e-4
deposit_radius = 0.14

[[explosion.charges]]
position = [0.0, 1.4, 0.0]
radius = 0.48
particles = 6000
ignited = 30
emission_rate = 22500
emission_time = 0.1333
TOML
}

for cells in ${sizes:-64 128}; do
  scene "$cells" >"$folder/scene.toml"
  start=$(date +%s.%N)
  "$program" simulate "$folder/scene.toml" -o "$folder/run" --overwrite --json >"$folder/facts.json" 2>"$folder/log" ||
    { cat "$folder/log" >&2; exit 1; }
  ours=$(echo "$(date +%s.%N) $start" | awk '{ print $1 - $2 }')
  written=$(grep -o '"write": *[0-9.e-]*' "$folder/facts.json" | head -1 | sed 's/.*: *//')
  theirs=$(blender --background --factory-startup --python "$here/mantaflow.py" -- "$cells" "$frames" "$folder/cache" \
    "$time_scale" 2>&1 | tee "$folder/log" | grep -o 'MANTAFLOW .*') || { cat "$folder/log" >&2; exit 1; }
  rm -rf "$folder/run" "$folder/cache"
  echo "$theirs" | awk -v cells="$cells" -v frames="$frames" -v ours="$ours" -v written="$written" '{
    solver = ours - written; theirs = $3 * (1 - $4)
    printf "%d^3 cells, %d frames\n", cells, frames
    printf "  Brisance:  %7.2f s, solvers alone %7.2f s\n", ours, solver
    printf "  Mantaflow: %7.2f s, solvers alone %7.2f s (%d frames in its cache)\n", $3, theirs, $2
    printf "  ratio:     %7.1f    solvers alone %7.1f\n", $3 / ours, theirs / solver
  }'
done
