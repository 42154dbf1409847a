#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Draws the plots in docs/pictures that docs/performance.md shows, from what benchmarks/run_all.sh has measured:
#
#   docs/make_plots.sh OUT [PICTURES]
#
# OUT is run_all.sh's folder, PICTURES where the plots go (docs/pictures). What was not measured is left as it is, with a line that
# says so. Needs gnuplot, and ImageMagick to reduce the number of colours.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
from=${1:?give the folder of benchmarks/run_all.sh}
to=${2:-docs/pictures}
for tool in gnuplot convert; do
  command -v "$tool" >/dev/null || { echo "make_plots.sh: $tool is missing" >&2; exit 2; }
done
mkdir -p "$to"

# draw FILE PICTURE COMMAND...
draw() {
  local file=$from/$1 picture=$to/$2
  shift 2
  if [[ ! -f $file ]]; then
    echo "make_plots.sh: $picture: skipped: there is no $file" >&2
    return
  fi
  "$@" >/dev/null
  convert "$picture" -colors 64 "PNG8:$picture"
  echo "$picture"
}

errors=(benchmarks/convergence/plot.py "$from/convergence.json" --variant optimized)
draw convergence.json performance_s0.png "${errors[@]}" --sampler independent --quantity S0 --overview "$to/performance_s0.png"
draw convergence.json performance_s1_s3.png "${errors[@]}" --sampler independent --quantity S1-S3 --overview "$to/performance_s1_s3.png"
draw scaling.json performance_scaling.png benchmarks/scaling/plot.py "$from/scaling.json" -o "$to/performance_scaling.png"
draw accuracy.json performance_accuracy.png benchmarks/accuracy/plot.py "$from/accuracy.json" -o "$to/performance_accuracy.png"
