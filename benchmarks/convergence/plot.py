#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plots of benchmark_convergence's JSON: error over time, both by logarithms.

    benchmarks/convergence/plot.py convergence.json -o FOLDER [--format png|svg] [--quantity S0 S1-S3 DoP]
    benchmarks/convergence/plot.py convergence.json --overview overview.png --quantity S0 --variant optimized

One picture a scene, a panel a quantity; or, with --overview, one picture with a panel for every scene. Colours are algorithms, solid
lines "optimized", dashed ones "unpolarized", dashed and dotted ones "naive", dotted ones "auto"; of several samplers, filled circles are the first one's and triangles
the second's. Bars are one standard error of the repeats. Points that are not well above the reference's own standard error, which the
grey band reaches up to, are hollow. The thin black line falls by the power -1/2 of time, as errors of what is unbiased do; the numbers in
the key are the slopes of the lines. Needs gnuplot.
"""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import plotting  # noqa: E402

COLOURS = {"path": "#1f77b4", "ptracer": "#8c564b", "bdpt": "#2ca02c", "ppm": "#ff7f0e", "bpm": "#9467bd", "vcm": "#d62728"}
DASHES = {"optimized": 1, "unpolarized": "'-'", "naive": "'-.'", "auto": "'.'"}
SHAPES = [7, 9, 5]
TITLES = {"S0": "S0", "S1": "S1", "S2": "S2", "S3": "S3", "S1-S3": "S1 to S3", "DoP": "degree of polarisation"}

TICS = ", ".join(f"{digit}e{power}" for power in range(-5, 5) for digit in (1, 2, 5))


def points(row, quantity):
    """(seconds, error, spread, above the reference) of every point with an error above zero."""
    for p in row["points"]:
        error = p["relative_error"][quantity]
        if error > 0 and p["seconds"] > 0:
            yield p["seconds"], error, p["relative_error_spread"][quantity], p["above_reference"][quantity]


def block(name, lines):
    return [f"${name} << EOD", *lines, "EOD"]


def key_of(row, quantity, several_samplers):
    slope = row["slopes"].get(quantity)
    name = row["algorithm"] + (", " + row["sampler"] if several_samplers else "")
    return name + (f" {slope['slope']:.2f}" if slope else "")


def panel(number, title, rows, reference, quantity):
    """gnuplot's commands for one quantity of one scene."""
    samplers = list(dict.fromkeys(r.get("sampler", "") for r in rows))
    # Of the slopes those of the first variant stand in the key.
    first = rows[0]["variant"] if rows else ""
    if any(r["variant"] == "optimized" for r in rows):
        first = "optimized"
    data, plots, keys, seen = [], [], [], []
    for i, row in enumerate(rows):
        listed = list(points(row, quantity))
        if not listed:
            continue
        seen += listed
        name = f"d{number}x{i}"
        data += block(name, [f"{t:.4g} {e:.4g} {max(e - s, e / 10):.4g} {e + s:.4g}" for t, e, s, _ in listed])
        data += block(name + "h", [f"{t:.4g} {e:.4g}" for t, e, _, above in listed if not above] or ["NaN NaN"])
        colour, dash = COLOURS.get(row["algorithm"], "black"), DASHES.get(row["variant"], 1)
        shape = SHAPES[min(samplers.index(row.get("sampler", "")), 2)]
        plots.append(f'${name} using 1:2 with lines lc rgb "{colour}" dt {dash} lw 1.6 notitle')
        plots.append(f'${name} using 1:2:3:4 with yerrorbars lc rgb "{colour}" pt 0 lw 1 notitle')
        plots.append(f'${name} using 1:2 with points lc rgb "{colour}" pt {shape} ps 0.7 notitle')
        plots.append(f'${name}h using 1:2 with points lc rgb "white" pt {shape} ps 0.4 notitle')
        if row["variant"] == first:
            keys.append(f'NaN with linespoints lc rgb "{colour}" pt {shape} ps 0.7 lw 1.6 title '
                        f'"{key_of(row, quantity, len(samplers) > 1)}"')
    if not seen:
        return []
    times, errors = [p[0] for p in seen], [p[1] for p in seen]
    x0, x1 = min(times) / 1.5, max(times) * 1.5
    own = reference["standard_error"][quantity]
    # Room for the key.
    y0, y1 = min(errors + ([own] if own > 0 else [])) / (1.6 + 0.25 * len(keys)), max(errors) * 1.5
    # From the middle of the first points down.
    start = math.exp(sum(math.log(e) for e in errors) / len(errors)) * math.sqrt(math.sqrt(x1 / x0))
    commands = [f"set xrange [{x0}:{x1}]", f"set yrange [{y0}:{y1}]", f'set title "{title}" noenhanced',
                "set key bottom left Left reverse samplen 1.2 spacing 0.85 noenhanced font ',8'"]
    plots.insert(0, f'{start}*sqrt({x0}/x) with lines lc rgb "black" lw 0.7 notitle')
    if own > 0:
        plots.insert(0, f'{own} with filledcurves y1={y0} fc rgb "#e8e8e8" notitle')
    return data + commands + ["plot " + ", \\\n  ".join(plots + keys)]


def draw(panels, across, path):
    """Panels without anything to show are left out."""
    panels = [p for p in panels if p]
    if not panels:
        return
    across = min(across, len(panels))
    down = (len(panels) + across - 1) // across
    commands = ["set logscale xy", "set grid lc rgb '#dddddd'", 'set format "%g"', f"set xtics ({TICS})", f"set ytics ({TICS})",
                'set xlabel "seconds"', 'set ylabel "relative error"']
    plotting.draw(path, (400 * across, 380 * down), (down, across), commands, [line for p in panels for line in p], points=9)


def main():
    parser = plotting.parser_of(__doc__, "benchmark_convergence")
    parser.add_argument("-o", "--output", default=".", help="folder of the pictures, <scene>.png")
    parser.add_argument("--overview", metavar="FILE", help="one picture of all scenes instead, of the first quantity")
    parser.add_argument("--format", choices=["png", "svg"], default="png")
    parser.add_argument("--quantity", nargs="+", default=["S0", "S1-S3", "DoP"], choices=sorted(TITLES))
    parser.add_argument("--variant", nargs="+", help="these alone")
    parser.add_argument("--sampler", nargs="+", help="these alone")
    arguments = plotting.parse(parser)
    number, panels = 0, {}
    with plotting.content_of(arguments.json) as content:
        references = {r["scene"]: r for r in content["references"]}
        rows = [r for r in content["rows"] if (not arguments.variant or r["variant"] in arguments.variant)
                and (not arguments.sampler or r.get("sampler") in arguments.sampler)]
        for scene, reference in references.items():
            for quantity in arguments.quantity[:1] if arguments.overview else arguments.quantity:
                of_scene = [row for row in rows if row["scene"] == scene]
                panels.setdefault(scene, []).append(panel(number, f"{scene}: {TITLES[quantity]}", of_scene, reference, quantity))
                number += 1
    if arguments.overview:
        return draw([p for of_scene in panels.values() for p in of_scene], 4, arguments.overview)
    os.makedirs(arguments.output, exist_ok=True)
    for scene, of_scene in panels.items():
        draw(of_scene, len(of_scene), os.path.join(arguments.output, f"{scene}.{arguments.format}"))


if __name__ == "__main__":
    main()
