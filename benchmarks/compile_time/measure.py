#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long a translation unit takes to compile that includes Malus, beside one that includes GLM alone.

Prints a Markdown table of medians, in seconds of processor time, of compilations that take turns, so that whatever else the
machine does falls on all alike:

    benchmarks/compile_time/measure.py [--compiler g++ --compiler clang++-16] [--repetitions 9]
"""

import argparse
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

PRODUCT = """
using Light = malus::Stokes<malus::Rgb, malus::exitant>;
Light reflect(const malus::{matrix}& m, const Light& light) {{ return m * propagate(light); }}
"""

# What is compiled, the thing compared with first.
SOURCES = {
    "`<glm/glm.hpp>`": "#include <glm/glm.hpp>\n",
    "`<malus/malus.hpp>`": "#include <malus/malus.hpp>\n",
    "and one product of a block with light": "#include <malus/malus.hpp>\n"
    + PRODUCT.format(matrix="BlockMueller<malus::Rgb>"),
    "and one product of a matrix of any form with light": "#include <malus/malus.hpp>\n"
    + PRODUCT.format(matrix="Mueller<malus::Rgb>"),
}

MODES = {"parsed (-fsyntax-only)": ["-fsyntax-only"], "compiled (-O2)": ["-O2", "-c"]}


def processor_seconds(command):
    """Runs a command and says how much processor time it and its children took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{result.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def measure(compiler, repetitions, folder):
    """Median seconds by (source, mode)."""
    times = {(source, mode): [] for source in SOURCES for mode in MODES}
    for number, text in enumerate(SOURCES.values()):
        (folder / f"source{number}.cpp").write_text(text)
    for _ in range(repetitions):
        for number, source in enumerate(SOURCES):
            for mode, options in MODES.items():
                command = [compiler, "-std=c++20", *options, f"-I{ROOT / 'include'}",
                           str(folder / f"source{number}.cpp")]
                if "-c" in options:
                    command += ["-o", os.devnull]
                times[source, mode].append(processor_seconds(command))
    return {key: statistics.median(values) for key, values in times.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--compiler", action="append", metavar="NAME",
                        help="a compiler to measure; default: g++ and clang++-16, where installed")
    parser.add_argument("--repetitions", type=int, default=9)
    arguments = parser.parse_args()
    if arguments.repetitions < 1:
        parser.error("--repetitions must be at least 1")
    compilers = arguments.compiler or [c for c in ("g++", "clang++-16") if shutil.which(c)]
    if not compilers:
        sys.exit("no compiler found: name one by --compiler")

    print(f"| translation unit | {' | '.join(f'{c}, {m}' for c in compilers for m in MODES)} |")
    print("|---|" + "--:|" * (len(compilers) * len(MODES)))
    with tempfile.TemporaryDirectory() as name:
        medians = {c: measure(c, arguments.repetitions, pathlib.Path(name)) for c in compilers}
    for source in SOURCES:
        cells = [f"{medians[c][source, m]:.2f} s" for c in compilers for m in MODES]
        print(f"| {source} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
