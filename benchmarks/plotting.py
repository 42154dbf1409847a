# SPDX-License-Identifier: MIT
"""What the plots of the benchmarks' JSON share: their arguments, reading, and one picture of panels by gnuplot."""
import argparse
import contextlib
import json
import shutil
import subprocess
import sys


def parser_of(description, program, picture=None):
    """Arguments of a plot of the program's JSON; `picture` is where it goes unless -o says so."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json", help=f"{program}'s --json")
    if picture:
        parser.add_argument("-o", "--output", default=picture, help="the picture, .png, .svg or .pdf")
    return parser


def parse(parser):
    """Ends the program where the plot could not be drawn anyway."""
    arguments = parser.parse_args()
    if not shutil.which("gnuplot"):
        sys.exit("plot.py: gnuplot is missing")
    return arguments


@contextlib.contextmanager
def content_of(path):
    """The file's JSON. What is done with it within `with` may find that it is not what it takes: one line says so."""
    try:
        with open(path, encoding="utf-8") as file:
            content = json.load(file)
        yield content
    except (OSError, ValueError, KeyError, TypeError, IndexError, AttributeError) as error:
        sys.exit(f"plot.py: {path}: {error}")


def terminal_of(path, width, height, points):
    if path.endswith(".svg"):
        return f"svg size {width},{height} font 'sans,11'"
    if path.endswith(".pdf"):
        return f"pdfcairo size {width / 72}in,{height / 72}in font 'sans,10'"
    return f"pngcairo size {width},{height} font 'sans,{points}'"


def draw(path, size, layout, commands, panels, points=10):
    """One picture, its kind by the ending of its name: `commands` before all, `panels` row by row. size: (width, height) in pixels;
    layout: (down, across); points: the font's size in a .png."""
    lines = [f"set terminal {terminal_of(path, *size, points)}", f"set output '{path}'", *commands,
             f"set multiplot layout {layout[0]},{layout[1]}", *panels, "unset multiplot"]
    if subprocess.run(["gnuplot"], input="\n".join(lines) + "\n", text=True, check=False).returncode != 0:
        sys.exit(f"plot.py: {path}: gnuplot failed")
    print(path)
