# SPDX-License-Identifier: MIT
"""The furniture of make_bathroom.py, and all that stands on it."""
import math

from meshes import add, at, ball, block, cloth, convex, frame, grid, loft, revolve, rounded, spline, tube, unit
from room import BACK, DEPTH, HEIGHT, TILE, VANITY, WIDTH, WINDOW


def vanity(wood, stone, chrome):
    low, front = 0.32, 3.12
    block(wood, (1.0, front, low), (2.1, BACK + 0.002, 0.799), 0.003, scale=0.6)
    for left, right in ((1.004, 1.548), (1.552, 2.096)):
        for bottom, top in ((low + 0.004, 0.557), (0.561, 0.795)):
            block(wood, (left, front - 0.02, bottom), (right, front + 0.001, top), 0.004, scale=0.6)
            middle, z = (left + right) / 2, top - 0.045
            handle = [(middle + x, front - y, z) for x, y in ((-0.08, 0.018), (-0.08, 0.05), (0.08, 0.05), (0.08, 0.018))]
            tube(chrome, rounded(handle, 0.012), 0.006)
    block(stone, (0.98, 3.075, 0.8), (2.12, BACK + 0.002, 0.84), 0.005)


def mirror(silver, wood):
    """A bevelled plate on a board."""
    x0, x1, z0, z1, front, slope = VANITY - 0.48, VANITY + 0.48, 1.2, 2.1, 3.572, 0.025
    points = [(x0, front + 0.002, z0), (x1, front + 0.002, z0), (x1, front + 0.002, z1), (x0, front + 0.002, z1)]
    inner = ((x0 + slope, z0 + slope), (x1 - slope, z0 + slope), (x1 - slope, z1 - slope), (x0 + slope, z1 - slope))
    points += [(x, front, z) for x, z in inner]
    points += [(p[0], front + 0.006, p[2]) for p in points[:4]]
    sides = [[i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)] + [[i, (i + 1) % 4, 8 + (i + 1) % 4, 8 + i] for i in range(4)]
    convex(silver, points, [[4, 5, 6, 7], [8, 9, 10, 11]] + sides)
    block(wood, (x0 + 0.01, front + 0.0065, z0 + 0.01), (x1 - 0.01, DEPTH + 0.004, z1 - 0.01), 0.002, scale=0.6)


SHELF = 1.145  # the glass shelf's upper face


def shelf(glass, chrome):
    block(glass, (VANITY - 0.4, 3.462, SHELF - 0.008), (VANITY + 0.4, 3.588, SHELF), 0.001)
    for x in (VANITY - 0.34, VANITY + 0.34):
        tube(chrome, [(x, 3.6, SHELF - 0.0155), (x, 3.53, SHELF - 0.0155), (x, 3.47, SHELF - 0.0155)], 0.007)
        place = frame((x, BACK, SHELF - 0.0155), (1, 0, 0), (0, 0, 1))
        revolve(chrome, [(0.016, 0.0), (0.016, 0.004), (0.012, 0.006), (0.007, 0.007)], place, 24)


