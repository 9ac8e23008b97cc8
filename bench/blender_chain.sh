#!/bin/sh
# The film of scenes/window.toml, from scene file to MP4, and a film like it by Blender alone: Cell Fracture, Bullet,
# Mantaflow, Cycles at 4 samples, ffmpeg. The same set, camera, pieces, gas cells, frames and size of pictures; one after
# the other. Prints the seconds of both, by the clock and of the processors (which other work on the machine hardly
# touches), and the ratios.
# usage: bench/blender_chain.sh [-o FOLDER] [FRAMES [WIDTH [CELLS]]], after ./dev build; as it is: 100 300 64.
# FOLDER keeps both films, and a strip of frames of both, ours above.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=$here/../build/release/bin/brisance
if ! command -v blender >/dev/null 2>&1; then
  echo "blender_chain: skipped: blender is not installed (Debian package blender)"
  exit 0
fi
if [ ! -x "$program" ]; then
  echo "blender_chain: $program: must be built first (./dev build)" >&2
  exit 1
fi
if [ "${1:-}" = -o ]; then
  folder=${2:?blender_chain: -o must be followed by a folder}
  shift 2
  mkdir -p "$folder"
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT INT TERM
fi
frames=${1:-100}
width=${2:-300}
cells=${3:-64}

# timed NAME COMMAND...: keeps its output in NAME.log, its seconds (clock, processors) in NAME.seconds.
timed() {
  name=$1
  shift
  /usr/bin/time -f '%e %U %S' -o "$folder/$name.seconds" "$@" >"$folder/$name.log" 2>&1 ||
    { cat "$folder/$name.log" >&2; exit 1; }
}
timed brisance "$program" run "$here/../scenes/window.toml" -o "$folder/run" --overwrite --quiet --frames "1-$frames" \
  --size "${width}x$width" --samples 2 --set "gas.cells=[$cells,$cells,$cells]"
timed blender blender --background --factory-startup --python "$here/blender_chain.py" -- "$cells" "$frames" 16 \
  "$width" 4 "$here/../assets" "$folder/blender"
if [ ! -f "$folder/blender/film.mp4" ]; then
  cat "$folder/blender.log" >&2
  exit 1
fi

echo "window, $frames frames of ${width}x$width, gas of $cells^3 cells"
grep '^CHAIN' "$folder/blender.log" | awk '{ printf "  Blender, %s: %s\n", $2, $3 }'
cat "$folder/brisance.seconds" "$folder/blender.seconds" | awk '{ clock[NR] = $1; work[NR] = $2 + $3 } END {
  printf "  Brisance: %7.1f s, of the processors %7.1f s\n", clock[1], work[1]
  printf "  Blender:  %7.1f s, of the processors %7.1f s\n", clock[2], work[2]
  printf "  ratio:    %7.1f    of the processors %7.1f\n", clock[2] / clock[1], work[2] / work[1] }'

# Six frames of each film, one above the other.
strip="select='not(mod(n,$((frames / 6 > 0 ? frames / 6 : 1))))',scale=240:-2,tile=6x1"
ffmpeg -v error -y -i "$folder/run/film.mp4" -i "$folder/blender/film.mp4" \
  -filter_complex "[0]${strip}[a];[1]${strip}[b];[a][b]vstack" -frames:v 1 -q:v 4 "$folder/strips.jpg"
rm -rf "$folder/blender/cache"
