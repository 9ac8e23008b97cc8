#!/bin/sh
# The thesis' frame (300x300, 2x2 samples, 512 pieces of glass, a volume of 300^3 cells) by Brisance and by Cycles in
# Blender: the same bodies by glTF, the same gas by VDB, one after the other. Then both by all ways of light: the time
# that Brisance's path integrator needs for the noise of Cycles at 64 samples.
# usage: bench/cycles.sh [WIDTHxHEIGHT [CYCLES_SAMPLES [FOLDER]]], after ./dev build and ./dev bench; as it is 300x300 64.
# FOLDER keeps the run and the pictures (else they are removed).
set -eu
size=${1:-300x300}
samples=${2:-64}
frame=14
bounces=12
here=$(cd "$(dirname "$0")" && pwd)
programs=$here/../build/release/bin
if ! command -v blender >/dev/null 2>&1; then
  echo "cycles: skipped: blender is not installed (Debian package blender)"
  exit 0
fi
if [ ! -x "$programs/brisance" ] || [ ! -x "$programs/fine_volume" ]; then
  echo "cycles: $programs: brisance and fine_volume must be built first (./dev build, ./dev bench)" >&2
  exit 1
fi
if [ -n "${3:-}" ]; then
  folder=$3
  mkdir -p "$folder"
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT INT TERM
fi
width=${size%x*}
height=${size#*x}

if [ ! -d "$folder/run" ]; then
  sed -e 's/pieces = 16/pieces = 512/; s/points = 200/points = 1600/' -e "s/^frames = .*/frames = $frame/" \
    -e "s#\.\./assets#$here/../assets#" "$here/../scenes/window.toml" >"$folder/scene.toml"
  "$programs/brisance" simulate "$folder/scene.toml" -o "$folder/run" --quiet
  "$programs/brisance" export "$folder/run" --to gltf -o "$folder/bodies.glb" --frames "$frame" --quiet >/dev/null
  "$programs/fine_volume" "$folder/run" "$frame" "$folder/gas.vdb"
fi

# draw NAME OPTIONS...: draws the frame, keeps the picture as NAME.exr, prints the seconds
# of the whole program (those in run.json add up over all pictures of a run).
draw() {
  name=$1
  shift
  /usr/bin/time -f '%e %M' -o "$folder/memory" "$programs/brisance" render "$folder/run" --frames "$frame" --json --quiet \
    --size "$size" --set render.layers=false "$@" >"$folder/facts.json"
  cp "$folder/run/images/frame.00$frame.exr" "$folder/$name.exr"
  cut -d' ' -f1 "$folder/memory"
}
# cycles NAME SAMPLES SEEDS: prints the seconds of each picture NAME_SEED.exr.
cycles() {
  blender --background --factory-startup --python "$here/cycles.py" -- "$folder/bodies.glb" "$folder/gas.vdb" "$frame" \
    "$width" "$height" "$2" "$bounces" "$3" "$folder/$1" 2>&1 | tee "$folder/log" | grep '^CYCLES' | cut -d' ' -f2
}
# noise NAME SECONDS: compares NAME_0.exr and NAME_1.exr, prints it, and keeps it in the table.
noise() {
  blender --background --factory-startup --python "$here/compare_pictures.py" -- "$folder/$1_0.exr" "$folder/$1_1.exr" 2>&1 |
    grep '^NOISE' | {
    read -r _ _ rmse mean shown
    echo "  $1: $2 s, noise $rmse, of what a display shows $shown, mean $mean"
    echo "$1 $2 $rmse $shown" >>"$folder/table"
  }
}
# sooner COLUMN: how many times sooner the quickest picture with no more noise than Cycles' is there; and one with as much
# noise would be, if noise falls with the square root of time.
sooner() {
  awk -v c="$1" '/^cycles/ { most = $c; theirs = $2 } { noise[$1] = $c; seconds[$1] = $2 }
    END { for (name in noise) if (name ~ /^path/ && noise[name] <= most && (!best || seconds[name] < seconds[best])) best = name
          if (!best) { print "not reached"; exit }
          as_much = seconds[best] * (noise[best] / most) ^ 2
          printf "%.1f times sooner (%s s); with as much noise %.1f times\n", theirs / seconds[best], seconds[best], theirs / as_much
    }' "$folder/table"
}

echo "Whitted's rays against Cycles at 4 samples, $size"
ours=$(draw whitted --samples 2)
memory=$(cut -d' ' -f2 "$folder/memory")
theirs=$(cycles cycles_4 4 1)
awk -v a="$ours" -v b="$theirs" -v m="$memory" 'BEGIN {
  printf "  Brisance: %.3f s, %.0f MB at most\n  Cycles:   %.3f s\n  ratio:    %.1f\n", a, m / 1024, b, b / a }'

echo "All ways of light, $size"
# Cycles' gas absorbs and shines; its glass is clear.
path="--set render.integrator.type=path --set render.integrator.max_bounces=$bounces
  --set render.volume.smoke_colour=[0,0,0] --set materials.glass.absorption=[0,0,0] --set render.seed="
rm -f "$folder/table"
# paths ROW N OPTIONS...: two pictures path_ROW of N x N samples (in the mean, if N is not whole), and their noise.
paths() {
  row=path_$1
  n=$2
  shift 2
  first=$(draw "${row}_0" --samples "$n" ${path}1 "$@")
  draw "${row}_1" --samples "$n" ${path}2 "$@" >/dev/null
  noise "$row" "$first"
}
paths 2_rough 1.41421 --set render.integrator.splits=0 --set render.integrator.faint=0.05
paths 2 1.41421
paths 2x2_rough 2 --set render.integrator.splits=0 --set render.integrator.faint=0.05
paths 2x2 2
paths 3x3 3
theirs=$(cycles "cycles_$samples" "$samples" 2 | head -1)
noise "cycles_$samples" "$theirs"
echo "  the noise of Cycles: $(sooner 3)"
echo "  of what a display shows: $(sooner 4)"
