# SPDX-License-Identifier: MIT
"""Triangle meshes of swept, turned and draped surfaces, and images, for make_bathroom.py and make_media.py."""
import math
import os
import struct
import zlib

FOLDER = os.path.dirname(os.path.abspath(__file__))
WRITER = "make_bathroom.py"


class Random:
    """Numerical Recipes' linear congruential generator."""

    def __init__(self, seed):
        self.state = seed

    def __call__(self, low=0.0, high=1.0):
        self.state = (1664525 * self.state + 1013904223) & 0xFFFFFFFF
        return low + (high - low) * (self.state >> 8) / float(1 << 24)


# Vectors -------------------------------------------------------------------------------------------------------------


def add(a, b, scale=1.0):
    return (a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length) if length > 0 else (0.0, 0.0, 0.0)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def frame(origin, x, y):
    """The map from right-handed local coordinates to the room's; x and y are unit vectors."""
    z = cross(x, y)
    return lambda p: add(add(add(origin, x, p[0]), y, p[1]), z, p[2])


def at(x, y, z):
    return lambda p: (p[0] + x, p[1] + y, p[2] + z)


# Meshes --------------------------------------------------------------------------------------------------------------


class Mesh:
    """Triangles with a normal, and perhaps texture coordinates, at each vertex. A faceted mesh has no normals: the scene asks for
    those of the faces. A closed mesh encloses a volume: write() proves it."""

    def __init__(self, name, textured=False, closed=False, faceted=False):
        self.name, self.textured, self.closed, self.faceted = name, textured, closed, faceted
        self.points, self.normals, self.uvs, self.faces = [], [], [], []

    def vertex(self, point, normal, uv=(0.0, 0.0)):
        self.points.append(tuple(round(c, 5) + 0.0 for c in point))
        self.normals.append(normal)
        self.uvs.append(uv)
        return len(self.points) - 1

    def face(self, a, b, c):
        p, q, r = self.points[a], self.points[b], self.points[c]
        if p != q and q != r and r != p:
            self.faces.append((a, b, c))

    def check_closed(self):
        edges, volume = {}, 0.0
        for face in self.faces:
            p = [self.points[i] for i in face]
            volume += dot(p[0], cross(p[1], p[2])) / 6
            for i in range(3):
                edge = (p[i], p[(i + 1) % 3])
                edges[edge] = edges.get(edge, 0) + 1
        assert all(n == 1 and edges.get((b, a)) == 1 for (a, b), n in edges.items()), self.name + " has holes"
        assert volume > 0, self.name + " is inside out"

    def write(self):
        if self.closed:
            self.check_closed()
        names = ["x", "y", "z"] + ([] if self.faceted else ["nx", "ny", "nz"]) + (["u", "v"] if self.textured else [])
        header = ["ply", "format binary_little_endian 1.0", "comment written by " + WRITER, "element vertex %d" % len(self.points)]
        header += ["property float " + name for name in names]
        header += ["element face %d" % len(self.faces), "property list uchar int vertex_indices", "end_header"]
        out = [("\n".join(header) + "\n").encode()]
        for point, normal, uv in zip(self.points, self.normals, self.uvs):
            values = point
            if not self.faceted:
                values += tuple(round(c, 4) + 0.0 for c in normal)
            if self.textured:
                values += tuple(round(c, 4) + 0.0 for c in uv)
            out.append(struct.pack("<%df" % len(values), *values))
        out += [struct.pack("<Biii", 3, *face) for face in self.faces]
        data = b"".join(out)
        with open(os.path.join(FOLDER, self.name + ".ply"), "wb") as file:
            file.write(data)
        return len(data)


def smooth_patch(mesh, rows, wrap, uv):
    """One piece of grid(): a normal is the mean of those of the faces around it. A row that is one point is one vertex."""
    count = len(rows[0])
    index = []
    for i, row in enumerate(rows):
        pole = all(p == row[0] for p in row)
        indices = []
        for j, point in enumerate(row):
            indices.append(indices[0] if pole and j else mesh.vertex(point, None, uv(i, j) if uv else (0.0, 0.0)))
        index.append(indices)
    start = index[0][0]
    normals = [(0.0, 0.0, 0.0)] * (len(mesh.points) - start)
    for i in range(len(rows) - 1):
        for j in range(count if wrap else count - 1):
            k = (j + 1) % count
            a, b, c, d = index[i][j], index[i][k], index[i + 1][k], index[i + 1][j]
            for triangle in ((a, b, c), (a, c, d)):
                if len(set(triangle)) == 3:
                    p, q, r = (mesh.points[t] for t in triangle)
                    normal = cross(sub(q, p), sub(r, p))
                    mesh.face(*triangle)
                    for t in triangle:
                        normals[t - start] = add(normals[t - start], normal)
    for i, normal in enumerate(normals):
        mesh.normals[start + i] = unit(normal)


