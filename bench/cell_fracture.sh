#!/bin/sh
# Solid pieces of one mesh by Brisance and by Blender's Cell Fracture, one after the other: prints both times and their
# ratio. usage: bench/cell_fracture.sh [TRIANGLES [PIECES]], with build/release built with -DBRISANCE_BENCH=ON.
set -eu
triangles=${1:-10000}
pieces=${2:-100}
here=$(cd "$(dirname "$0")" && pwd)
program=$here/../build/release/bin/cell_fracture_mesh
if ! command -v blender >/dev/null 2>&1; then
  echo "cell_fracture: skipped: blender is not installed (Debian package blender)"
  exit 0
fi
if [ ! -x "$program" ]; then
  echo "cell_fracture: $program: must be built first (cmake --preset release -DBRISANCE_BENCH=ON)" >&2
  exit 1
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT INT TERM
ours=$("$program" "$folder/body.obj" "$triangles" "$pieces")
theirs=$(blender --background --factory-startup --python "$here/cell_fracture.py" -- "$folder/body.obj" "$pieces" 2>"$folder/log" |
  grep '^CELL_FRACTURE' | cut -d' ' -f2-) || { cat "$folder/log" >&2; exit 1; }
set -- $ours $theirs
echo "$triangles triangles, $pieces pieces"
echo "Brisance:      $1 pieces, $2 s"
echo "Cell Fracture: $3 pieces, $4 of them open, $5 s"
awk -v a="$2" -v b="$5" 'BEGIN { printf "ratio: %.1f\n", b / a }'
