#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Runs the benchmarks one after the other, so that they don't take time from each other, and leaves what they print and
# measure, and plots of it, in a folder:
#
#   benchmarks/run_all.sh OUT [MINUTES]
#
# MINUTES (35) are shared by all of them; algebra, accuracy, connections and instructions have a length of their own, some minutes. The machine
# should have nothing else to do. Programs are taken from BUILD (build/benchmarks), the profiled one from PROFILE (build/profile), that whose
# instructions are counted from COUNT (build/count), which are configured and compiled first unless COMPILE=0. A part that fails or is not installed is said in one line and in
# OUT/summary.md, and the others go on; the exit status is then 1, but 0 if parts were skipped alone. PARTS names what to run:
#
#   PARTS="variants scaling" benchmarks/run_all.sh out 5
#
# References of benchmark_convergence are kept in OUT/references. MITSUBA names a Python that has Mitsuba (python3).
set -uo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." || exit 2

out=${1:-}
minutes=${2:-35}
if [[ -z $out || ! $minutes =~ ^[0-9]+(\.[0-9]+)?$ ]] || (($# > 2)); then
  echo "usage: benchmarks/run_all.sh OUT [MINUTES]" >&2
  exit 2
fi
build=${BUILD:-build/benchmarks}
profile=${PROFILE:-build/profile}
count=${COUNT:-build/count}
python=${MITSUBA:-python3}
parts=${PARTS:-variants convergence accuracy scaling limits profile instructions peers thick_media connections algebra}
mkdir -p "$out" || exit 2
out=$(cd -- "$out" && pwd)
summary=$out/summary.md
failures=0

say() { echo "run_all.sh: $*" | tee -a "$out/run_all.log" >&2; }
# of the whole, divided by a number of equal turns: seconds
share() { awk -v m="$minutes" -v part="$1" -v turns="${2:-1}" 'BEGIN { s = m * 60 * part / turns; printf "%.4g", s < 0.02 ? 0.02 : s }'; }
skip() {
  say "$1: skipped: $2"
  echo "| $1 | skipped: $2 | |" >>"$summary"
}

# run PART COMMAND...: its Markdown in OUT/PART.md, what it says besides in OUT/PART.log.
run() {
  local part=$1 start=$SECONDS status=0
  shift
  if [[ ! -x $1 ]] && ! command -v "$1" >/dev/null; then
    skip "$part" "there is no $1"
    return 1
  fi
  say "$part: $*"
  # Three times as long as everything, and five minutes at least, is for what hangs.
  timeout "$(awk -v m="$minutes" 'BEGIN { printf "%d", m < 1.7 ? 300 : m * 180 }')" "$@" >"$out/$part.md" 2>"$out/$part.log" || status=$?
  if ((status != 0)); then
    say "$part: failed with status $status: $(tail -n 1 "$out/$part.log")"
    echo "| $part | **failed** with status $status | $((SECONDS - start)) s |" >>"$summary"
    ((failures += 1))
    return 1
  fi
  echo "| $part | done | $((SECONDS - start)) s |" >>"$summary"
}

# A plot that can't be drawn fails nothing.
plot() {
  local part=$1
  shift
  "$@" >>"$out/$part.log" 2>&1 || say "$part: no plot: $(tail -n 1 "$out/$part.log")"
}

compile() {
  local folder=$1
  shift
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMALUS_NATIVE=ON "$@" && return
  say "cmake cannot configure $folder"
  return 1
}

part_variants() {
  # 24 rows of four variants, of some rounds at least.
  local resolution=256
  awk -v m="$minutes" 'BEGIN { exit !(m < 10) }' && resolution=64
  run variants "$build/benchmarks/benchmark_variants" --seconds "$(share 0.25 96)" --resolution $resolution --json "$out/variants.json" || return
  plot variants benchmarks/variants/plot.py "$out/variants.json" "$out/variants.svg"
}

part_convergence() {
  local budget
  budget=$(awk -v m="$minutes" 'BEGIN { printf "%.4g", m * 0.4 }')
  run convergence "$build/benchmarks/benchmark_convergence" --budget "$budget" --resolution 64 --variant unpolarized naive optimized \
    --sampler independent sobol --repeats 4 --points 5 --target 0.25 0.1 --cache "$out/references" --json "$out/convergence.json" || return
  plot convergence benchmarks/convergence/plot.py "$out/convergence.json" -o "$out/convergence" --sampler independent
  plot convergence benchmarks/convergence/plot.py "$out/convergence.json" --overview "$out/convergence_s0.png" --quantity S0 \
    --variant optimized --sampler independent
  plot convergence benchmarks/convergence/plot.py "$out/convergence.json" --overview "$out/convergence_s1_s3.png" --quantity S1-S3 \
    --variant optimized --sampler independent
  plot convergence benchmarks/convergence/plot.py "$out/convergence.json" --overview "$out/samplers.png" --quantity S0 --variant optimized
}

part_accuracy() {
  run accuracy "$build/benchmarks/accuracy/benchmark_accuracy" --json "$out/accuracy.json" || return
  plot accuracy benchmarks/accuracy/plot.py "$out/accuracy.json" -o "$out/accuracy.png"
}

part_scaling() {
  local largest=1024
  awk -v m="$minutes" 'BEGIN { exit !(m < 10) }' && largest=256
  run scaling "$build/benchmarks/benchmark_scaling" --scene vcm_box upbp_sphere --seconds "$(share 0.07 144)" --largest $largest \
    --json "$out/scaling.json" || return
  plot scaling benchmarks/scaling/plot.py "$out/scaling.json" -o "$out/scaling.png"
}

part_limits() {
  run limits "$build/benchmarks/benchmark_profile" --seconds "$(share 0.05 40)" --json "$out/limits.json"
}

part_profile() {
  if ! command -v perf >/dev/null; then
    skip profile "perf is not installed"
    return
  fi
  if [[ ! -x $profile/examples/malus-render ]]; then
    skip profile "there is no $profile/examples/malus-render"
    return
  fi
  run profile benchmarks/profile/profile.py "$profile/examples/malus-render" --seconds "$(share 0.05 24)" --json "$out/profile.json"
}

part_instructions() {
  if ! command -v valgrind >/dev/null; then
    skip instructions "valgrind is not installed"
    return
  fi
  if [[ ! -x $count/examples/malus-render ]]; then
    skip instructions "there is no $count/examples/malus-render"
    return
  fi
  run instructions benchmarks/profile/instructions.py "$count/examples/malus-render" --json "$out/instructions.json"
}

part_peers() {
  run peers_algebra "$build/benchmarks/benchmark_peers"
  if ! "$python" -c "import mitsuba" 2>/dev/null; then
    skip peers_mitsuba "$python has no Mitsuba (pip install mitsuba; MITSUBA=PYTHON names one that has it)"
    return
  fi
  # Four scenes by two forms of some seven renderers, and half as long again to start them.
  run peers_mitsuba "$python" benchmarks/peers/compare_mitsuba.py --malus "$build/examples/malus-render" --scene diffuse --scene glossy \
    --scene vcm_box --scene crossed_polarizers --seconds "$(share 0.12 84)" --json "$out/peers.json" --plot "$out/peers.png"
}

part_connections() {
  run connections "$build/benchmarks/benchmark_connections"
}

part_thick_media() {
  run thick_media "$build/benchmarks/benchmark_thick_media" --seconds "$(share 0.03 24)"
}

part_algebra() {
  run algebra "$build/benchmarks/benchmark_algebra"
}

for part in $parts; do
  declare -F "part_$part" >/dev/null || { echo "run_all.sh: there is no part \"$part\"" >&2; exit 2; }
done
if [[ ${COMPILE:-1} != 0 ]]; then
  if ! { compile "$build" -DMALUS_BUILD_TESTS=OFF && cmake --build "$build"; } >"$out/compile.log" 2>&1; then
    say "not everything is compiled: $out/compile.log"
  fi
  if [[ " $parts " == *" profile "* ]] && command -v perf >/dev/null; then
    if ! { compile "$profile" -DMALUS_BUILD_TESTS=OFF -DMALUS_BUILD_BENCHMARKS=OFF -DCMAKE_CXX_FLAGS=-g1 &&
      cmake --build "$profile" --target malus-render; } >>"$out/compile.log" 2>&1; then
      say "nothing to profile: $out/compile.log"
    fi
  fi
  if [[ " $parts " == *" instructions "* ]] && command -v valgrind >/dev/null; then
    # Valgrind knows no AVX-512.
    if ! { compile "$count" -DMALUS_BUILD_TESTS=OFF -DMALUS_BUILD_BENCHMARKS=OFF -DMALUS_NATIVE=OFF \
      -DCMAKE_CXX_FLAGS="-g1 -march=x86-64-v3 -ffp-contract=off" && cmake --build "$count" --target malus-render; } >>"$out/compile.log" 2>&1; then
      say "nothing to count: $out/compile.log"
    fi
  fi
fi

{
  echo "# Benchmarks"
  echo
  echo "$(git describe --always --dirty 2>/dev/null), $(date -u +%F), $(nproc) processors: $(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -n 1)"
  echo
  echo "| part | | |"
  echo "|---|---|--:|"
} >"$summary"
for part in $parts; do "part_$part"; done
say "all done: $summary, $failures failed"
((failures == 0))