def grid(mesh, rows, wrap=True, uv=None, crease=40.0):
    """A surface through rows of points, seen from where its rows run counter-clockwise and follow each other upwards.
    Closed along its rows if wrap. Where the surface turns by more than `crease` degrees from row to row it has an edge."""

    def direction(i):
        return [unit(sub(q, p)) for p, q in zip(rows[i], rows[i + 1])]

    cosine, first = math.cos(math.radians(crease)), 0
    for i in range(1, len(rows) - 1):
        before, after = direction(i - 1), direction(i)
        if sum(dot(p, q) for p, q in zip(before, after)) < cosine * len(before):
            smooth_patch(mesh, rows[first : i + 1], wrap, (lambda r, j, f=first: uv(r + f, j)) if uv else None)
            first = i
    smooth_patch(mesh, rows[first:], wrap, (lambda r, j: uv(r + first, j)) if uv else None)


def superellipse(a, b, exponent, count):
    def power(c):
        return math.copysign(abs(c) ** (2.0 / exponent), c) if abs(c) > 1e-9 else 0.0

    angles = [2 * math.pi * j / count for j in range(count)]
    return [(a * power(math.cos(t)), b * power(math.sin(t))) for t in angles]


def loft(mesh, sections, place, exponent=2.0, count=64):
    """Superellipses of half axes a and b at heights z, from (a, b, z) or (a, b, z, x of the middle)."""
    rows = []
    for section in sections:
        a, b, z = section[:3]
        x = section[3] if len(section) > 3 else 0.0
        rows.append([place((x + u, v, z)) for u, v in superellipse(a, b, exponent, count)])
    grid(mesh, rows)


def revolve(mesh, profile, place, count=48):
    """Turns (radius, z), from the bottom outside to the top, about the z axis."""
    loft(mesh, [(r, r, z) for r, z in profile], place, 2.0, count)


def ball(mesh, radii, place, count=24):
    half = count // 2
    angles = [math.pi * i / half for i in range(half + 1)]
    sections = [(radii[0] * math.sin(t), radii[1] * math.sin(t), -radii[2] * math.cos(t)) for t in angles]
    sections[0], sections[-1] = (0.0, 0.0, -radii[2]), (0.0, 0.0, radii[2])
    loft(mesh, sections, place, 2.0, count)


def spline(points, steps):
    """Catmull and Rom's curve through the points."""
    points = [mix(points[1], points[0], 2.0)] + list(points) + [mix(points[-2], points[-1], 2.0)]
    result = []
    for a, b, c, d in zip(points, points[1:], points[2:], points[3:]):
        for k in range(steps):
            t = k / steps
            weights = (t * (t * (2 - t) - 1) / 2, (t * t * (3 * t - 5) + 2) / 2, t * (t * (4 - 3 * t) + 1) / 2, t * t * (t - 1) / 2)
            result.append(tuple(sum(w * p[i] for w, p in zip(weights, (a, b, c, d))) for i in range(len(b))))
    return result + [tuple(points[-2])]


def rounded(points, radius, steps=6):
    """A polygonal line with its corners replaced by arcs."""
    result = [points[0]]
    for p, q, r in zip(points, points[1:], points[2:]):
        before, after = unit(sub(q, p)), unit(sub(r, q))
        half = math.acos(max(-1.0, min(1.0, dot(before, after)))) / 2
        middle = add(q, unit(sub(after, before)), radius / math.cos(half))
        start, end = sub(add(q, before, -radius * math.tan(half)), middle), sub(add(q, after, radius * math.tan(half)), middle)
        for k in range(steps + 1):
            t = k / steps
            weights = (math.sin((1 - t) * 2 * half) / math.sin(2 * half), math.sin(t * 2 * half) / math.sin(2 * half))
            result.append(add(add(middle, start, weights[0]), end, weights[1]))
    return result + [points[-1]]


def tube(mesh, path, radius, count=16):
    """A rod around a path, its ends rounded off a little."""
    tangents = [unit(sub(path[min(i + 1, len(path) - 1)], path[max(i - 1, 0)])) for i in range(len(path))]
    side = unit(cross(tangents[0], (0.0, 0.0, 1.0) if abs(tangents[0][2]) < 0.9 else (1.0, 0.0, 0.0)))
    rings = []
    for point, tangent in zip(path, tangents):
        side = unit(add(side, tangent, -dot(side, tangent)))
        rings.append((point, tangent, side))
    ends = [(0.0, 0.0), (0.75, 0.0), (0.93, 0.07), (1.0, 0.25)]
    steps = [(0, r, z) for r, z in ends] + [(i, 1.0, None) for i in range(1, len(path) - 1)] + [(-1, r, -z) for r, z in reversed(ends)]
    rows = []
    for i, r, z in steps:
        point, tangent, side = rings[i]
        up, middle = cross(tangent, side), add(point, tangent, (z or 0.0) * radius)
        angles = [2 * math.pi * j / count for j in range(count)]
        rows.append([add(add(middle, side, r * radius * math.cos(t)), up, r * radius * math.sin(t)) for t in angles])
    grid(mesh, rows, crease=60.0)


