# SPDX-License-Identifier: MIT
"""The room of make_bathroom.py: walls, tiles, window, door, tub and basin, and their water."""
import math

from meshes import add, at, ball, block, frame, grid, loft, mix, quad, revolve, rounded, spline, superellipse, tube

WIDTH, DEPTH, HEIGHT = 3.2, 3.6, 2.6
TILED = 1.2  # the walls are tiled up to here
GROUT, TILE = 0.004, 0.006  # heights of grout and of tiles above the wall
BACK = DEPTH - TILE
WINDOW = (2.2, 3.2, 1.25, 2.2)  # y and z of the opening in the left wall
DOOR = (0.45, 1.35, 2.08)  # x and z of the opening in the front wall
VANITY = 1.55  # x of the middle of basin, mirror and lamps


def walls(mesh):
    """Plaster: the walls with the window's opening, the ceiling and a cornice."""
    x, y, z, low = WIDTH, DEPTH, HEIGHT, -0.01
    quad(mesh, (0, y, low), (x, y, low), (x, y, z), (0, y, z))
    quad(mesh, (x, y, low), (x, 0, low), (x, 0, z), (x, y, z))
    quad(mesh, (x, 0, low), (0, 0, low), (0, 0, z), (x, 0, z))
    quad(mesh, (0, 0, z), (0, y, z), (x, y, z), (x, 0, z))
    y0, y1, z0, z1 = WINDOW
    for a, b, c, d in ((0, y0, low, z), (y1, y, low, z), (y0, y1, low, z0), (y0, y1, z1, z)):
        quad(mesh, (0, a, c), (0, b, c), (0, b, d), (0, a, d))
    corners = ((y0, z0), (y1, z0), (y1, z1), (y0, z1))
    for (a, c), (b, d) in zip(corners, corners[1:] + corners[:1]):
        quad(mesh, (0, b, d), (-0.25, b, d), (-0.25, a, c), (0, a, c))
    profile = [(0.0, 0.11), (0.012, 0.11), (0.012, 0.1)]
    profile += [(0.012 + 0.04 * (1 - math.cos(t)), 0.1 - 0.045 * math.sin(t)) for t in (math.pi / 16 * k for k in range(1, 9))]
    profile += [(0.06, 0.055), (0.06, 0.05)]
    profile += [(0.06 + 0.04 * math.sin(t), 0.01 + 0.04 * math.cos(t)) for t in (math.pi / 16 * k for k in range(1, 9))]
    profile += [(0.11, 0.01), (0.11, 0.0)]
    sides = [((0, y), (x, y), (0, -1)), ((x, y), (x, 0), (-1, 0)), ((x, 0), (0, 0), (0, 1)), ((0, 0), (0, y), (1, 0))]
    for a, b, inward in sides:
        rows = []
        for out, down in profile:
            row = []
            for end, sign in ((a, out), (b, -out)):  # mitred
                along = [sign * (b[i] - a[i]) / math.dist(a, b) for i in range(2)]
                row.append((end[0] + out * inward[0] + along[0], end[1] + out * inward[1] + along[1], z - down))
            rows.append(row)
        grid(mesh, rows, wrap=False, crease=25.0)


def grout(mesh):
    g, x, y, h = GROUT, WIDTH, DEPTH, TILED
    quad(mesh, (0, 0, -0.002), (x, 0, -0.002), (x, y, -0.002), (0, y, -0.002))
    quad(mesh, (0, y - g, -0.01), (x, y - g, -0.01), (x, y - g, h), (0, y - g, h))
    quad(mesh, (x - g, y, -0.01), (x - g, 0, -0.01), (x - g, 0, h), (x - g, y, h))
    quad(mesh, (g, 0, -0.01), (g, y, -0.01), (g, y, h), (g, 0, h))
    quad(mesh, (x, g, -0.01), (DOOR[1], g, -0.01), (DOOR[1], g, h), (x, g, h))
    quad(mesh, (DOOR[0], g, -0.01), (0, g, -0.01), (0, g, h), (DOOR[0], g, h))


