#!/bin/sh
# Solid pieces of one mesh by Brisance and by Blender's Cell Fracture, one after the other: prints both times of the
# breaking alone, and their ratio. usage: bench/cell_fracture.sh [TRIANGLES [PIECES [SHAPE]]], after ./dev build.
set -eu
triangles=${1:-10000}
pieces=${2:-100}
shape=${3:-sphere}
here=$(cd "$(dirname "$0")" && pwd)
programs=$here/../build/release/bin
if ! command -v blender >/dev/null 2>&1; then
  echo "cell_fracture: skipped: blender is not installed (Debian package blender)"
  exit 0
fi
if [ ! -x "$programs/brisance" ] || [ ! -x "$programs/make_meshes" ]; then
  echo "cell_fracture: $programs: must be built first (./dev build)" >&2
  exit 1
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT INT TERM
"$programs/make_meshes" "$shape" "$triangles" "$folder/body.obj"
"$programs/brisance" fracture "$folder/body.obj" --solid --method voronoi --pieces "$pieces" --json >"$folder/facts.json"
seconds=$(grep -o '"solid":[0-9.e-]*' "$folder/facts.json" | cut -d: -f2)
count=$(grep -o '"closed":true,"area"' "$folder/facts.json" | wc -l)
theirs=$(blender --background --factory-startup --python "$here/cell_fracture.py" -- "$folder/body.obj" "$pieces" \
  2>"$folder/log" | grep '^CELL_FRACTURE' | cut -d' ' -f2-) || { cat "$folder/log" >&2; exit 1; }
set -- $theirs
echo "$shape, $triangles triangles, $pieces pieces"
echo "Brisance:      $count closed pieces, $seconds s"
echo "Cell Fracture: $1 pieces, $2 of them open, $3 s"
awk -v a="$seconds" -v b="$3" 'BEGIN { printf "ratio: %.1f\n", b / a }'