def convex(mesh, points, faces, uvs=None):
    """A convex solid's flat faces, turned outwards."""
    middle = tuple(sum(p[i] for p in points) / len(points) for i in range(3))
    for face in faces:
        p = [points[i] for i in face]
        normal = unit(cross(sub(p[1], p[0]), sub(p[2], p[0])))
        if dot(normal, sub(p[0], middle)) < 0:
            face, normal = face[::-1], sub((0.0, 0.0, 0.0), normal)
        corners = [mesh.vertex(points[i], normal, uvs[i] if uvs else (0.0, 0.0)) for i in face]
        for i in range(1, len(corners) - 1):
            mesh.face(corners[0], corners[i], corners[i + 1])


def block(mesh, low, high, bevel=0.003, scale=1.0):
    """A box with bevelled edges. Texture coordinates are lengths over `scale`, the grain along x, else y."""
    signs = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    points, uvs, name = [], [], {}
    for s in signs:
        for axis in range(3):
            name[s, axis] = len(points)
            points.append(tuple((low[i], high[i])[s[i]] + (0.0 if i == axis else (bevel, -bevel)[s[i]]) for i in range(3)))
            u, v = [points[-1][i] for i in range(3) if i != axis]
            uvs.append((u / scale, v / scale))
    faces = [[name[s, 0], name[s, 1], name[s, 2]] for s in signs]
    for axis in range(3):
        b, c = [i for i in range(3) if i != axis]

        def sign(along, at_b, at_c):
            s = [0, 0, 0]
            s[axis], s[b], s[c] = along, at_b, at_c
            return tuple(s)

        for end in (0, 1):
            faces.append([name[sign(end, *corner), axis] for corner in ((0, 0), (1, 0), (1, 1), (0, 1))])
        for corner in ((0, 0), (1, 0), (1, 1), (0, 1)):
            s, t = sign(0, *corner), sign(1, *corner)
            faces.append([name[s, b], name[t, b], name[t, c], name[s, c]])
    convex(mesh, points, faces, uvs)


def quad(mesh, a, b, c, d):
    """A flat rectangle, seen from where its corners run counter-clockwise."""
    normal = unit(cross(sub(b, a), sub(c, a)))
    index = [mesh.vertex(p, normal) for p in (a, b, c, d)]
    mesh.face(*index[:3])
    mesh.face(index[0], index[2], index[3])


def cloth(mesh, rows, thickness):
    """A closed sheet of some thickness around a grid of points."""
    n, m = len(rows), len(rows[0])
    rings = []
    for i in range(n):
        front, back = [], []
        for j in range(m):
            along = sub(rows[i][min(j + 1, m - 1)], rows[i][max(j - 1, 0)])
            up = sub(rows[min(i + 1, n - 1)][j], rows[max(i - 1, 0)][j])
            normal = unit(cross(along, up))
            front.append(add(rows[i][j], normal, thickness / 2))
            back.append(add(rows[i][j], normal, -thickness / 2))
        rings.append(front + back[::-1])
    hems = [[rings[i][j] for j in list(range(m))] for i in (0, -1)], [[rings[i][2 * m - 1 - j] for j in range(m)] for i in (0, -1)]
    grid(mesh, rings, crease=180.0)
    grid(mesh, [hems[1][0], hems[0][0]], wrap=False)
    grid(mesh, [hems[0][1], hems[1][1]], wrap=False)


def image(name, width, height, color):
    """An uncompressed PNG of color(x, y), sRGB bytes."""
    data = b"".join(b"\0" + bytes(c for x in range(width) for c in color(x, y)) for y in range(height))
    packed = [b"\x78\x01"]
    for i in range(0, len(data), 65535):
        part = data[i : i + 65535]
        packed.append(struct.pack("<BHH", i + 65535 >= len(data), len(part), 65535 - len(part)) + part)
    packed.append(struct.pack(">I", zlib.adler32(data)))
    out = b"\x89PNG\r\n\x1a\n"
    for kind, body in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)), (b"IDAT", b"".join(packed)), (b"IEND", b"")):
        out += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    with open(os.path.join(FOLDER, name), "wb") as file:
        file.write(out)
    return len(out)
