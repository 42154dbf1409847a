#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# compare.sh VALGRIND PROGRAM COMPILER_VERSION RECORDED: counts the instructions of every function counted::... of the
# program, those it calls among them, and compares with the recorded file, a line `name instructions` each behind a line
# `compiler VERSION`. Exits with 1 if a count is more than 3 percent off, either way: what has become faster is to be
# recorded as well (`compare.sh --record ...` does so). Exits with 77 for a compiler that nothing is recorded of.
set -euo pipefail

record=0
[[ $1 == --record ]] && { record=1; shift; }
valgrind=$1 program=$2 version=$3 recorded=$4

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

known=$(sed -n 's/^compiler //p' "$recorded" 2>/dev/null || true)
if ((!record)) && [[ $known != "$version" ]]; then
  echo "the counts are recorded of GCC ${known:-nothing}, this is $version: nothing to compare with"
  exit 77
fi

# Names and positions written out, and a function's calls with their inclusive costs below it.
"$valgrind" --tool=callgrind --callgrind-out-file="$folder/out" --compress-strings=no --compress-pos=no \
  --toggle-collect='counted::*' "$program" 2>"$folder/log" || { cat "$folder/log"; exit 1; }
awk '
  /^fn=/ { name = substr($0, 4); inside = match(name, /^counted::/); sub(/^counted::/, "", name); sub(/\(.*/, "", name) }
  inside && /^[0-9+*-]/ { sum[name] += $2 }
  END { for (name in sum) print name, sum[name] }' "$folder/out" | sort >"$folder/counts"

if ((record)); then
  { echo "compiler $version"; cat "$folder/counts"; } >"$recorded"
  exit
fi
awk '
  NR == FNR { if ($1 != "compiler") expected[$1] = $2; next }
  { found[$1] = $2 }
  END {
    for (name in expected) {
      if (!(name in found)) { print "not counted: " name; bad = 1; continue }
      ratio = found[name] / expected[name]
      verdict = ratio > 1.03 ? "SLOWER" : ratio < 0.97 ? "FASTER: record it" : "as recorded"
      printf "%-28s %8d instructions, recorded %8d, %+.1f %%: %s\n", name, found[name], expected[name], 100 * (ratio - 1), verdict
      if (verdict != "as recorded") bad = 1
    }
    for (name in found) if (!(name in expected)) { print "not recorded: " name; bad = 1 }
    exit bad
  }' "$recorded" "$folder/counts"
