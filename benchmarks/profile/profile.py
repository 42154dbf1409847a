#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where a path's nanoseconds go, by sampling malus-render with perf: a table by scene, integrator and mode.

    cmake -S . -B build/profile -G Ninja -DCMAKE_BUILD_TYPE=Release -DMALUS_NATIVE=ON -DCMAKE_CXX_FLAGS=-g1
    cmake --build build/profile --target malus-render
    benchmarks/profile/profile.py build/profile/examples/malus-render --json profile.json

Nearly everything is inlined, so that symbols say little: every sampled instruction is looked up in the program's line tables
(addr2line), which know the functions that it was inlined through. The innermost of these whose file belongs to a part names the
part; vectors, colours and the standard library belong to none, and count where they are used. One thread, and the processor's
time of the passes alone: what reads the scene and writes the picture is left out.
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

SCENES = ["vcm_box", "glossy", "glass", "upbp_sphere"]
INTEGRATORS = ["path", "bdpt", "vcm"]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# What a part's files are called, the first that fits; None: look at what the code was inlined into.
RULES = [
    (r"include/malus/spectrum|include/malus/config|core/(vector|warp|affine)", None),
    (r"include/malus/optics/", "BSDFs"),
    (r"include/malus/", "polarisation"),
    (r"renderer/core/(sampler|sobol)", "sampler"),
    (r"renderer/film/", "film"),
    (r"renderer/geometry/", "rays"),
    (r"integrators/photon_map|core/prefetch", "photon map"),
    (r"integrators/visibility|renderer/emitters/|scene/scene", "lights and shadow rays"),
    (r"integrators/mis", "weights"),
    (r"renderer/bsdfs/|renderer/textures/|integrators/scatterer", "BSDFs"),
    (r"renderer/media/|integrators/way", "media"),
    (r"integrators/(camera_path|path_sweep)", "polarisation"),
    (r"renderer/(integrators|render|sensors)/", "walks"),
]
# What reads the scene and writes the picture is no part of a path's time.
OUTSIDE_PASSES = r"renderer/(io|image)/|renderer/scene/(?!scene\.)|renderer/render/(command_line|statistics|explain)"
LIBRARIES = [(r"libembree", "Embree"), (r"libtbb", "threads"), (r"libm[.-]", "sin, cos, exp"), (r"libc[.-]|libstdc", "memory"),
             (r"libz|libOpenEXR|libIlm|libIex|libImath|libpng|libpugixml|ld-linux", None)]
PARTS = ["Embree", "rays", "BSDFs", "polarisation", "lights and shadow rays", "walks", "weights", "photon map", "media", "sampler", "film",
         "sin, cos, exp", "memory", "threads", "system", "others"]


def part_of(files):
    """The part that an instruction belongs to, by the files of the functions it was inlined through, innermost first."""
    for file in files:
        for pattern, part in RULES:
            if re.search(pattern, file):
                if part is None:
                    break
                return part
    return "others"


def part_of_library(name):
    """None: of what is left out."""
    for pattern, part in LIBRARIES:
        if re.search(pattern, os.path.basename(name)):
            return part
    return "system" if name.startswith("[") else "others"


def segments(program):
    """(file offset, size, address) of the program's loaded parts."""
    text = subprocess.run(["readelf", "-lW", program], capture_output=True, text=True, check=True).stdout
    return [(int(m[1], 16), int(m[3], 16), int(m[2], 16))
            for m in re.finditer(r"LOAD\s+(0x\w+) (0x\w+) 0x\w+ (0x\w+)", text)]


def read_samples(data, program):
    """How often each address of the program was met, and each other file."""
    text = subprocess.run(["perf", "script", "-i", data, "--show-mmap-events", "-F", "comm,pid,ip,dso"], capture_output=True, text=True,
                          check=True).stdout
    parts, maps = segments(program), []
    addresses, libraries = collections.Counter(), collections.Counter()
    for line in text.splitlines():
        if found := re.search(r"PERF_RECORD_MMAP2? .*\[(0x\w+)\((0x\w+)\) @ (0x\w+|0) .*\]: \S+ (.*)$", line):
            start, size, offset = (int(v, 16) for v in found.groups()[:3])
            if os.path.realpath(found[4].strip()) == program:
                maps.append((start, size, offset))
        elif found := re.search(r"\s([0-9a-f]+) \((.*)\)\s*$", line):
            ip, name = int(found[1], 16), found[2]
            if os.path.realpath(name) != program:
                libraries[name] += 1
                continue
            for start, size, offset in maps:
                if start <= ip < start + size:
                    place = ip - start + offset
                    for file_offset, length, address in parts:
                        if file_offset <= place < file_offset + length:
                            addresses[place - file_offset + address] += 1
    return addresses, libraries


