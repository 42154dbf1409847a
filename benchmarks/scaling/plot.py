#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One plot of benchmark_scaling's JSON: a panel for each dimension.

    benchmarks/scaling/plot.py scaling.json -o scaling.png

Nanoseconds a path over the length of paths, photons and resolution, by logarithms; of threads, paths a second over those of one thread,
beside the ideal. Colours are algorithms, shapes scenes; solid lines are optimized, dashed ones unpolarized. Needs gnuplot.
"""
import argparse
import json
import shutil
import subprocess
import sys

COLOURS = {"path": "#1f77b4", "bdpt": "#2ca02c", "ppm": "#ff7f0e", "vcm": "#d62728"}
SHAPES = [7, 9, 5, 13, 11]
NAMES = {"threads": "threads", "depth": "max_depth", "photons": "photons of a pass", "resolution": "pixels across"}


def panel(number, dimension, rows, scenes):
    """gnuplot's commands for one dimension."""
    series, data, plots = {}, [], []
    for row in rows:
        series.setdefault((row["scene"], row["algorithm"], row["mode"]), []).append(row)
    of_threads = dimension == "threads"
    for i, ((scene, algorithm, mode), mine) in enumerate(series.items()):
        name = f"$d{number}x{i}"
        value = (lambda r: r["ratio"]) if of_threads else (lambda r: r["nanoseconds_per_path"])
        data += [f"{name} << EOD", *(f"{r['value']} {value(r):.5g}" for r in mine), "EOD"]
        style = f'lc rgb "{COLOURS.get(algorithm, "black")}" pt {SHAPES[scenes.index(scene) % len(SHAPES)]} ps 0.7 lw 1.4'
        title = f'title "{scene}, {algorithm}"' if mode == "optimized" else "notitle"
        plots.append(f"{name} using 1:2 with linespoints {style} dt {1 if mode == 'optimized' else 2} {title}")
    ticks = sorted({r["value"] for r in rows})
    commands = [f'set xlabel "{NAMES[dimension]}" noenhanced', "set xtics (" + ", ".join(str(t) for t in ticks) + ")",
                f"set xrange [{ticks[0] / 1.15}:{ticks[-1] * 1.15}]", "set yrange [*:*]"]
    if of_threads:
        commands += ["unset logscale", 'set ylabel "speed, of one thread\'s"', "set yrange [0:*]",
                     f"set xrange [{ticks[0] - 0.2}:{ticks[-1] + 0.2}]", "set key bottom right"]
        plots.insert(0, 'x with lines lc rgb "black" lw 0.7 title "ideal"')
    else:
        # The key stands above the highest line.
        most = max(r["nanoseconds_per_path"] for r in rows)
        least = min(r["nanoseconds_per_path"] for r in rows)
        commands += ["set logscale xy", 'set ylabel "ns a path"', f"set yrange [{least / 1.3}:{most * (2 + len(plots) / 6)}]",
                     "set key top left Left reverse"]
    commands += ["set key samplen 1.5 spacing 0.85 noenhanced font ',8'"]
    return data + commands + ["plot " + ", \\\n  ".join(plots)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json", help="benchmark_scaling's --json")
    parser.add_argument("-o", "--output", default="scaling.png", help="the picture, .png or .svg")
    arguments = parser.parse_args()
    if not shutil.which("gnuplot"):
        sys.exit("plot.py: gnuplot is missing")
    try:
        with open(arguments.json, encoding="utf-8") as file:
            rows = json.load(file)
        dimensions = [d for d in NAMES if any(r["dimension"] == d for r in rows)]
        scenes = list(dict.fromkeys(r["scene"] for r in rows))
        across, down = min(2, len(dimensions)), (len(dimensions) + 1) // 2
        size = f"{520 * across},{400 * down}"
        terminal = f"svg size {size} font 'sans,11'" if arguments.output.endswith(".svg") else f"pngcairo size {size} font 'sans,10'"
        lines = [f"set terminal {terminal}", f"set output '{arguments.output}'", "set grid lc rgb '#dddddd'", 'set format "%g"',
                 f"set multiplot layout {down},{across}"]
        for number, dimension in enumerate(dimensions):
            lines += panel(number, dimension, [r for r in rows if r["dimension"] == dimension], scenes)
    except (OSError, ValueError, KeyError, TypeError, IndexError) as error:
        sys.exit(f"plot.py: {arguments.json}: {error}")
    subprocess.run(["gnuplot"], input="\n".join(lines + ["unset multiplot"]) + "\n", text=True, check=True)
    print(arguments.output)


if __name__ == "__main__":
    main()
