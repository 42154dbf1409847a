#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Fuzzes everything that reads files or arguments: `tests/fuzz/run.sh [-k CORPUS] SECONDS [FUZZER...]` gives each of the
# fuzzers (scene, mesh, picture, volume, arguments; all by default) so many seconds, beginning from the corpus beside this
# script, and says how many inputs each has run. What is found lies in build/asan/found; with -k what is learnt is kept in
# a folder, to go on from. Builds first, with the preset "asan". Exits with 1 if a fuzzer found something.
set -uo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." || exit 2

kept=""
if [[ ${1:-} == -k ]]; then
  kept=${2:?-k wants a folder}
  shift 2
fi
seconds=${1:-}
[[ $seconds =~ ^[1-9][0-9]*$ ]] || { echo "usage: tests/fuzz/run.sh [-k CORPUS] SECONDS [FUZZER...]" >&2; exit 2; }
shift
fuzzers=("$@")
((${#fuzzers[@]})) || fuzzers=(scene mesh picture volume arguments)

cmake --preset asan >/dev/null && cmake --build --preset asan --parallel "$(nproc)" --target "${fuzzers[@]/#/fuzz_}" || exit 1

corpus=$PWD/tests/fuzz/corpus dictionary=$PWD/tests/fuzz/scene.dict found=$PWD/build/asan/found
programs=$PWD/build/asan/tests/fuzz
mkdir -p "$found"
learnt=${kept:-$(mktemp -d)}
log=$(mktemp)
export TMPDIR=/dev/shm
[[ -d $TMPDIR && -w $TMPDIR ]] || unset TMPDIR

status=0
for fuzzer in "${fuzzers[@]}"; do
  arguments=(-max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 -print_final_stats=1 "-artifact_prefix=$found/$fuzzer-")
  [[ $fuzzer == scene ]] && arguments+=("-dict=$dictionary")
  mkdir -p "$learnt/$fuzzer"
  if "$programs/fuzz_$fuzzer" "${arguments[@]}" "$learnt/$fuzzer" "$corpus/$fuzzer" >"$log" 2>&1; then
    echo "$fuzzer: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs, nothing found"
  else
    tail -n 40 "$log"
    echo "FAILED: $fuzzer; the input is in $found"
    status=1
  fi
done
rm -f "$log"
[[ -n $kept ]] || rm -rf "$learnt"
exit "$status"
