#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What following polarisation costs in instructions, which unlike times are the same on a busy machine: malus-render under callgrind.

    cmake -S . -B build/count -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="-g1 -march=x86-64-v3 -ffp-contract=off"
    cmake --build build/count --target malus-render
    benchmarks/profile/instructions.py build/count/examples/malus-render --json instructions.json

Valgrind knows no AVX-512, so that the program must be compiled without. Instructions a path are the difference of pictures of two
numbers of samples, by one thread and with independent random numbers; they are the same in every run. Parts are profile.py's, by the file of
the innermost function; vectors and colours, which profile.py counts where they are used, are a part of their own.
"""
import argparse
import collections
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

import profile  # beside this file

# The rows of the paper's Table 1, and bidirectional path tracing.
ROWS = ["diffuse:path", "glossy:path", "glossy:bdpt", "glossy:vcm", "glass:path", "glass:bdpt", "glass:vcm", "glass_medium:path",
        "glass_medium:bdpt", "bathroom:bdpt", "bathroom:vcm", "bathroom_medium:bdpt"]
MODES = ["unpolarized", "optimized"]
SAMPLES = 1, 5
VECTORS = "vectors and colours"


def part_of(library, program, file):
    if library != program:
        return profile.part_of_library(library)
    if "/glm/" in file or re.search(profile.RULES[0][0], file):
        return VECTORS
    if re.search(profile.OUTSIDE_PASSES, file):
        return None
    return profile.part_of([file])


def read_counts(path, program):
    """A program's instructions by part, of callgrind's file: "ob=" names a library, "fl=", "fi=" and "fe=" a source file, with a "c" before it a
    callee's, each by a number that stands for the name from then on; of lines of costs the one behind "calls=" is the callee's."""
    names, counts = {}, collections.Counter()
    library = file = ""
    is_callee = False
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            if found := re.match(r"(c?)(ob|f[lie])=\((\d+)\)(?: (.*))?", line):
                is_callees, is_library = found[1] == "c", found[2] == "ob"
                name = names.setdefault((is_library, found[3]), found[4])
                if is_callees:
                    continue
                if is_library:
                    library = os.path.basename(name)
                else:
                    file = os.path.normpath(name)
            elif line.startswith("calls="):
                is_callee = True
            elif found := re.match(r"[+\-*\d]\S* (\d+)$", line):
                if not is_callee:
                    counts[part_of(library, program, file)] += int(found[1])
                is_callee = False
    del counts[None]
    return counts


def count(arguments, scene, integrator, mode, work):
    """Instructions a path, by part."""
    size = arguments.resolution
    sides = ["width", "height"] if scene.startswith("bathroom") else ["resolution"]
    counts = []
    for samples in SAMPLES:
        out = os.path.join(work, "callgrind.out")
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", arguments.program,
                   os.path.join(arguments.scenes, scene + ".xml"), "-o", os.path.join(work, "out.exr"), "--integrator", integrator, "--mode", mode,
                   "--sampler", "independent", "--threads", "1", "--spp", str(samples), *(w for s in sides for w in ("-D", f"{s}={size}"))]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"instructions.py: {' '.join(command)}: {done.stderr.strip()}")
        counts.append(read_counts(out, os.path.basename(arguments.program)))
    paths = size * size * (SAMPLES[1] - SAMPLES[0])
    return {part: (counts[1][part] - counts[0][part]) / paths for part in counts[1]}


def print_table(rows):
    parts = [p for p in [*profile.PARTS, VECTORS] if any(r["parts"].get(p, 0) > 0.005 * r["instructions_per_path"] for r in rows)]
    print("Instructions a path.\n\n| scene | algorithm | mode | all | ratio | " + " | ".join(parts) + " |")
    print("|---|---|---|" + "--:|" * (len(parts) + 2))
    for r in rows:
        values = " | ".join(f"{r['parts'].get(p, 0):.0f}" for p in parts)
        print(f"| {r['scene']} | {r['integrator']} | {r['mode']} | {r['instructions_per_path']:.0f} | {r['ratio']:.3f} | {values} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="malus-render, compiled with -g1 and without AVX-512")
    parser.add_argument("--row", nargs="+", default=ROWS, metavar="SCENE:INTEGRATOR", help="what is counted")
    parser.add_argument("--scenes", default=os.path.join(profile.ROOT, "examples/scenes"), help="folder of the scenes")
    parser.add_argument("--mode", nargs="+", default=MODES, help="ratios are the first one's instructions to each one's")
    parser.add_argument("--resolution", type=int, default=40, help="of square pictures (default 40)")
    parser.add_argument("--json", metavar="FILE")
    arguments = parser.parse_args()
    if not shutil.which("valgrind"):
        sys.exit("instructions.py: valgrind is missing")
    if not os.path.isfile(arguments.program):
        sys.exit(f"instructions.py: there is no file {arguments.program}")
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for row in arguments.row:
            scene, _, integrator = row.partition(":")
            for mode in arguments.mode:
                parts = count(arguments, scene, integrator, mode, work)
                rows.append({"scene": scene, "integrator": integrator, "mode": mode, "instructions_per_path": sum(parts.values()), "parts": parts})
                first = rows[-1 - arguments.mode.index(mode)]
                rows[-1]["ratio"] = first["instructions_per_path"] / rows[-1]["instructions_per_path"]
    print_table(rows)
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=2)


if __name__ == "__main__":
    main()
