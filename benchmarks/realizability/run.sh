#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Is everything in the pictures light? Renders the bundled scenes, small, by every integrator and counts samples that were not finite,
# and pixels of which a colour has a degree of polarisation above 1 beyond rounding and its own standard error.
#   benchmarks/realizability/run.sh [FOLDER_OF_THE_PROGRAMS [SECONDS [SCENE...]]]
# SECONDS (1) are for each scene and integrator. Exit status 1 if a single one was found.
set -uo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." || exit 2
programs=${1:-build/release/examples} seconds=${2:-1}
shift $(($# < 2 ? $# : 2))
scenes=("$@")
((${#scenes[@]})) || scenes=(examples/scenes/*.xml)
[[ -x $programs/malus-render && -x $programs/malus-image ]] ||
  { echo "$0: no malus-render and malus-image in $programs" >&2; exit 2; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT

number() {
  sed -n "s/^ *\"$1\": \([0-9]*\),*$/\1/p" "$2" | head -n 1
}

printf '%-20s %-8s %12s %10s %10s %10s\n' scene by samples 'not finite' 'DoP > 1' 'by errors'
all=0 bad=0
for scene in "${scenes[@]}"; do
  name=$(basename "$scene" .xml)
  # Small pictures, so that every algorithm's iterations, of the whole picture each, fit into the time.
  size=()
  for side in resolution:64 width:64 height:48; do
    grep -q "<default name=\"${side%:*}\"" "$scene" && size+=(-D "${side%:*}=${side#*:}")
  done
  for integrator in path ptracer bdpt ppm bpm vcm; do
    "$programs/malus-render" "$scene" ${size[@]+"${size[@]}"} --integrator "$integrator" --mode optimized --time "$seconds" --seed 1 --standard-error \
      -o "$folder/out.exr" --stats "$folder/stats.json" >/dev/null 2>"$folder/err"
    status=$?
    if ((status != 0)); then
      # Light tracing alone doesn't render every scene, and says so.
      printf '%-20s %-8s %s\n' "$name" "$integrator" "$(head -n 1 "$folder/err" | cut -c 1-100)"
      ((status == 2)) || bad=$((bad + 1))
      continue
    fi
    "$programs/malus-image" "$folder/out.exr" --physical --json >"$folder/physical.json"
    samples=$(number samples "$folder/stats.json") lost=$(number non_finite_samples "$folder/stats.json")
    beyond=$(number beyond_rounding "$folder/physical.json") errors=$(number beyond_errors "$folder/physical.json")
    printf '%-20s %-8s %12s %10s %10s %10s\n' "$name" "$integrator" "$samples" "$lost" "$beyond" "$errors"
    all=$((all + samples)) bad=$((bad + lost + errors + $(number not_finite "$folder/physical.json")))
  done
done
echo "$all samples; $bad samples, pixels' colours or renderings that are wrong"
((bad == 0))
