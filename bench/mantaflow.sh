#!/bin/sh
# One explosion in an open box of 4 m, by Brisance and by Mantaflow in Blender, the same simulated time, both writing their
# cache; one after the other. Brisance once as it is by default, by donor cells at a Courant number of at most 1, and once
# semi-Lagrangian at up to 6: Mantaflow's 4 counts the length of a velocity, which is 4 to 6.9 by the sum of its
# components. Prints the seconds of each, those of the solvers alone, and the ratios.
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

ours() {
  start=$(date +%s.%N)
  "$program" simulate "$folder/scene.toml" -o "$folder/run" --overwrite --json "$@" >"$folder/facts.json" 2>"$folder/log" ||
    { cat "$folder/log" >&2; exit 1; }
  taken=$(echo "$(date +%s.%N) $start" | awk '{ print $1 - $2 }')
  written=$(grep -o '"write": *[0-9.e-]*' "$folder/facts.json" | head -1 | sed 's/.*: *//')
  rm -rf "$folder/run"
  echo "$taken $written"
}

for cells in ${sizes:-64 128}; do
  scene "$cells" >"$folder/scene.toml"
  by_default=$(ours)
  long_steps=$(ours --set 'gas.advection.type="semi_lagrangian"' --set gas.courant=6)
  theirs=$(blender --background --factory-startup --python "$here/mantaflow.py" -- "$cells" "$frames" "$folder/cache" \
    "$time_scale" 2>&1 | tee "$folder/log" | grep -o 'MANTAFLOW .*') || { cat "$folder/log" >&2; exit 1; }
  rm -rf "$folder/cache"
  echo "$theirs $by_default $long_steps" | awk -v cells="$cells" -v frames="$frames" '
    function row(name, total, solver) { printf "  %-26s %7.2f s, solvers alone %7.2f s", name, total, solver }
    function ratio(total, solver) { printf "; ratios %5.1f, %5.1f\n", $3 / total, theirs / solver }
    {
      theirs = $3 * (1 - $4)
      printf "%d^3 cells, %d frames\n", cells, frames
      row("Mantaflow", $3, theirs); printf " (%d frames in its cache)\n", $2
      row("Brisance, donor cells", $5, $5 - $6); ratio($5, $5 - $6)
      row("Brisance, semi-Lagrangian", $7, $7 - $8); ratio($7, $7 - $8)
    }'
done