def shelf_things(m):
    """A stoppered flask of glass and containers of plastic."""
    z = SHELF + 0.0004
    inside = [(0.0, 0.005), (0.024, 0.0052), (0.0292, 0.009), (0.031, 0.03), (0.0265, 0.062), (0.013, 0.087)]
    inside += [(0.0085, 0.1), (0.0085, 0.128)]
    outside = [(0.0, 0.0), (0.027, 0.0), (0.0325, 0.006), (0.0345, 0.03), (0.0295, 0.064), (0.0155, 0.09), (0.0115, 0.102)]
    outside += [(0.0115, 0.122), (0.0145, 0.125), (0.014, 0.1285)]
    profile = [outside[0]] + spline(outside[1:], 3) + spline(inside[:0:-1], 3) + [inside[0]]
    revolve(m["flask"], profile, at(1.27, 3.52, z), 56)
    cork = [(0.0, 0.108), (0.0087, 0.108), (0.0092, 0.13), (0.011, 0.132), (0.011, 0.15), (0.009, 0.153), (0.0, 0.153)]
    revolve(m["cork"], cork, at(1.27, 3.52, z), 32)
    shampoo = [(0.026, 0.018, 0.0), (0.03, 0.021, 0.005), (0.031, 0.0215, 0.06), (0.031, 0.0215, 0.11), (0.026, 0.019, 0.135)]
    shampoo = spline(shampoo + [(0.012, 0.012, 0.146)], 5)
    cap = [(0.0, -0.0005), (0.0135, -0.0005), (0.0135, 0.019), (0.012, 0.022), (0.0, 0.022)]
    for name, x, size in (("plastic_green", 1.37, 1.0), ("plastic_blue", 1.455, 0.85)):
        top = z + size * 0.146
        loft(m[name], [(0, 0, z)] + [(a, b, z + size * c) for a, b, c in shampoo] + [(0, 0, top)], at(x, 3.522, 0), 2.6, 48)
        revolve(m["plastic_white"], cap, at(x, 3.522, top), 32)
    jar = [(0.0, 0.0), (0.03, 0.0), (0.033, 0.003), (0.033, 0.04), (0.031, 0.043), (0.0, 0.043)]
    lid = [(0.031, 0.0432), (0.0335, 0.045), (0.0335, 0.058), (0.032, 0.06), (0.0, 0.0605)]
    for x, scale, body, top in ((1.74, 1.0, "plastic_white", "chrome"), (1.83, 0.78, "plastic_blue", "plastic_white")):
        revolve(m[body], [(scale * r, scale * h) for r, h in jar], at(x, 3.525, z), 40)
        revolve(m[top], [(scale * r, scale * h) for r, h in lid], at(x, 3.525, z), 40)


def cabinet_things(m):
    """A dispenser, a tumbler with toothbrushes and a piece of soap on its dish."""
    top = 0.8405
    body = [(0.0, 0.0), (0.032, 0.0), (0.0365, 0.004), (0.037, 0.1), (0.034, 0.112), (0.022, 0.12), (0.014, 0.123), (0.0, 0.123)]
    revolve(m["plastic_amber"], body[:1] + spline(body[1:-1], 4) + body[-1:], at(1.2, 3.42, top), 48)
    pump = [(0.0145, 0.1225), (0.0145, 0.134), (0.0125, 0.136), (0.005, 0.137), (0.005, 0.155), (0.011, 0.156)]
    pump += [(0.011, 0.165), (0.0, 0.167)]
    revolve(m["chrome"], pump, at(1.2, 3.42, top), 32)
    spout = rounded([(1.2, 3.42, top + 0.161), (1.225, 3.375, top + 0.161), (1.23, 3.366, top + 0.148)], 0.008)
    tube(m["chrome"], spout, 0.0042)
    glass = [(0.0, 0.0), (0.029, 0.0), (0.0315, 0.0025), (0.0335, 0.03), (0.0365, 0.1), (0.0362, 0.1012)]
    glass += [(0.0348, 0.1012), (0.0345, 0.1), (0.0315, 0.03), (0.0292, 0.013), (0.026, 0.0105), (0.0, 0.01)]
    x, y = 1.915, 3.36
    revolve(m["tumbler"], glass, at(x, y, top), 80)
    for name, turn, lean in (("plastic_green", 0.6, 0.022), ("plastic_blue", 3.5, 0.02)):
        c, s = math.cos(turn), math.sin(turn)
        stick = [(x + r * c, y + r * s, top + h) for r, h in ((-0.016, 0.0145), (lean, 0.1), (0.05, 0.18))]
        tube(m[name], stick, 0.0034, 12)
        ball(m["plastic_white"], (0.008, 0.006, 0.014), at(stick[2][0] + 0.006 * c, stick[2][1] + 0.006 * s, top + 0.17), 16)
    dish = [(0.0, 0.0, 0.0), (0.04, 0.03, 0.0), (0.058, 0.042, 0.011), (0.061, 0.045, 0.012), (0.06, 0.044, 0.014)]
    loft(m["ceramic"], dish + [(0.055, 0.039, 0.013), (0.038, 0.028, 0.004), (0.0, 0.0, 0.004)], at(1.2, 3.2, top), 2.5, 56)
    soap = spline([(0.0, 0.0, 0.005), (0.028, 0.017, 0.005), (0.036, 0.024, 0.014), (0.03, 0.019, 0.025), (0.0, 0.0, 0.027)], 5)
    loft(m["soap"], soap, at(1.203, 3.2, top), 2.8, 48)