def tile(mesh, outline, place, uv, random, bevel=0.002, top=TILE, bottom=GROUT - 0.0005):
    """A polygonal tile with bevelled edges, laid by hand: a little askew."""
    n = len(outline)
    middle = tuple(sum(p[i] for p in outline) / n for i in range(2))
    tilt = (random(-0.004, 0.004), random(-0.004, 0.004))
    edges = []
    for p, q in zip(outline, outline[1:] + outline[:1]):
        length = math.dist(p, q)
        edges.append(((q[1] - p[1]) / length, (p[0] - q[0]) / length))
    inner, outer = [], []
    for p, before, after in zip(outline, edges[-1:] + edges[:-1], edges):
        out = (before[0] + after[0], before[1] + after[1])
        size = math.hypot(*out)
        out, half = (out[0] / size, out[1] / size), size / 2  # half: cosine of half the angle between the edges
        q = (p[0] - bevel / half * out[0], p[1] - bevel / half * out[1])
        height = top + tilt[0] * (q[0] - middle[0]) + tilt[1] * (q[1] - middle[1])
        inner.append(mesh.vertex(place((q[0], q[1], height)), None, uv))
        outer.append(mesh.vertex(place((p[0], p[1], bottom)), None, uv))
    for i in range(1, n - 1):
        mesh.face(inner[0], inner[i], inner[i + 1])
    for i in range(n):
        k = (i + 1) % n
        mesh.face(inner[i], outer[i], outer[k])
        mesh.face(inner[i], outer[k], inner[k])


def wall_tiles(mesh, random):
    """Running bond, 15 cm by 7.5 cm, cut where a wall ends."""
    size, gap, rows = (0.15, 0.075), 0.0025, round(TILED / 0.075)
    walls_ = [
        (frame((0, DEPTH, 0), (1, 0, 0), (0, 0, 1)), 0.0, WIDTH),
        (frame((WIDTH, DEPTH, 0), (0, -1, 0), (0, 0, 1)), 0.0, DEPTH),
        (frame((0, 0, 0), (0, 1, 0), (0, 0, 1)), 0.0, DEPTH),
        (frame((WIDTH, 0, 0), (-1, 0, 0), (0, 0, 1)), 0.0, WIDTH - DOOR[1]),
        (frame((WIDTH, 0, 0), (-1, 0, 0), (0, 0, 1)), WIDTH - DOOR[0], WIDTH),
    ]
    for place, start, end in walls_:
        for row in range(rows):
            for k in range(-1, int(end / size[0]) + 2):
                a = max(start, (k + 0.5 * (row % 2)) * size[0]) + gap / 2
                b = min(end, (k + 1 + 0.5 * (row % 2)) * size[0]) - gap / 2
                if b - a > 0.01:
                    c, d = row * size[1] + gap / 2, (row + 1) * size[1] - gap / 2
                    tint = (int(random(0, 8)) + 0.5) / 8
                    tile(mesh, [(a, c), (b, c), (b, d), (a, d)], place, (tint, 0.5), random)


