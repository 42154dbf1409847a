#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One plot of benchmark_stability's JSON: how errors grow with the number of elements that light passes.

    benchmarks/stability/plot.py stability.json -o stability.png

Left float, right double. Above the relative error, below the drift of the degree of polarisation (its magnitude, with two standard
errors), both against the number of elements; grey lines are what a random walk (√n) and a drift (n) of half a unit in the last place
would make. A .svg or .pdf as output gives that. Needs gnuplot.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import plotting  # noqa: E402

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
    arguments = plotting.parse(plotting.parser_of(__doc__, "benchmark_stability", "stability.png"))
    with plotting.content_of(arguments.json) as results:
        panels = []
        for column, title in (("relative_error", "relative error"), ("dop_drift", "drift of the degree of polarisation")):
            for precision in ("float", "double"):
                panels += panel(results, precision, column, title, column == "relative_error" and precision == "float")
    commands = ["set logscale xy", "set grid lc rgb '#dddddd'", 'set format "10^{%L}"', 'set xlabel "elements"']
    plotting.draw(arguments.output, (1100, 900), (2, 2), commands, panels)


if __name__ == "__main__":
    main()
