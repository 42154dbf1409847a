#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what benchmark_variants --json wrote: each variant's speed beside the unpolarized one's, and the paper's.

    benchmark_variants --json variants.json
    benchmarks/variants/plot.py variants.json variants.svg

A dot is a ratio, its line the 95 % interval, a cross the paper's ratio.
"""

import argparse
import json
import sys

COLORS = {"naive": "tab:red", "optimized": "tab:blue", "auto": "tab:green"}
KEYS = ("scene", "algorithm", "variant", "ratio", "ratio_low", "ratio_high")


def read_rows(path):
    try:
        with open(path, encoding="utf-8") as file:
            rows = json.load(file)
    except (OSError, ValueError) as error:
        sys.exit(f"plot.py: {path}: {error}")
    if not isinstance(rows, list) or not all(isinstance(r, dict) and all(k in r for k in KEYS) for r in rows):
        sys.exit(f"plot.py: {path}: expected a list of rows with {', '.join(KEYS)}")
    return rows


def draw(pyplot, rows, output):
    # From top to bottom as in the file, which begins with the paper's.
    names = list(dict.fromkeys((r["scene"], r["algorithm"]) for r in rows))
    variants = [v for v in COLORS if any(r["variant"] == v for r in rows)]
    figure, axes = pyplot.subplots(figsize=(8, 1.2 + 0.42 * len(names)), layout="constrained")
    axes.axvline(1, color="black", linewidth=0.8)
    for i, variant in enumerate(variants):
        shift = (i - (len(variants) - 1) / 2) * 0.22
        mine = [r for r in rows if r["variant"] == variant]
        places = [names.index((r["scene"], r["algorithm"])) + shift for r in mine]
        errors = [[r["ratio"] - r["ratio_low"] for r in mine], [r["ratio_high"] - r["ratio"] for r in mine]]
        axes.errorbar([r["ratio"] for r in mine], places, xerr=errors, fmt="o", markersize=4, color=COLORS[variant], label=variant)
        papers = [(r["paper_ratio"], y) for r, y in zip(mine, places) if r.get("paper_ratio")]
        if papers:
            axes.plot(*zip(*papers), "x", color=COLORS[variant], label=f"{variant} in the paper")
    axes.set_yticks(range(len(names)), [f"{scene}, {algorithm}" for scene, algorithm in names])
    axes.invert_yaxis()
    axes.set_xlim(left=0)
    axes.set_xlabel("paths a second, over those of unpolarized")
    axes.grid(axis="x", alpha=0.3)
    figure.legend(loc="outside upper center", ncols=3, frameon=False)
    figure.savefig(output)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json", help="what benchmark_variants --json wrote")
    parser.add_argument("output", help="picture to write: .svg, .png or .pdf")
    arguments = parser.parse_args()
    rows = read_rows(arguments.json)
    try:
        import matplotlib
    except ImportError:
        sys.exit("plot.py needs matplotlib, which is not installed (Debian: apt-get install python3-matplotlib; or pip install matplotlib)")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    draw(pyplot, rows, arguments.output)


if __name__ == "__main__":
    main()