def toilet(ceramic, seat, chrome):
    place = frame((WIDTH - TILE, 2.75, 0.0), (-1, 0, 0), (0, -1, 0))
    bowl = [(0.23, 0.115, 0.0, 0.34), (0.228, 0.113, 0.05, 0.34), (0.225, 0.125, 0.2, 0.37), (0.25, 0.168, 0.32, 0.42)]
    bowl += [(0.27, 0.186, 0.38, 0.44), (0.272, 0.187, 0.398, 0.44), (0.265, 0.18, 0.402, 0.44)]
    loft(ceramic, spline(bowl, 5) + [(0, 0, 0.402, 0.44)], place, 2.35, 64)
    loft(ceramic, [(0.14, 0.11, 0.0, 0.139), (0.14, 0.11, 0.385, 0.139), (0.135, 0.105, 0.39, 0.139), (0, 0, 0.39, 0.139)], place, 6.0, 64)
    for low, high, a, b in ((0.4035, 0.424, 0.276, 0.19), (0.4265, 0.45, 0.278, 0.193)):
        lid = [(a - 0.02, b - 0.02, low), (a - 0.004, b - 0.004, low + 0.003), (a, b, (low + high) / 2)]
        lid += [(a - 0.006, b - 0.006, high - 0.002), (a - 0.04, b - 0.04, high + 0.003), (a - 0.15, b - 0.12, high + 0.006)]
        loft(seat, [(u, v, z, 0.44) for u, v, z in [(0, 0, low)] + spline(lid, 3) + [(0, 0, high + 0.008)]], place, 2.35, 64)
    for side in (-0.08, 0.08):
        tube(chrome, [place((0.19, side - 0.03, 0.44)), place((0.19, side, 0.44)), place((0.19, side + 0.03, 0.44))], 0.011)
    tank = [(0, 0, 0.386), (0.075, 0.17, 0.386), (0.085, 0.185, 0.395), (0.09, 0.2, 0.6), (0.092, 0.205, 0.765), (0, 0, 0.765)]
    loft(ceramic, [(a, b, z, 0.092) for a, b, z in tank], place, 6.0, 64)
    lid = [(0, 0, 0.766), (0.09, 0.203, 0.766), (0.096, 0.212, 0.77), (0.097, 0.213, 0.785), (0.093, 0.208, 0.794)]
    lid += [(0.07, 0.18, 0.798), (0, 0, 0.8)]
    loft(ceramic, [(a, b, z, 0.097) for a, b, z in lid], place, 6.0, 64)
    revolve(chrome, [(0.028, 0.796), (0.028, 0.803), (0.024, 0.806), (0.0, 0.8065)], lambda p: place((p[0] + 0.097, p[1], p[2])), 32)


RAIL_X, RAIL_Y, RAIL_TOP = (2.42, 2.92), 3.515, 1.72


def towel_rail(steel):
    left, right = RAIL_X
    for x in RAIL_X:
        tube(steel, [(x, RAIL_Y, 0.6), (x, RAIL_Y, 1.2), (x, RAIL_Y, RAIL_TOP + 0.05)], 0.016)
        for z in (0.75, 1.6):
            tube(steel, [(x, RAIL_Y, z), (x, 3.55, z), (x, BACK + 0.001, z)], 0.009)
    for k in range(13):
        z = RAIL_TOP - 0.08 * k - (0.06 if k > 4 else 0.0) - (0.06 if k > 9 else 0.0)
        tube(steel, [(left, RAIL_Y, z), ((left + right) / 2, RAIL_Y, z), (right, RAIL_Y, z)], 0.011, 16)


