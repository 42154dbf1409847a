#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One plot of benchmark_accuracy's JSON: what an operation costs and how far it is off, to choose by.

    benchmarks/accuracy/plot.py accuracy.json -o accuracy.png

A panel for each operation, float and double apart. Across: nanoseconds; up: units in the last place of the precision, the point
at the root of the mean square, its line up to the maximum. Colours are how rotations are found, shapes how the code is compiled.
Left and down is better. A .svg or .pdf as output gives that. Needs gnuplot.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import plotting  # noqa: E402

COLOURS = {"divided": "#1f77b4", "quotients": "#2ca02c", "undivided": "#d62728", "angles": "#7f7f7f", "": "#1f77b4"}
TITLES = {"divided": "1/(c² + s²), the library's", "quotients": "two quotients", "undivided": "no division", "angles": "atan2, cos, sin"}
SHAPES = {"strict": 7, "contracted": 5, "fast": 9}


def panel(rows, operation, precision, key):
    """gnuplot's commands for one operation in one precision."""
    chosen = [r for r in rows if r["operation"] == operation and r["precision"] == precision]
    plots, data = [], []
    for number, row in enumerate(chosen):
        name = f"$d{number}"
        most = max(row["ulp_max"], row["ulp_rms"])
        data += [f"{name} << EOD", f"{row['nanoseconds']} {row['ulp_rms']} {row['ulp_rms']} {most}", "EOD"]
        style = f'lc rgb "{COLOURS[row["turning"]]}" pt {SHAPES[row["build"]]} ps 1.1 lw 1'
        plots.append(f"{name} using 1:2:3:4 with yerrorbars {style} notitle")
    x0, x1 = min(r["nanoseconds"] for r in chosen) / 1.4, max(r["nanoseconds"] for r in chosen) * 1.4
    low, high = min(r["ulp_rms"] for r in chosen) / 2, max(r["ulp_max"] for r in chosen) * 2
    for turning, title in TITLES.items() if key else []:
        plots.append(f'NaN with points pt 7 ps 1.1 lc rgb "{COLOURS[turning]}" title "{title}"')
    for build, shape in SHAPES.items() if key else []:
        plots.append(f'NaN with points pt {shape} ps 1.1 lc rgb "black" title "{build}"')
    return data + [f'set title "{operation}, {precision}" noenhanced', f"set xrange [{x0}:{x1}]", f"set yrange [{low}:{high}]",
                   "set key top center samplen 0.5 spacing 0.95 noenhanced font ',8'" if key else "unset key",
                   "plot " + ", \\\n  ".join(plots)]


def main():
    arguments = plotting.parse(plotting.parser_of(__doc__, "benchmark_accuracy", "accuracy.png"))
    with plotting.content_of(arguments.json) as rows:
        operations = list(dict.fromkeys(r["operation"] for r in rows))
        across = (len(operations) + 1) // 2
        # Float above double, the first half of the operations above the second.
        panels = []
        for half in (operations[:across], operations[across:]):
            for precision in ("float", "double"):
                for operation in half:
                    panels += panel(rows, operation, precision, operation == operations[0] and precision == "float")
                panels += ["set multiplot next"] * (across - len(half))
    commands = ["set logscale xy", "set grid lc rgb '#dddddd'", 'set format "%g"',
                "set xtics (1, 1.5, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200)", 'set xlabel "ns"',
                'set ylabel "units in the last place"']
    plotting.draw(arguments.output, (380 * across, 1240), (4, across), commands, panels)


if __name__ == "__main__":
    main()
