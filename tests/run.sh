#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Installs what is missing, builds everything and runs every test, in these stages, any of which can be asked for alone
# (`tests/run.sh asan format`):
#   release  everything with the system's compiler, optimised: all tests, compile-fail and package tests among them
#   asan     everything with Clang 16: the tests under the address and undefined behaviour sanitizers (of the latter without
#            the checks of pointers that the former makes as well, which take most of the time to compile); the benchmarks,
#            which are compiled alone
#   fuzz     every reader of files and arguments under libFuzzer and the sanitizers, for a few seconds each; by what asan
#            has compiled
#   tsan     every integrator on several threads under the thread sanitizer (asked for alone only)
#   format   clang-format finds nothing to change
#   tidy     clang-tidy finds nothing to object to
# Every CTest entry counts as one test, and so does each stage's build. The last line is the sum of them.
set -uo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." || exit 2

stages=("$@")
((${#stages[@]})) || stages=(release asan fuzz format tidy)
for stage in "${stages[@]}"; do
  case $stage in
    release | asan | fuzz | tsan | format | tidy) ;;
    *) echo "tests/run.sh: no stage is called '$stage'; there are release, asan, fuzz, tsan, format and tidy" >&2; exit 2 ;;
  esac
done

source cmake/dependencies.sh
require_dependencies compiler cmake ninja pkg-config glm embree openexr tbb pugixml cli11 json tinyobjloader png stb \
  doctest rapidcheck benchmark clang clang-fuzzer clang-tidy clang-format valgrind

jobs=$(nproc)
passed=0 failed=0 skipped=0
failures=()

# check NAME COMMAND...: the command is one test.
check() {
  local name=$1
  shift
  if "$@" </dev/null; then
    ((passed += 1))
  else
    echo "FAILED: $name"
    ((failed += 1))
    failures+=("$name")
    return 1
  fi
}

# build PRESET [OPTIONS OF CMAKE...]: everything.
build() {
  local preset=$1
  shift
  cmake --preset "$preset" "$@" && cmake --build --preset "$preset" --parallel "$jobs" -- -k 0
}

# run_ctest PRESET [ARGUMENTS...]: every entry is one test.
run_ctest() {
  local preset=$1 report status attributes total failures_here skipped_here
  shift
  report=$PWD/build/$preset/tests.xml
  rm -f "$report"
  ctest --preset "$preset" --parallel "$jobs" --output-junit "$report" "$@" </dev/null
  status=$?
  attributes=$(tr '\n' ' ' <"$report" 2>/dev/null | grep -o '<testsuite [^>]*>' | head -n 1)
  total=$(attribute tests) failures_here=$(attribute failures) skipped_here=$(($(attribute skipped) + $(attribute disabled)))
  ((passed += total - failures_here - skipped_here, failed += failures_here, skipped += skipped_here))
  ((failures_here == 0)) || failures+=("$preset: $failures_here CTest entries")
  if ((total == 0 || (status != 0 && failures_here == 0))); then
    ((failed += 1))
    failures+=("$preset: CTest itself (status $status, $total entries)")
  fi
}

attribute() {
  local value
  value=$(sed -n "s/.*[[:space:]]$1=\"\([0-9]*\)\".*/\1/p" <<<"$attributes")
  echo "${value:-0}"
}

# The benchmarks are compiled, unoptimised, in the stage "asan" alone: they take longer than all the rest.
stage_release() {
  check "release: build" build release -DMALUS_BUILD_BENCHMARKS=OFF && run_ctest release
}

# Without the longest comparisons of pictures, whose code the shorter ones run through as well.
stage_asan() {
  local long='agree: (diffuse|glossy|glass|bathroom)\.xml|agree: (a mesh whose|paths of one|light out of glass|rough glass)|merges that weigh as much|every kind of light|sheets before the light|small errors are caught|strategies: each alone'
  long+='|media agree: (a scene full|dense bodies|extinction|media that emit|media within|density|each strategy)|slab: (Natraj|IPRT|the same by)'
  long+='|media optics: nothing can be seen in a furnace, whatever scatters'
  check "asan: build" build asan &&
    run_ctest asan --label-exclude 'package|compile_fail' --exclude-regex "^(docs|guard):|$long"
}

# Here they run what is known; tests/fuzz/run.sh looks further for as long as one wants.
stage_fuzz() {
  local fuzzer
  for fuzzer in scene mesh picture volume arguments; do
    check "fuzz: $fuzzer" bash tests/fuzz/run.sh 5 "$fuzzer"
  done
}

stage_tsan() {
  check "tsan: build" build_renderer tsan || return
  local scene integrator
  for scene in glossy glass_medium; do
    for integrator in path ptracer bdpt ppm bpm vcm; do
      check "tsan: $scene by $integrator" renders_without_races "$scene" "$integrator"
    done
  done
}
build_renderer() {
  cmake --preset "$1" && cmake --build --preset "$1" --parallel "$jobs" --target malus-render
}
renders_without_races() {
  local picture status
  picture=$(mktemp --suffix=.exr)
  TSAN_OPTIONS="exitcode=66 suppressions=$PWD/tests/tsan.supp" build/tsan/examples/malus-render "examples/scenes/$1.xml" -o "$picture" --integrator "$2" \
    --mode optimized --spp 8 --threads 3 -D resolution=48
  status=$?
  rm -f "$picture"
  return "$status"
}

own_sources() {
  find include tests examples benchmarks \( -name '*.hpp' -o -name '*.cpp' \) -print0
}

stage_format() {
  check "format" format_is_clean
}
format_is_clean() {
  own_sources | xargs -0 clang-format-16 --dry-run --Werror
}

stage_tidy() {
  check "tidy" tidy_is_clean
}
tidy_is_clean() {
  clang-tidy-16 --quiet tests/headers/main.cpp examples/optical_bench.cpp -- -std=c++20 -Iinclude
}

for stage in "${stages[@]}"; do
  started=$SECONDS
  echo
  echo "--- $stage"
  "stage_$stage"
  echo "--- $stage: $((SECONDS - started)) s"
done

echo
for failure in ${failures[@]+"${failures[@]}"}; do
  echo "FAILED: $failure"
done
summary="$passed passed, $failed failed"
((skipped == 0)) || summary+=", $skipped skipped"
echo "$summary"
((failed == 0))