def towel(mesh):
    """Hangs over the top bar in folds; its loops are a fine relief."""
    n, m, radius, front, back = 104, 44, 0.018, 0.66, 0.33
    arc = math.pi * radius
    rows = []
    for i in range(n + 1):
        s, row = (front + arc + back) * i / n, []
        for j in range(m + 1):
            t = j / m
            x = RAIL_X[0] + 0.06 + 0.38 * t
            if s < front:
                hang, sign, p = front - s, -1.0, (x, RAIL_Y - radius, RAIL_TOP - (front - s))
            elif s < front + arc:
                turn = (s - front) / radius
                hang, sign, p = 0.0, 0.0, (x, RAIL_Y - radius * math.cos(turn), RAIL_TOP + radius * math.sin(turn))
            else:
                hang, sign, p = s - front - arc, 0.3, (x, RAIL_Y + radius, RAIL_TOP - (s - front - arc))
            grow = min(1.0, hang / 0.35) ** 1.5
            folds = 0.5 + 0.3 * math.sin(17 * t + 0.7 + 1.2 * hang) + 0.2 * math.sin(29 * t - 2.1 * hang)
            inwards = 0.06 * grow * (0.5 - t) * (1 + 0.15 * math.sin(9 * t))
            relief = 0.0011 * math.sin(2.2 * i) * math.sin(2.3 * j) + (0.002 if 0.05 < hang < 0.09 and sign < 0 else 0.0)
            row.append((p[0] + inwards, p[1] + sign * (0.05 * grow * folds + 0.003 + relief), p[2] + (relief if sign == 0 else 0.0)))
        rows.append(row)
    cloth(mesh, rows, 0.007)


def mat(mesh):
    """A bath mat of thick loops."""
    n, m = 80, 48
    turn = math.radians(4)
    place = frame((1.42, 2.32, 0.0), (math.cos(turn), math.sin(turn), 0), (-math.sin(turn), math.cos(turn), 0))
    rows = []
    for i in range(n + 1):
        row = []
        for j in range(m + 1):
            u, v = -0.26 + 0.52 * j / m, -0.42 + 0.84 * i / n
            edge = max(0.0, min(0.26 - abs(u), 0.42 - abs(v)))
            swell = 0.0018 * math.sin(2.1 * j) * math.sin(2.0 * i) + 0.002 * math.sin(11 * u + 3) * math.sin(7 * v)
            border = -0.004 if 0.045 < edge < 0.06 else 0.0
            row.append(place((u, v, 0.001 + 0.014 * min(1.0, edge / 0.012) ** 0.5 + (swell + border) * min(1.0, edge / 0.02))))
        rows.append(row)
    grid(mesh, rows, wrap=False, crease=180.0)


def curtains(mesh, wood, random):
    """Two curtains drawn aside, with rings on a rod."""
    x0, top, bottom = 0.085, 2.34, 0.86
    tube(wood, [(x0, 1.78, top + 0.03), (x0, 2.7, top + 0.03), (x0, 3.52, top + 0.03)], 0.012)
    for y in (1.78, 3.52):
        ball(wood, (0.022, 0.022, 0.022), at(x0, y, top + 0.03), 20)
    for y in (1.9, 2.7, 3.48):
        tube(wood, [(0.0, y, top + 0.03), (0.04, y, top + 0.03), (x0, y, top + 0.03)], 0.008, 12)
    n, m = 20, 98
    for low, high in ((1.86, 2.2), (3.16, 3.46)):
        phase, rows = random(0, 6), []
        for i in range(n + 1):
            h = i / n  # from the hem up
            row = []
            for j in range(m + 1):
                t = j / m
                spread = 1 + 0.12 * (1 - h) * (2 * t - 1)
                amplitude = 0.022 + 0.014 * (1 - h)
                wave = math.sin(2 * math.pi * 7 * t + phase + 0.5 * math.sin(3 * h + 4 * t))
                wave += 0.25 * math.sin(2 * math.pi * 3 * t + 2 * phase + h)
                row.append((x0 + amplitude * wave, (low + high) / 2 + (high - low) * (t - 0.5) * spread, bottom + (top - bottom) * h))
            rows.append(row)
        grid(mesh, rows, wrap=False, crease=180.0)
        for k in range(8):
            y = low + (high - low) * (k + 0.5) / 8
            ring = [(0.018 * math.cos(math.pi * a / 5), 0.0, 0.018 * math.sin(math.pi * a / 5)) for a in range(11)]
            tube(wood, [add((x0, y, top + 0.03), p) for p in ring], 0.003, 8)


