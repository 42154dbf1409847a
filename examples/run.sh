#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Installs what is missing, builds the renderer and renders one polarised picture. Arguments are passed on to
# malus-render: `examples/run.sh --spp 256 --mode unpolarized`.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
root=$PWD

source cmake/dependencies.sh
require_dependencies compiler cmake ninja glm embree openexr tbb pugixml cli11 json tinyobjloader png stb

build="$root/build/examples"
out="$root/out"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMALUS_NATIVE=ON \
  -DMALUS_BUILD_TESTS=OFF -DMALUS_BUILD_BENCHMARKS=OFF
cmake --build "$build" --target malus-render malus-image optical_bench

echo
"$build/examples/optical_bench"

mkdir -p "$out"
samples=(--spp 64)
for argument in "$@"; do
  [[ $argument == --spp* || $argument == --time* ]] && samples=()
done
"$build/examples/malus-render" "$root/examples/scenes/box.xml" -o "$out/box.exr" "${samples[@]}" "$@"
"$build/examples/malus-image" "$out/box.exr" --show intensity -o "$out/box.png"
"$build/examples/malus-image" "$out/box.exr" --show overlay -o "$out/box_polarization.png"

echo
echo "The image, with its Stokes vectors:           $out/box.exr"
echo "The picture:                                  $out/box.png"
echo "The same in grey, polarised light in red:     $out/box_polarization.png"
