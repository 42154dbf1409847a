#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""One plot of benchmark_scaling's JSON: a panel for each dimension.

    benchmarks/scaling/plot.py scaling.json -o scaling.png

Nanoseconds a path over the length of paths, photons and resolution, by logarithms; of threads, paths a second over those of one thread,
beside the ideal. Colours are algorithms, shapes scenes; solid lines are optimized, dashed ones unpolarized. Needs gnuplot.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import plotting  # noqa: E402

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
    commands = [f'set xlabel "{NAMES[dimension]}" noenhanced', "set xtics (" + ", ".join(f'"{t}" {t}' for t in ticks) + ")",
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
    arguments = plotting.parse(plotting.parser_of(__doc__, "benchmark_scaling", "scaling.png"))
    with plotting.content_of(arguments.json) as rows:
        dimensions = [d for d in NAMES if any(r["dimension"] == d for r in rows)]
        scenes = list(dict.fromkeys(r["scene"] for r in rows))
        panels = []
        for number, dimension in enumerate(dimensions):
            panels += panel(number, dimension, [r for r in rows if r["dimension"] == dimension], scenes)
    across, down = min(2, len(dimensions)), (len(dimensions) + 1) // 2
    plotting.draw(arguments.output, (520 * across, 400 * down), (down, across), ["set grid lc rgb '#dddddd'", 'set format "%g"'],
                  panels)


if __name__ == "__main__":
    main()