def plant(pot, soil, leaves, random):
    x, y, z = -0.035, 2.98, WINDOW[2] + 0.0125
    shape = [(0.0, 0.0), (0.034, 0.0), (0.036, 0.003), (0.049, 0.072), (0.053, 0.074), (0.053, 0.088), (0.049, 0.089)]
    revolve(pot, shape + [(0.047, 0.075), (0.046, 0.07)], at(x, y, z), 56)
    ball(soil, (0.0468, 0.0468, 0.008), at(x, y, z + 0.072), 32)
    for k in range(46):
        turn, length = 2.39996 * k + random(-0.2, 0.2), random(0.1, 0.2)
        rise, width = random(0.9, 1.45), random(0.008, 0.013)
        c, s = math.cos(turn), math.sin(turn)
        c, s = (c * 0.55, s) if c < 0 else (c, s)  # the window is near
        rows, point, angle, across = [], (x + 0.012 * c, y + 0.012 * s, z + 0.072), rise, unit((-s, c, 0.0))
        for i in range(13):
            t = i / 12
            half = width * (0.35 + 0.65 * math.sin(math.pi * min(1.0, 0.15 + 0.6 * t))) * (1 - t**4) + 0.0002
            lift = 0.35 * half
            rows.append([add(add(point, across, half * w), (0.0, 0.0, lift * w * w)) for w in (1.0, 0.5, 0.0, -0.5, -1.0)])
            point = add(point, (c * math.cos(angle), s * math.cos(angle), math.sin(angle)), length / 12)
            angle -= 0.16 * t * (1.6 - 0.5 * rise) + 0.02
        grid(leaves, rows, wrap=False, crease=180.0)


def lamps(chrome):
    """Fittings of the glass globes, which are spheres in bathroom.xml: a cup outside, half a millimetre off the glass, and a stem
    to the bulb inside."""

    def fitting(place, outer, inner):
        profile = [(0.0, -outer - 0.03), (0.012, -outer - 0.03), (0.016, -outer - 0.024)]
        cup = [((outer + 0.004) * math.sin(t), -(outer + 0.004) * math.cos(t)) for t in (math.radians(14 + 3 * k) for k in range(7))]
        lining = [((outer + 0.0006) * math.sin(t), -(outer + 0.0006) * math.cos(t)) for t in (math.radians(32 - 4 * k) for k in range(8))]
        revolve(chrome, profile + cup + lining + [(0.0, -outer - 0.0006)], place, 48)
        stem = [(0.0, 0.0006 - inner), (0.005, 0.0006 - inner), (0.005, -0.03), (0.011, -0.026), (0.011, -0.012), (0.0, -0.012)]
        revolve(chrome, stem, place, 24)

    for side in (-0.64, 0.64):
        x, y, z = VANITY + side, 3.46, 1.7
        fitting(at(x, y, z), 0.08, 0.077)
        tube(chrome, rounded([(x, DEPTH, z - 0.13), (x, y, z - 0.13), (x, y, z - 0.105)], 0.02), 0.008)
        revolve(chrome, [(0.03, 0.0), (0.03, 0.006), (0.024, 0.012), (0.009, 0.014)], frame((x, DEPTH, z - 0.13), (1, 0, 0), (0, 0, 1)), 36)
    flip = frame((1.75, 2.5, 2.08), (1, 0, 0), (0, -1, 0))
    fitting(flip, 0.12, 0.116)
    tube(chrome, [(1.75, 2.5, 2.22), (1.75, 2.5, 2.4), (1.75, 2.5, HEIGHT)], 0.006, 16)
    revolve(chrome, [(0.05, 0.0), (0.05, 0.008), (0.03, 0.02), (0.006, 0.024)], frame((1.75, 2.5, HEIGHT), (1, 0, 0), (0, -1, 0)), 40)
