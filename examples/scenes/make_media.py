#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the meshes and the cloud of the scenes with media into the folder media beside this file, and prints their sizes.

    jar_glass, jar_wall, jar_surface   sugar_jar.xml: glass to air, syrup to glass, syrup to air; decimetres
    wedge, lens                        photoelastic.xml: millimetres
    tube                               fog_lamp.xml: the inside of a searchlight; metres
    cloud.vol                          cloud.xml: the density of a cloud of smoke, in three channels

Python's standard library is enough. Coordinates are rounded, and random numbers are made here, so that the files are the same
bytes on any machine.
"""
import math
import os
import struct
import sys

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "bathroom"))

import meshes  # noqa: E402
from meshes import Mesh, Random, at, convex, grid, revolve, rounded  # noqa: E402

meshes.FOLDER = os.path.join(HERE, "media")
meshes.WRITER = "make_media.py"


def turned(corners, radius, steps):
    return [(r, z) for r, _, z in rounded([(r, 0.0, z) for r, z in corners], radius, steps)]


def jar():
    """A jar 1.6 across and 2.3 high with walls of 0.05, filled to 1.75. Glass and syrup meet in one surface."""
    level, wall = 1.75, 0.05
    outside = turned([(0.0, 0.0), (0.8, 0.0), (0.8, 2.0), (0.62, 2.15), (0.62, 2.3), (0.57, 2.3)], 0.02, 4)
    neck = turned([(0.57, 2.3), (0.57, 2.14), (0.8 - wall, 1.98), (0.8 - wall, level)], 0.02, 4)
    inside = turned([(0.0, 0.08), (0.8 - wall, 0.08), (0.8 - wall, level)], 0.03, 4)
    glass, syrup = Mesh("jar_glass"), Mesh("jar_wall")
    revolve(glass, outside + neck[1:], at(0, 0, 0), 96)
    revolve(syrup, inside, at(0, 0, 0), 96)
    surface = Mesh("jar_surface")
    revolve(surface, [(0.8 - wall, level), (0.0, level)], at(0, 0, 0), 96)
    closed = Mesh("jar_glass and jar_wall", closed=True)
    revolve(closed, outside + neck[1:] + inside[::-1][1:], at(0, 0, 0), 96)
    closed.check_closed()
    return [glass, syrup, surface]


def wedge():
    """From no thickness at the left to 8 at the right, 64 long and 14 high; its back is y = 0."""
    mesh = Mesh("wedge", closed=True, faceted=True)
    points = [(-32.0, 0.0, z) for z in (-7.0, 7.0)] + [(32.0, y, z) for y in (-8.0, 0.0) for z in (-7.0, 7.0)]
    convex(mesh, points, [[0, 2, 3, 1], [0, 1, 5, 4], [2, 4, 5, 3], [0, 4, 2], [1, 3, 5]])
    return [mesh]


def lens():
    """Flat at y = 0, and a part of a sphere towards -y: 40 across, 5 thick in the middle, without an edge."""
    mesh = Mesh("lens", closed=True)
    across, thick, rings = 20.0, 5.0, 20
    radius = (across * across + thick * thick) / (2 * thick)
    most = math.asin(across / radius)
    angles = [most * (1 - i / rings) for i in range(rings + 1)]
    cap = [(radius * math.sin(a), radius * math.cos(a) - radius + thick) for a in angles]
    cap[0], cap[-1] = (across, 0.0), (0.0, thick)
    revolve(mesh, [(0.0, 0.0), (across, 0.0)] + cap[1:], lambda p: (p[0], -p[2], p[1]), 96)
    return [mesh]


def tube():
    """The black inside of a tube along z, open in front: 0.3 across and 1.6 long."""
    mesh = Mesh("tube")
    grid(mesh, [[(0.15 * math.cos(t), -0.15 * math.sin(t), z) for t in (2 * math.pi * j / 32 for j in range(32))] for z in (0.0, 1.6)])
    return [mesh]


def cloud():
    """Three octaves of noise within a flat ellipsoid, heaped above and flat below: cells of a box of 2 : 1.25 : 1.25. The
    density is times the inverse fourth power of 0.61, 0.55 and 0.465 micrometres, green's being 1."""
    size = (32, 20, 20)
    random = Random(11)
    lattice = [[[random() for _ in range(24)] for _ in range(24)] for _ in range(24)]

    def noise(p, frequency):
        cell = [math.floor(c * frequency) for c in p]
        t = [c * frequency - k for c, k in zip(p, cell)]
        t = [s * s * (3 - 2 * s) for s in t]
        value = 0.0
        for corner in range(8):
            bits = [corner >> i & 1 for i in range(3)]
            weight = math.prod(s if b else 1 - s for s, b in zip(t, bits))
            i, j, k = [(c + b) % 24 for c, b in zip(cell, bits)]
            value += weight * lattice[i][j][k]
        return value

    channels = [(0.55 / wavelength) ** 4 for wavelength in (0.61, 0.55, 0.465)]
    values = []
    for k in range(size[2]):
        for j in range(size[1]):
            for i in range(size[0]):
                p = [2 * (c + 0.5) / n - 1 for c, n in zip((i, j, k), size)]
                z = (p[2] + 0.25) / (0.85 if p[2] > -0.25 else 0.4)
                edge = 1 - math.sqrt((p[0] / 0.8) ** 2 + (p[1] / 0.8) ** 2 + z * z)
                q = [1.6 * p[0], p[1], p[2]]
                rough = 0.9 * noise([c + 3 for c in q], 1.5) + 0.5 * noise([c + 5 for c in q], 3.0) + 0.25 * noise([c + 7 for c in q], 6.0)
                density = max(0.0, min(1.0, 2.2 * (edge + 0.9 * (rough - 0.83))))
                if min(i, j, k) == 0 or any(c == n - 1 for c, n in zip((i, j, k), size)):
                    density = 0.0
                values += [round(density * c, 4) for c in channels]
    data = b"VOL" + struct.pack("<B5i6f", 3, 1, *size, 3, 0, 0, 0, 1, 1, 1) + struct.pack("<%df" % len(values), *values)
    with open(os.path.join(meshes.FOLDER, "cloud.vol"), "wb") as file:
        file.write(data)
    return len(data)


def main():
    os.makedirs(meshes.FOLDER, exist_ok=True)
    for mesh in jar() + wedge() + lens() + tube():
        print("%-15s %7d triangles %9d bytes" % (mesh.name, len(mesh.faces), mesh.write()))
    print("%-15s %27d bytes" % ("cloud.vol", cloud()))


if __name__ == "__main__":
    main()
