#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the meshes and textures of bathroom.xml into the folder bathroom beside this file, and prints their sizes.

Lengths are metres; x goes right, y to the back wall, z up. The room is x 0..3.2, y 0..3.6, z 0..2.6: a tub below the window
on the left, a basin on a cabinet below the mirror at the back, a toilet on the right, a door in the front, behind the camera.
The Python files in the folder are parts of this program. Python's standard library is enough. Coordinates are rounded, random
numbers are made here and images are stored without compression, so that the files are the same bytes on any machine.
"""
import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "bathroom"))

import furniture  # noqa: E402
import room  # noqa: E402
from meshes import Mesh, Random, image  # noqa: E402


def wood_texture(width, height):
    """Planks' grain along x, the same at opposite edges."""
    random = Random(7)
    lattice = [[random() for _ in range(32)] for _ in range(64)]

    def noise(x, y, nx, ny):
        i, j = math.floor(x), math.floor(y)
        s, t = x - i, y - j
        s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
        corner = [[lattice[(j + b) % ny][(i + a) % nx] for a in (0, 1)] for b in (0, 1)]
        return (corner[0][0] * (1 - s) + corner[0][1] * s) * (1 - t) + (corner[1][0] * (1 - s) + corner[1][1] * s) * t

    def color(x, y):
        u, v = x / width, y / height
        rings = noise(4 * u, 8 * v, 4, 8) * 7 + 0.6 * noise(8 * u, 32 * v, 8, 32)
        band = 0.5 + 0.5 * math.sin(2 * math.pi * rings)
        pores = noise(16 * u, 64 * v, 16, 64)
        tone = 0.74 + 0.2 * band - 0.16 * pores * pores
        return [max(0, min(255, math.floor(c * tone + 0.5))) for c in (188, 134, 84)]

    return color


def palette(middle, spread, seed, last=None):
    random = Random(seed)
    colors = [[round(c + random(-spread, spread)) for c in middle] for _ in range(8)]
    if last:
        colors[7] = last
    return lambda x, y: colors[x]


def main():
    closed = ("basin_water", "tub_water", "pane", "shelf", "flask", "tumbler")
    textured = ("wall_tiles", "floor_tiles", "wood")
    names = ["plaster", "grout", "wall_tiles", "floor_tiles", "trim", "painted", "door", "stone", "wood", "ceramic", "seat"]
    names += ["chrome", "steel", "mirror", "pane", "shelf", "flask", "tumbler", "cork", "basin_water", "tub_water", "towel", "mat"]
    names += ["curtains", "plastic_white", "plastic_green", "plastic_blue", "plastic_amber", "plastic_yellow", "plastic_orange"]
    names += ["soap", "pot", "soil", "leaves"]
    faceted = ("wall_tiles", "floor_tiles")
    m = {name: Mesh(name, name in textured, name in closed, name in faceted) for name in names}
    room.walls(m["plaster"])
    room.grout(m["grout"])
    room.wall_tiles(m["wall_tiles"], Random(1))
    room.floor_tiles(m["floor_tiles"], Random(2))
    room.trim(m["trim"])
    room.window(m["painted"], m["pane"], m["stone"])
    room.door(m["door"], m["painted"], m["chrome"])
    room.tub(m["ceramic"], m["tub_water"], m["chrome"])
    room.basin(m["ceramic"], m["basin_water"], m["chrome"])
    room.toy(m["plastic_yellow"], m["plastic_orange"])
    furniture.vanity(m["wood"], m["stone"], m["chrome"])
    furniture.mirror(m["mirror"], m["wood"])
    furniture.shelf(m["shelf"], m["chrome"])
    furniture.shelf_things(m)
    furniture.cabinet_things(m)
    furniture.toilet(m["ceramic"], m["seat"], m["chrome"])
    furniture.towel_rail(m["steel"])
    furniture.towel(m["towel"])
    furniture.mat(m["mat"])
    furniture.curtains(m["curtains"], m["wood"], Random(3))
    furniture.plant(m["pot"], m["soil"], m["leaves"], Random(4))
    furniture.lamps(m["chrome"])
    total = [0, 0]
    for name in names:
        size, triangles = m[name].write(), len(m[name].faces)
        print("%-15s %7d triangles %9d bytes" % (name, triangles, size))
        total = [total[0] + triangles, total[1] + size]
    total[1] += image("wood.png", 256, 256, wood_texture(256, 256))
    total[1] += image("wall_tiles.png", 8, 1, palette((122, 168, 158), 8, 5))
    total[1] += image("floor_tiles.png", 8, 1, palette((205, 202, 194), 8, 6, [52, 66, 68]))
    print("%-15s %7d triangles %9d bytes" % ("all", *total))


if __name__ == "__main__":
    main()
