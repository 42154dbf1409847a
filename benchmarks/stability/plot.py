#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One plot of benchmark_stability's JSON: how errors grow with the number of elements that light passes.

    benchmarks/stability/plot.py stability.json -o stability.png

Left float, right double. Above the relative error, below the drift of the degree of polarisation (its magnitude, with two standard
errors), both against the number of elements; grey lines are what a random walk (√n) and a drift (n) of half a unit in the last place
would make. A .svg as output gives that. Needs gnuplot.
"""
import argparse
import json
import shutil
import subprocess
import sys

COLOURS = ["#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b"]
EPSILON = {"float": 2.0**-23, "double": 2.0**-52}


def panel(results, precision, column, title, key):
    """gnuplot's commands for one precision and one quantity."""
    data, plots = [], []
    half = EPSILON[precision] / 2
    for power, name in ((0.5, "√n"), (1, "n")):
        plots.append(f'{half}*x**{power} with lines lc rgb "#bbbbbb" lw 1 title "{name}"' if key else
                     f'{half}*x**{power} with lines lc rgb "#bbbbbb" lw 1 notitle')
    for number, result in enumerate(r for r in results if r["precision"] == precision):
        name = f"$d{number}"
        data.append(f"{name} << EOD")
        for point in result["points"]:
            spread = 2 * point["dop_drift_standard_error"] if column == "dop_drift" else 0
            size = abs(point[column])
            if size > 0:
                data.append(f"{point['elements']} {size} {max(size - spread, half / 100)} {size + spread}")
        data.append("EOD")
        title_of = f'title "{result["kind"]}"' if key else "notitle"
        style = f'lc rgb "{COLOURS[number % len(COLOURS)]}" pt 7 ps 0.6'
        plots.append(f"{name} using 1:2 with linespoints {style} {title_of}")
        if column == "dop_drift":
            plots.append(f"{name} using 1:2:3:4 with yerrorbars {style} notitle")
    return data + [f'set title "{title}, {precision}"', f"set yrange [{half / 10}:{half * 1e8}]",
                   "set key top left noenhanced font ',8'" if key else "unset key", "plot " + ", \\\n  ".join(plots)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json", help="benchmark_stability's --json")
    parser.add_argument("-o", "--output", default="stability.png", help="the picture, .png or .svg")
    arguments = parser.parse_args()
    if not shutil.which("gnuplot"):
        sys.exit("plot.py: gnuplot is missing")
    try:
        with open(arguments.json, encoding="utf-8") as file:
            results = json.load(file)
        terminal = ("svg size 1100,900 font 'sans,11'" if arguments.output.endswith(".svg")
                    else "pngcairo size 1100,900 font 'sans,10'")
        lines = [f"set terminal {terminal}", f"set output '{arguments.output}'", "set logscale xy", "set grid lc rgb '#dddddd'",
                 'set format "10^{%L}"', 'set xlabel "elements"', "set multiplot layout 2,2"]
        for column, title in (("relative_error", "relative error"), ("dop_drift", "drift of the degree of polarisation")):
            for precision in ("float", "double"):
                lines += panel(results, precision, column, title, column == "relative_error" and precision == "float")
    except (OSError, ValueError, KeyError, TypeError) as error:
        sys.exit(f"plot.py: {arguments.json}: {error}")
    subprocess.run(["gnuplot"], input="\n".join(lines + ["unset multiplot"]) + "\n", text=True, check=True)
    print(arguments.output)


if __name__ == "__main__":
    main()
