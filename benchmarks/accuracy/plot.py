#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One plot of benchmark_accuracy's JSON: what an operation costs and how far it is off, to choose by.

    benchmarks/accuracy/plot.py accuracy.json -o accuracy.png

A panel for each operation, float and double apart. Across: nanoseconds; up: units in the last place of the precision, the point
at the root of the mean square, its line up to the maximum. Colours are how rotations are found, shapes how the code is compiled.
Left and down is better. A .svg as output gives that. Needs gnuplot.
"""
import argparse
import json
import shutil
import subprocess
import sys

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
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json", help="benchmark_accuracy's --json")
    parser.add_argument("-o", "--output", default="accuracy.png", help="the picture, .png or .svg")
    arguments = parser.parse_args()
    if not shutil.which("gnuplot"):
        sys.exit("plot.py: gnuplot is missing")
    try:
        with open(arguments.json, encoding="utf-8") as file:
            rows = json.load(file)
        operations = list(dict.fromkeys(r["operation"] for r in rows))
    except (OSError, ValueError, KeyError, TypeError) as error:
        sys.exit(f"plot.py: {arguments.json}: {error}")
    across = (len(operations) + 1) // 2
    size = f"{380 * across},{1240}"
    terminal = f"svg size {size} font 'sans,11'" if arguments.output.endswith(".svg") else f"pngcairo size {size} font 'sans,10'"
    lines = [f"set terminal {terminal}", f"set output '{arguments.output}'", "set logscale xy", "set grid lc rgb '#dddddd'",
             'set format "%g"', 'set xtics (1, 1.5, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200)', 'set xlabel "ns"', 'set ylabel "units in the last place"', f"set multiplot layout 4,{across}"]
    # Float above double, the first half of the operations above the second.
    for half in (operations[:across], operations[across:]):
        for precision in ("float", "double"):
            for operation in half:
                lines += panel(rows, operation, precision, operation == operations[0] and precision == "float")
            lines += ["set multiplot next"] * (across - len(half))
    subprocess.run(["gnuplot"], input="\n".join(lines + ["unset multiplot"]) + "\n", text=True, check=True)
    print(arguments.output)


if __name__ == "__main__":
    main()
