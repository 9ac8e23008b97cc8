#!/bin/sh
# Whole films, from scene file to MP4, each by one command: 100 frames of 300x300 with 2x2 samples, as in the thesis.
# Prints the seconds of each stage beside what is aimed at on two cores.
# usage: bench/films.sh [-o FOLDER] [SCENE...], after ./dev build; as it is: window window_closeup cow_head cow_balloon.
# FOLDER keeps the runs (else they are removed).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=$here/../build/release/bin/brisance
if [ ! -x "$program" ]; then
  echo "films: $program: must be built first (./dev build)" >&2
  exit 1
fi
if [ "${1:-}" = -o ]; then
  folder=${2:?films: -o must be followed by a folder}
  shift 2
  mkdir -p "$folder"
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT INT TERM
fi
[ $# -gt 0 ] || set -- window window_closeup cow_head cow_balloon

# goal SCENE: the whole film's seconds that are aimed at.
goal() {
  case $1 in
    window) echo 60 ;;
    window_closeup) echo 90 ;;
    cow_head | cow_balloon) echo 30 ;;
    *) echo - ;;
  esac
}
# number PATTERN: from the run's run.json, the one that follows PATTERN there.
number() { tr -d ' \n' <"$run/run.json" | sed "s/.*$1\([0-9.e-]*\).*/\1/"; }

echo "$(nproc) processors, load $(cut -d' ' -f1 /proc/loadavg) at the start"
printf '%-16s %6s %9s %9s %9s %9s %9s %9s\n' film frames fracture simulate render encode total goal
for scene in "$@"; do
  if [ ! -f "$here/../scenes/$scene.toml" ]; then
    echo "films: scenes/$scene.toml: no such scene" >&2
    exit 2
  fi
  run=$folder/$scene
  start=$(date +%s.%N)
  "$program" run "$here/../scenes/$scene.toml" -o "$run" --overwrite --quiet --frames 1-100 --size 300x300 --samples 2 \
    2>"$folder/log" || { cat "$folder/log" >&2; exit 1; }
  end=$(date +%s.%N)
  echo "$scene $(number '"film":{[^}]*"frames":') $(number '"simulate":{[^}]*"fracture":') \
    $(number '"simulate":{[^}]*"total":') $(number '"render":{"total":') $(number '"encode":{"total":') \
    $(echo "$end $start" | awk '{ print $1 - $2 }') $(goal "$scene")" |
    awk '{ printf "%-16s %6d %9.2f %9.2f %9.2f %9.2f %9.2f %9s\n", $1, $2, $3, $4 - $3, $5, $6, $7, $8 }'
done
