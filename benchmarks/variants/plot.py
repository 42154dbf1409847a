#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what benchmark_variants --json wrote: each variant's speed beside the unpolarized one's, and the paper's.

    benchmark_variants --json variants.json
    benchmarks/variants/plot.py variants.json variants.svg

A dot is a ratio, its line the 95 % interval, a cross the paper's ratio. Needs gnuplot.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import plotting  # noqa: E402

COLOURS = {"naive": "#d62728", "optimized": "#1f77b4", "auto": "#2ca02c"}


def panel(rows, names):
    """gnuplot's commands for the one panel: names from top to bottom as in the file, which begins with the paper's."""
    data, plots = [], ['$one using 1:2 with lines lc rgb "black" lw 0.8 notitle']
    variants = [v for v in COLOURS if any(r["variant"] == v for r in rows)]
    for i, variant in enumerate(variants):
        shift = (i - (len(variants) - 1) / 2) * 0.22
        ratios, papers = [], []
        for row in rows:
            if row["variant"] == variant:
                place = names.index((row["scene"], row["algorithm"])) + shift
                ratios.append(f"{row['ratio']:.5g} {place:.3f} {row['ratio_low']:.5g} {row['ratio_high']:.5g}")
                if row.get("paper_ratio"):
                    papers.append(f"{row['paper_ratio']:.5g} {place:.3f}")
        data += [f"$ratios{i} << EOD", *ratios, "EOD"]
        plots.append(f'$ratios{i} using 1:2:3:4 with xerrorbars pt 7 ps 0.6 lw 1.3 lc rgb "{COLOURS[variant]}" title "{variant}"')
        if papers:
            data += [f"$papers{i} << EOD", *papers, "EOD"]
            plots.append(f'$papers{i} using 1:2 with points pt 2 ps 0.9 lw 1.3 lc rgb "{COLOURS[variant]}" title "{variant} in the paper"')
    last = len(names) - 0.5
    ticks = ", ".join(f'"{scene}, {algorithm}" {place}' for place, (scene, algorithm) in enumerate(names))
    return ["$one << EOD", "1 -0.5", f"1 {last}", "EOD", *data, f"set ytics ({ticks}) noenhanced", f"set yrange [{last}:-0.5]",
            "plot " + ", \\\n  ".join(plots)]


def main():
    parser = plotting.parser_of(__doc__, "benchmark_variants")
    parser.add_argument("output", help="the picture, .png, .svg or .pdf")
    arguments = plotting.parse(parser)
    with plotting.content_of(arguments.json) as rows:
        names = list(dict.fromkeys((r["scene"], r["algorithm"]) for r in rows))
        panels = panel(rows, names)
    commands = ["set grid xtics lc rgb '#dddddd'", "set xrange [0:*]", 'set xlabel "paths a second, over those of unpolarized"',
                "set tmargin 4", "set key at screen 0.5,0.995 center top horizontal noenhanced maxcols 3 samplen 2"]
    plotting.draw(arguments.output, (800, 120 + 42 * len(names)), (1, 1), commands, panels)


if __name__ == "__main__":
    main()
