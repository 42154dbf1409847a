#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Faults as a user meets them, with the programs themselves: killed, interrupted, out of space, in parts on several machines.
# faults.sh FOLDER_OF_THE_PROGRAMS FOLDER_OF_THE_SCENES
set -uo pipefail
programs=$1 scenes=$2
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
failed=0

fail() {
  echo "FAILED: $*"
  failed=1
}

# status EXPECTED WHAT COMMAND...
status() {
  local expected=$1 what=$2 got
  shift 2
  "$@" >"$folder/out" 2>"$folder/err"
  got=$?
  ((got == expected)) || fail "$what: exit status $got and not $expected: $(cat "$folder/err")"
}

same() {
  cmp -s "$1" "$2" || fail "$3: $1 and $2 differ"
}

render() {
  "$programs/malus-render" "$@"
}

# Killed in its midst, the rendering goes on to the same file, byte for byte, and leaves nothing else.
scene=("$scenes/glossy.xml" -D resolution=96 --integrator vcm --spp 24)
cd "$folder" && mkdir killed || exit 1
status 0 "a rendering" render "${scene[@]}" --seed 3 -o whole.exr
# In this shell: a function in the background is a shell of its own, which would be killed in its stead.
"$programs/malus-render" "${scene[@]}" --seed 3 -o killed/part.exr --threads 1 --checkpoint killed/part.checkpoint --checkpoint-every 0 &
for ((i = 0; i < 200; ++i)); do
  [[ -s killed/part.checkpoint ]] && break
  sleep 0.05
done
kill -KILL $! 2>/dev/null
wait $! 2>/dev/null
[[ -e killed/part.exr ]] && fail "a killed rendering wrote a picture"
if [[ -e killed/part.checkpoint ]]; then
  status 2 "a checkpoint of another seed" \
    render "${scene[@]}" --seed 4 -o killed/part.exr --checkpoint killed/part.checkpoint
  grep -q 'its seed is "3"' err || fail "what differs isn't named: $(cat err)"
else
  fail "no checkpoint was written"
fi
status 0 "going on" render "${scene[@]}" --seed 3 -o killed/part.exr --checkpoint killed/part.checkpoint --stats killed/stats.json
same whole.exr killed/part.exr "after a kill"
grep -q '"resumed_from": 0' killed/stats.json && fail "it did not go on, but began anew"
[[ $(ls -A killed) == $'part.exr\nstats.json' ]] || fail "left over: $(ls -A killed)"

# Signals.
for signal in INT:130 TERM:143; do
  (
    sleep 0.7
    kill "-${signal%:*}" "$(cat pid)"
  ) &
  status "${signal#*:}" "SIG${signal%:*}" bash -c 'echo $$ >pid; exec "$@"' _ "$programs/malus-render" \
    "$scenes/diffuse.xml" -D resolution=48 -o "$signal.exr" --time 60
  status 0 "what a stopped rendering wrote" "$programs/malus-image" "$signal.exr" --info
done

# Places that cannot be written, and no space: the picture that is there stays, and nothing beside it.
small=("$scenes/diffuse.xml" -D resolution=64 --spp 1)
status 0 "a small rendering" render "${small[@]}" -o kept.exr
cp kept.exr before.exr
mkdir a_folder
status 2 "a folder in the output's place" render "${small[@]}" -o a_folder
status 2 "a device" render "${small[@]}" -o /dev/full
status 2 "no such folder" render "${small[@]}" -o none/out.exr
if [[ $EUID -ne 0 ]]; then
  mkdir read_only && cp kept.exr read_only/ && chmod a-w read_only
  status 2 "a read-only folder" render "${small[@]}" -o read_only/kept.exr
  same kept.exr read_only/kept.exr "in a read-only folder"
  chmod u+w read_only
fi
status 1 "a limit on files' sizes" bash -c 'ulimit -f 4; exec "$@"' _ "$programs/malus-render" "${small[@]}" --seed 2 -o kept.exr
same before.exr kept.exr "after a full disk"
compgen -G '.malus-*' >/dev/null && fail "left over: $(ls -A)"
# A checkpoint that doesn't fit costs a warning, not the picture.
status 1 "a limit on files' sizes, with a checkpoint" bash -c 'ulimit -f 4; exec "$@"' _ \
  "$programs/malus-render" "${small[@]}" -o kept.exr --checkpoint small.checkpoint
same before.exr kept.exr "after a full disk, with a checkpoint"

# One picture in four parts, as of a job array.
for task in 0 1 2 3; do
  status 0 "a part" render "$scenes/glossy.xml" -D resolution=48 --integrator bpm --seed 9 --spp 3 \
    --first-sample $((3 * task)) -o "part$task.exr"
done
status 0 "the whole" render "$scenes/glossy.xml" -D resolution=48 --integrator bpm --seed 9 --spp 12 -o twelve.exr
status 0 "merging" "$programs/malus-merge" part[0-3].exr -o merged.exr
status 0 "comparing" "$programs/malus-image" --compare twelve.exr merged.exr --json
largest=$(tr -d ' \n' <out | grep -o '"max_[a-z_]*":[0-9.e+-]*' | sed 's/.*://' | sort -g | tail -n 1)
awk -v x="${largest:-1}" 'BEGIN {exit !(x < 1e-4)}' || fail "parts and the whole differ: $(cat out)"
status 2 "a part twice" "$programs/malus-merge" part0.exr part1.exr part1.exr -o merged.exr
status 2 "another scene" "$programs/malus-merge" part0.exr kept.exr -o merged.exr
status 0 "pixels that are light" "$programs/malus-image" merged.exr --physical

((failed == 0)) && echo "all as it should be"
exit "$failed"