def floor_tiles(mesh, random):
    """Hexagons 12 cm wide; now and then one is dark."""
    width, gap = 0.12, 0.003
    radius, step = (width - gap) / math.sqrt(3), width * math.sqrt(3) / 2
    for row in range(int(DEPTH / step) + 2):
        for k in range(int(WIDTH / width) + 2):
            x, y = (k + 0.5 * (row % 2)) * width, row * step
            outline = [(x + radius * math.sin(t), y - radius * math.cos(t)) for t in (math.pi / 3 * i for i in range(6))]
            dark = row % 6 == 3 and k % 3 == (row // 6) % 3
            tint = ((7 if dark else int(random(0, 7))) + 0.5) / 8
            tile(mesh, outline, at(0, 0, 0), (tint, 0.5), random, top=0.0, bottom=-0.0025)


def trim(mesh):
    """A rounded strip closes the tiles at the top."""
    profile = [(0.006 + 0.01 * math.sin(t), 0.01 - 0.01 * math.cos(t)) for t in (math.pi / 8 * k for k in range(9))]
    profile = [(0.0, 0.0)] + profile + [(0.0, 0.02)]
    x, y, z = WIDTH, DEPTH, TILED
    front = [((x, 0), (DOOR[1], 0), (0, 1)), ((DOOR[0], 0), (0, 0), (0, 1))]
    for a, b, inward in [((0, y), (x, y), (0, -1)), ((x, y), (x, 0), (-1, 0)), ((0, 0), (0, y), (1, 0))] + front:
        grid(mesh, [[(p[0] + out * inward[0], p[1] + out * inward[1], z + up) for p in (a, b)] for out, up in profile], wrap=False)


def window(painted, pane, stone):
    y0, y1, z0, z1 = WINDOW
    back, front, bar = -0.16, -0.1, 0.05
    e = 0.002  # the frame reaches into the wall
    block(painted, (back, y0 - e, z0 - e), (front, y0 + bar, z1 + e), 0.006)
    block(painted, (back, y1 - bar, z0 - e), (front, y1 + e, z1 + e), 0.006)
    block(painted, (back, y0 + bar - e, z0 - e), (front, y1 - bar + e, z0 + bar), 0.006)
    block(painted, (back, y0 + bar - e, z1 - bar), (front, y1 - bar + e, z1 + e), 0.006)
    middle, transom = (y0 + y1) / 2, z0 + 0.68 * (z1 - z0)
    block(painted, (back + 0.01, middle - 0.017, z0 + bar - e), (front - 0.01, middle + 0.017, z1 - bar + e), 0.006)
    for a, b in ((y0 + bar, middle - 0.017), (middle + 0.017, y1 - bar)):
        block(painted, (back + 0.01, a - e, transom - 0.017), (front - 0.01, b + e, transom + 0.017), 0.006)
    block(pane, (-0.133, y0 + bar - 0.008, z0 + bar - 0.008), (-0.127, y1 - bar + 0.008, z1 - bar + 0.008), 0.001)
    block(stone, (front - 0.02, y0 - 0.06, z0 - 0.012), (0.045, y1 + 0.06, z0 + 0.012), 0.005)


def door(leaf, painted, chrome):
    a, b, top = DOOR
    for left, right, bottom in ((a - 0.08, a, 0.0), (b, b + 0.08, 0.0), (a - 0.003, b + 0.003, top)):
        block(painted, (left, -0.02, bottom), (right, 0.02, top + 0.08), 0.006)
    block(leaf, (a + 0.003, -0.03, 0.004), (b - 0.003, 0.006, top - 0.003), 0.003)
    middle = (a + b) / 2
    for low, high in ((0.15, 0.85), (0.98, top - 0.15)):
        for left, right in ((a + 0.11, middle - 0.04), (middle + 0.04, b - 0.11)):
            block(leaf, (left, -0.025, low), (right, 0.018, high), 0.014)
            block(leaf, (left + 0.035, -0.02, low + 0.035), (right - 0.035, 0.024, high - 0.035), 0.012)
    place = frame((b - 0.07, 0.006, 1.0), (1, 0, 0), (0, 0, -1))
    revolve(chrome, [(0.028, 0.0), (0.028, 0.004), (0.024, 0.008), (0.0, 0.008)], place, 32)
    tube(chrome, rounded([(b - 0.07, 0.01, 1.0), (b - 0.07, 0.055, 1.0), (b - 0.19, 0.055, 1.0)], 0.012), 0.008)


# Bath, basin and their water -----------------------------------------------------------------------------------------

TUB_AT, TUB_LEVEL, TUB_EXPONENT = at(0.5, 2.6, 0.0), 0.42, 2.6
TUB_OUTSIDE = [(0.27, 0.66, 0.0), (0.285, 0.685, 0.03), (0.325, 0.76, 0.2), (0.357, 0.815, 0.4), (0.378, 0.843, 0.54)]
TUB_RIM = [(0.394, 0.862, 0.572), (0.388, 0.856, 0.594), (0.367, 0.834, 0.595)]
TUB_INSIDE = [(0.35, 0.81, 0.572), (0.337, 0.785, 0.45), (0.315, 0.74, 0.3), (0.285, 0.69, 0.2), (0.23, 0.6, 0.137)]
TUB_INSIDE += [(0.12, 0.36, 0.118), (0.0, 0.0, 0.115)]

BASIN_AT, BASIN_LEVEL, BASIN_EXPONENT = at(VANITY, 3.315, 0.8405), 0.085, 2.3
BASIN_OUTSIDE = [(0.1, 0.075, 0.0), (0.125, 0.095, 0.004), (0.19, 0.14, 0.045), (0.232, 0.172, 0.105)]
BASIN_RIM = [(0.244, 0.182, 0.13), (0.242, 0.18, 0.138), (0.233, 0.172, 0.139)]
BASIN_INSIDE = [(0.226, 0.166, 0.13), (0.205, 0.15, 0.09), (0.165, 0.12, 0.047), (0.1, 0.07, 0.027), (0.04, 0.03, 0.022), (0, 0, 0.021)]


def vessel(mesh, outside, rim, inside, place, exponent, count, steps):
    loft(mesh, spline(outside + rim + inside, steps), place, exponent, count)


def water(mesh, outside, rim, inside, place, exponent, level, overlap, waves, rings, count):
    """What fills a vessel: its surface has waves, its sides and bottom lie inside the ceramic by `overlap`, so that between
    the water and the ceramic there is no air and no surface coincides with another."""
    curve = spline(outside + rim + inside, 5)
    curve = curve[(len(outside) + len(rim)) * 5 :]
    sections = []
    for above, below in zip(curve, curve[1:]):
        if above[2] > level >= below[2]:
            sections.append(mix(above, below, (above[2] - level) / (above[2] - below[2])))
        if below[2] < level and below[0] > 0:
            sections.append(below)
    wetted = [(0.0, 0.0, curve[-1][2] - overlap)]
    wetted += [(a + overlap, b + overlap, z - overlap) for a, b, z in reversed(sections[1:])]
    rows = [[(u, v, z) for u, v in superellipse(a, b, exponent, count)] for a, b, z in wetted]
    edge = [(u, v, level) for u, v in superellipse(sections[0][0] + overlap, sections[0][1] + overlap, exponent, count)]
    for k in range(rings + 1):
        s = 1 - k / rings
        rows.append([(u * s, v * s, level + waves(u * s, v * s)) for u, v, _ in edge])
    grid(mesh, [[place(p) for p in row] for row in rows])


def tub(ceramic, surface, chrome):
    vessel(ceramic, TUB_OUTSIDE, TUB_RIM, TUB_INSIDE, TUB_AT, TUB_EXPONENT, 88, 3)

    def waves(x, y):
        r = math.hypot(x - 0.12, y + 0.3)  # around the toy, and a few long ones
        return 0.0016 * math.cos(75 * r) * math.exp(-3 * r) + 0.0007 * math.sin(31 * x + 17 * y) + 0.0006 * math.sin(14 * x - 37 * y + 1)

    water(surface, TUB_OUTSIDE, TUB_RIM, TUB_INSIDE, TUB_AT, TUB_EXPONENT, TUB_LEVEL, 0.008, waves, 38, 80)
    # A tap that stands on the floor, with its handle, and the overflow's cap.
    x, y = 1.02, 2.45
    revolve(chrome, [(0.05, 0.0005), (0.05, 0.01), (0.046, 0.016), (0.03, 0.022), (0.024, 0.03)], at(x, y, 0), 40)
    tube(chrome, rounded([(x, y, 0.01), (x, y, 0.9), (x - 0.27, y, 0.9), (x - 0.27, y, 0.77)], 0.1, 9), 0.019, 24)
    revolve(chrome, [(0.019, 0.7), (0.03, 0.704), (0.03, 0.76), (0.019, 0.764)], at(x, y, 0), 32)
    tube(chrome, [(x, y - 0.09, 0.732), (x, y, 0.732), (x, y + 0.09, 0.732)], 0.009)
    for side in (-0.1, 0.1):
        knob = [(0.0, -0.014), (0.017, -0.012), (0.02, 0.0), (0.017, 0.012), (0.0, 0.014)]
        revolve(chrome, knob, frame((x, y + side, 0.732), (1, 0, 0), (0, 0, -1)), 24)
    place = frame((0.5, 3.405, 0.5), (1, 0, 0), (0, 0.2, 0.98))
    revolve(chrome, [(0.035, -0.006), (0.035, 0.004), (0.03, 0.009), (0.0, 0.011)], place, 32)


def basin(ceramic, surface, chrome):
    vessel(ceramic, BASIN_OUTSIDE, BASIN_RIM, BASIN_INSIDE, BASIN_AT, BASIN_EXPONENT, 80, 3)

    def waves(x, y):
        r = math.hypot(x, y - 0.085)  # a drop fell from the tap
        return 0.0008 * math.cos(190 * r) * math.exp(-9 * r) + 0.0002 * math.sin(70 * x + 40 * y)

    water(surface, BASIN_OUTSIDE, BASIN_RIM, BASIN_INSIDE, BASIN_AT, BASIN_EXPONENT, BASIN_LEVEL, 0.004, waves, 40, 72)
    revolve(chrome, [(0.022, 0.018), (0.022, 0.0235), (0.019, 0.0255), (0.0, 0.0265)], BASIN_AT, 32)
    x, y, z = VANITY, 3.54, 0.84
    revolve(chrome, [(0.028, z - 0.001), (0.028, z + 0.006), (0.024, z + 0.01), (0.017, z + 0.014)], at(x, y, 0), 40)
    tube(chrome, rounded([(x, y, z), (x, y, 1.075), (x, 3.415, 1.075), (x, 3.415, 1.0)], 0.055, 9), 0.0125, 22)
    tube(chrome, [(x + 0.008, y, z + 0.07), (x + 0.03, y, z + 0.07), (x + 0.05, y, z + 0.07)], 0.011)
    tube(chrome, [(x + 0.04, y, z + 0.07), (x + 0.045, y - 0.02, z + 0.1), (x + 0.05, y - 0.04, z + 0.13)], 0.0045)


def toy(yellow, orange):
    """A duck on the bath's water."""
    x, y, z = 0.62, 2.3, TUB_LEVEL + 0.018
    turn = math.radians(-60)
    place = frame((x, y, z), (math.cos(turn), math.sin(turn), 0), (-math.sin(turn), math.cos(turn), 0))
    body = [(0, 0, -0.035, 0), (0.035, 0.028, -0.03, 0), (0.055, 0.042, -0.005, -0.003), (0.05, 0.04, 0.015, -0.006)]
    loft(yellow, spline(body + [(0.03, 0.026, 0.027, -0.012), (0, 0, 0.029, -0.02)], 5), place, 2.0, 36)
    ball(yellow, (0.03, 0.028, 0.028), lambda p: place(add(p, (0.028, 0, 0.05))), 32)
    ball(yellow, (0.028, 0.02, 0.012), lambda p: place((p[0] - 0.052 - 0.2 * p[2], p[1], p[2] + 0.016 - 0.5 * p[0])), 24)
    ball(orange, (0.018, 0.013, 0.005), lambda p: place(add(p, (0.06, 0, 0.046))), 24)
