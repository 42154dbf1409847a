#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Where the processor waits for what has just been written, by sampling malus-render with perf: a table by place.

    benchmarks/profile/stalls.py build/profile/examples/malus-render examples/scenes/glossy.xml --integrator vcm

A load takes what a store before it wrote from the store buffer, unless it reads more than that store wrote: then it waits until
the store has reached the cache. Instructions are not more for it, and perf shows the instruction behind the load. Here
each load from the stack, or by a register, is compared with the stores to the same place in the instructions before it, as they
stand in the program; what branches do between them is not known, and what is written by one function and read by another is not
seen. x86 alone. The program is compiled as profile.py says, with -g1.
"""
import argparse
import bisect
import collections
import os
import re
import subprocess
import sys
import tempfile

import profile  # beside this file

WINDOW = 60  # instructions between a store and a load that may wait for it
REACH = 3  # the instructions that a wait is sampled at: the load, and those behind it

Access = collections.namedtuple("Access", "number base offset size")

MEMORY = re.compile(r"(-?0x[0-9a-f]+|)\((%\w+)\)")
BY_NAME = [(r"(movs|movz)b", 1), (r"(movs|movz)w", 2), (r"v\w+ss$|vmovd$|vbroadcastss$|vinsertps$", 4),
           (r"v\w+sd$|vmovq$|vmov[lh]p[sd]$", 8)]
BY_REGISTER = [(r"%zmm", 64), (r"%ymm", 32), (r"%xmm", 16), (r"%r([abcd]x|[sd]i|[bs]p|\d+)$", 8), (r"%(e([abcd]x|[sd]i|[bs]p)|r\d+d)$", 4),
               (r"%([abcd]x|[sd]i|r\d+w)$", 2), (r"%([abcd][lh]|[sd]il|r\d+b)$", 1)]
BY_SUFFIX = {"b": 1, "w": 2, "l": 4, "q": 8}


def operands_of(text):
    """Split at the commas that are outside of parentheses."""
    return [o.strip() for o in re.split(r",(?![^(]*\))", text)]


def size_of(name, operands):
    """Bytes that an instruction reads or writes in memory."""
    for pattern, size in BY_NAME:
        if re.match(pattern, name):
            return size
    for operand in operands:
        if "(" not in operand:
            for pattern, size in BY_REGISTER:
                if re.match(pattern, operand):
                    return size
    return BY_SUFFIX.get(name[-1])


def access_of(number, name, operands):
    """What an instruction reads and what it writes, or None."""
    read = written = None
    if re.match(r"lea|nop|j|prefetch|call", name):
        return read, written
    for i, operand in enumerate(operands):
        found = MEMORY.fullmatch(operand)
        size = size_of(name, operands)
        if not found or not size or found[2] == "%rip":
            continue
        access = Access(number, found[2], int(found[1] or "0", 16), size)
        if re.match(r"v?mov", name) and i == len(operands) - 1:
            written = access
        else:
            read = access
    return read, written


def instructions(program):
    """(address, name, operands), and (None, None, None) where a function begins."""
    with subprocess.Popen(["objdump", "-d", "--no-show-raw-insn", program], stdout=subprocess.PIPE, text=True) as dump:
        for line in dump.stdout:
            if line.endswith(">:\n"):
                yield None, None, None
            elif found := re.match(r"\s+([0-9a-f]+):\s+(\S+)\s*([^#<\n]*)", line):
                yield int(found[1], 16), found[2], operands_of(found[3].strip())


def waiting_loads(program):
    """Addresses of all instructions, and (address of the load, its size, the store's) of those that have to wait."""
    addresses, waits, stores = [], [], []
    for address, name, operands in instructions(program):
        if address is None or name.startswith("call"):
            stores.clear()
        if address is None:
            continue
        addresses.append(address)
        read, written = access_of(len(addresses), name, operands)
        if read:
            for store in reversed(stores[-WINDOW:]):
                if read.number - store.number > WINDOW:
                    break
                if store.base == read.base and store.offset < read.offset + read.size and read.offset < store.offset + store.size:
                    if store.offset > read.offset or store.offset + store.size < read.offset + read.size:
                        waits.append((address, read.size, store.size))
                    break
        if written:
            stores.append(written)
    return addresses, waits


def sampled(program, arguments, work):
    data = os.path.join(work, "perf.data")
    command = ["perf", "record", "-q", "-e", "cpu-clock", "-F", "8000", "-o", data, "--", program, arguments.scene, "-o",
               os.path.join(work, "out.exr"), "--integrator", arguments.integrator, "--mode", arguments.mode, "--threads", "1", "--time",
               str(arguments.seconds)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"stalls.py: {' '.join(command)}: {done.stderr.strip()}")
    return profile.read_samples(data, program)


def place_of(program, address):
    text = subprocess.run(["addr2line", "-i", "-e", program, hex(address)], capture_output=True, text=True, check=True).stdout
    return " < ".join(os.path.basename(line.split(" ")[0]) for line in text.splitlines()[:4])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="malus-render, compiled with -g1")
    parser.add_argument("scene")
    parser.add_argument("--integrator", default="path")
    parser.add_argument("--mode", default="optimized")
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--rows", type=int, default=20, help="the most that are shown (default 20)")
    arguments = parser.parse_args()
    program = os.path.realpath(arguments.program)
    if not os.path.isfile(program):
        sys.exit(f"stalls.py: there is no file {arguments.program}")
    with tempfile.TemporaryDirectory() as work:
        samples, libraries = sampled(program, arguments, work)
    total = sum(samples.values()) + sum(libraries.values())
    addresses, waits = waiting_loads(program)
    rows = []
    for address, read, written in waits:
        first = bisect.bisect_left(addresses, address)
        if count := sum(samples[a] for a in addresses[first:first + REACH]):
            rows.append((count, address, read, written))
    rows.sort(reverse=True)
    print(f"{sum(r[0] for r in rows) / total:.2%} of {total} samples are at loads that may wait.\n")
    print("| of the time | bytes read | of which a store wrote | place |\n|--:|--:|--:|---|")
    for count, address, read, written in rows[:arguments.rows]:
        print(f"| {count / total:.2%} | {read} | {written} | {place_of(program, address)} |")


if __name__ == "__main__":
    main()