def look_up(program, addresses):
    """The files of the functions at each address, innermost first."""
    asked = sorted(addresses)
    text = subprocess.run(["addr2line", "-a", "-i", "-e", program], input="\n".join(hex(a) for a in asked), capture_output=True, text=True,
                          check=True).stdout
    files, current = {}, None
    for line in text.splitlines():
        if re.fullmatch(r"0x[0-9a-f]{16}", line):
            current = files.setdefault(int(line, 16), [])
        else:
            current.append(os.path.normpath(line.rsplit(":", 1)[0]))
    return files


def profile(program, scene, integrator, mode, seconds, work):
    """Nanoseconds a path by part, and the samples that say so."""
    data, stats = os.path.join(work, "perf.data"), os.path.join(work, "stats.json")
    render = [program, scene, "-o", os.path.join(work, "out.exr"), "--integrator", integrator, "--mode", mode, "--threads", "1", "--stats", stats]

    def facts_of(command):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"profile.py: {' '.join(command)}: {done.stderr.strip()}")
        with open(stats, encoding="utf-8") as file:
            return json.load(file)

    # Whole passes: one that is cut short has traced its light paths, but few of its camera paths.
    passes = max(1, round(seconds / facts_of([*render, "--spp", "1"])["seconds"]))
    facts = facts_of(["perf", "record", "-q", "-e", "cpu-clock", "-F", "4000", "-o", data, "--", *render, "--spp", str(passes)])
    addresses, libraries = read_samples(data, program)
    files = look_up(program, addresses)
    if addresses and all(f == ["??"] for f in files.values()):
        sys.exit(f"profile.py: {program} has no line tables: compile it with -g1")
    counts = collections.Counter()
    for address, count in addresses.items():
        if any(re.search(OUTSIDE_PASSES, f) for f in files[address]):
            continue
        counts[part_of(files[address])] += count
    for name, count in libraries.items():
        if part := part_of_library(name):
            counts[part] += count
    total = sum(counts.values())
    path = 1e9 / facts["paths_per_second"]
    return {"scene": os.path.splitext(os.path.basename(scene))[0], "integrator": integrator, "mode": mode, "nanoseconds_per_path": path,
            "rays_per_path": (facts["rays"] + facts["shadow_rays"]) / facts["samples"], "perf_samples": total,
            "parts": {part: path * counts[part] / total for part in PARTS if counts[part]}}


def print_table(rows):
    used = [p for p in PARTS if any(r["parts"].get(p, 0) > 0.005 * r["nanoseconds_per_path"] for r in rows)]
    print("Nanoseconds a path.\n\n| scene | integrator | mode | all | rays a path | " + " | ".join(used) + " |")
    print("|---|---|---|" + "--:|" * (len(used) + 2))
    for r in rows:
        values = " | ".join(f"{r['parts'].get(p, 0):.0f}" for p in used)
        print(f"| {r['scene']} | {r['integrator']} | {r['mode']} | {r['nanoseconds_per_path']:.0f} | {r['rays_per_path']:.2f} | {values} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="malus-render, compiled with -g1")
    parser.add_argument("--scene", nargs="+", default=SCENES, help="names of scenes")
    parser.add_argument("--scenes", default=os.path.join(ROOT, "examples/scenes"), help="folder of the scenes")
    parser.add_argument("--integrator", nargs="+", default=INTEGRATORS)
    parser.add_argument("--mode", nargs="+", default=["unpolarized", "optimized"])
    parser.add_argument("--seconds", type=float, default=5, help="of each row (default 5)")
    parser.add_argument("--json", metavar="FILE")
    arguments = parser.parse_args()
    for tool in ("perf", "addr2line", "readelf"):
        if not shutil.which(tool):
            sys.exit(f"profile.py: {tool} is missing")
    program = os.path.realpath(arguments.program)
    if not os.path.isfile(program):
        sys.exit(f"profile.py: there is no file {arguments.program}")
    rows = []
    with tempfile.TemporaryDirectory() as work:
        for name in arguments.scene:
            scene = os.path.join(arguments.scenes, name + ".xml")
            for integrator in arguments.integrator:
                for mode in arguments.mode:
                    rows.append(profile(program, scene, integrator, mode, arguments.seconds, work))
    print_table(rows)
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=2)


if __name__ == "__main__":
    main()
