#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plots of benchmark_convergence's JSON: error over time, both by logarithms, one picture a scene.

    benchmarks/convergence/plot.py convergence.json -o FOLDER [--format png|svg] [--quantity S0 S1-S3 DoP]

Colours are algorithms, solid lines "optimized", dashed ones "unpolarized", dotted ones "auto". Bars are one standard error of
the repeats. Points that are not well above the reference's own standard error, which the grey band reaches up to, are hollow.
The thin black line falls by the power -1/2 of time, as errors of what is unbiased do. Needs gnuplot.
"""
import argparse
import json
import math
import os
import shutil
import subprocess
import sys

COLOURS = {"path": "#1f77b4", "ptracer": "#8c564b", "bdpt": "#2ca02c", "ppm": "#ff7f0e", "bpm": "#9467bd", "vcm": "#d62728"}
DASHES = {"optimized": 1, "unpolarized": "'-'", "auto": "'.'"}
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


def panel(scene, rows, reference, quantity, keyed):
    """gnuplot's commands for one quantity."""
    data, plots, seen = [], [], []
    for number, row in enumerate(rows):
        listed = list(points(row, quantity))
        if not listed:
            continue
        seen += listed
        name = "d" + "".join(c for c in quantity if c.isalnum()) + str(number)
        data += block(name, [f"{t} {e} {max(e - s, e / 10)} {e + s}" for t, e, s, _ in listed])
        data += block(name + "h", [f"{t} {e}" for t, e, _, above in listed if not above] or ["NaN NaN"])
        colour, dash = COLOURS.get(row["algorithm"], "black"), DASHES.get(row["variant"], 1)
        plots.append(f'${name} using 1:2 with lines lc rgb "{colour}" dt {dash} lw 1.6 notitle')
        plots.append(f'${name} using 1:2:3:4 with yerrorbars lc rgb "{colour}" pt 7 ps 0.35 lw 1 notitle')
        plots.append(f'${name}h using 1:2 with points lc rgb "white" pt 7 ps 0.25 notitle')
    if not seen:
        return []
    times, errors = [p[0] for p in seen], [p[1] for p in seen]
    x0, x1 = min(times) / 1.5, max(times) * 1.5
    own = reference["standard_error"][quantity]
    y0, y1 = min(errors + ([own] if own > 0 else [])) / 1.5, max(errors) * 1.5
    # From the middle of the first points down.
    start = math.exp(sum(math.log(e) for e in errors) / len(errors)) * math.sqrt(math.sqrt(x1 / x0))
    commands = [f"set xrange [{x0}:{x1}]", f"set yrange [{y0}:{y1}]", f'set title "{scene}: {TITLES[quantity]}" noenhanced']
    commands += ["unset key" if not keyed else "set key bottom left Left reverse samplen 1.5 spacing 0.9 noenhanced"]
    plots.insert(0, f'{start}*sqrt({x0}/x) with lines lc rgb "black" lw 0.7 ' + ('title "power -1/2"' if keyed else "notitle"))
    if own > 0:
        plots.insert(0, f'{own} with filledcurves y1={y0} fc rgb "#e8e8e8" notitle')
    for algorithm in dict.fromkeys(r["algorithm"] for r in rows) if keyed else []:
        plots.append(f'NaN with lines lc rgb "{COLOURS.get(algorithm, "black")}" lw 1.6 title "{algorithm}"')
    return data + commands + ["plot " + ", \\\n  ".join(plots)]


def script(scene, rows, reference, quantities, path, kind):
    panels = []
    for quantity in quantities:
        # A quantity without any error has no logarithm, and no panel.
        if commands := panel(scene, rows, reference, quantity, not panels):
            panels.append(commands)
    if not panels:
        return ""
    width, height = 480 * len(panels), 440
    terminal = {"png": f"pngcairo size {width},{height} font 'sans,10'", "svg": f"svg size {width},{height} font 'sans,11'"}[kind]
    lines = [f"set terminal {terminal}", f"set output '{path}'", "set logscale xy", "set grid lc rgb '#dddddd'",
             'set format "%g"', f"set xtics ({TICS})", f"set ytics ({TICS})", 'set xlabel "seconds"', 'set ylabel "relative error"',
             f"set multiplot layout 1,{len(panels)}"]
    return "\n".join(lines + [line for commands in panels for line in commands] + ["unset multiplot"]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json", help="benchmark_convergence's --json")
    parser.add_argument("-o", "--output", default=".", help="folder of the pictures, <scene>.png")
    parser.add_argument("--format", choices=["png", "svg"], default="png")
    parser.add_argument("--quantity", nargs="+", default=["S0", "S1-S3", "DoP"], choices=sorted(TITLES))
    arguments = parser.parse_args()
    if not shutil.which("gnuplot"):
        sys.exit("plot.py: gnuplot is missing")
    try:
        with open(arguments.json, encoding="utf-8") as file:
            content = json.load(file)
        references = {r["scene"]: r for r in content["references"]}
        rows = content["rows"]
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"plot.py: {arguments.json}: {error}")
    os.makedirs(arguments.output, exist_ok=True)
    for scene in references:
        path = os.path.join(arguments.output, f"{scene}.{arguments.format}")
        of_scene = [row for row in rows if row["scene"] == scene]
        text = script(scene, of_scene, references[scene], arguments.quantity, path, arguments.format)
        if text:
            subprocess.run(["gnuplot"], input=text, text=True, check=True)
            print(path)


if __name__ == "__main__":
    main()
