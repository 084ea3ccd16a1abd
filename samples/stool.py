#!/usr/bin/python3
"""Writes a small scene to try materials on, a stool on a floor: stool.py stool.glb

Lengths are metres, and a unit of texture coordinates is a metre. Its materials: seat, wood, floor.
"""
import json
import struct
import sys
from math import cos, hypot, pi, sin


def lathe(profile, turns=48, texture=None):
    """Triangles of a profile of (radius, height), from bottom to top, turned around Y."""
    length = [0.0]
    for (r0, h0), (r1, h1) in zip(profile, profile[1:]):
        length.append(length[-1] + hypot(r1 - r0, h1 - h0))
    points, coordinates, triangles = [], [], []
    for (radius, height), along in zip(profile, length):
        for i in range(turns + 1):
            angle = 2 * pi * i / turns
            points.append((radius * sin(angle), height, radius * cos(angle)))
            # around the top as on a map of the pole, or up the side
            top = length[-1] - along
            coordinates.append((top * sin(angle), top * cos(angle)) if texture == "top"
                               else (i / turns * 2 * pi * profile[0][0], -along))
    for row in range(len(profile) - 1):
        for i in range(turns):
            a, b = row * (turns + 1) + i, (row + 1) * (turns + 1) + i
            triangles += [(a, a + 1, b + 1), (a, b + 1, b)]
    return points, coordinates, triangles


def moved(part, x, z):
    points, coordinates, triangles = part
    return [(px + x, py, pz + z) for px, py, pz in points], coordinates, triangles


def joined(parts):
    points, coordinates, triangles = [], [], []
    for p, c, t in parts:
        triangles += [tuple(len(points) + i for i in triangle) for triangle in t]
        points += p
        coordinates += c
    return points, coordinates, triangles


def smooth_normals(points, triangles):
    normals = [[0.0, 0.0, 0.0] for _ in points]
    for a, b, c in triangles:
        u, v = ([points[i][k] - points[a][k] for k in range(3)] for i in (b, c))
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for i in (a, b, c):
            normals[i] = [normals[i][k] + n[k] for k in range(3)]
    at = {}  # the seam of a lathe has each point twice
    for point, n in zip(points, normals):
        key = tuple(round(p, 6) for p in point)
        at[key] = [s + k for s, k in zip(at.get(key, (0, 0, 0)), n)]
    sums = [at[tuple(round(p, 6) for p in point)] for point in points]
    return [[s / (hypot(*n) or 1) for s in n] for n in sums]


def cushion():
    steps = [pi * (i / 24 - 0.5) for i in range(25)]
    side = [(0.13 + 0.05 * cos(t), 0.47 + 0.05 * sin(t)) for t in steps]
    top = [(0.13 * (1 - i / 8), 0.52 + 0.012 * (1 - (1 - i / 8) ** 2)) for i in range(1, 9)]
    return lathe([(0.0, 0.42)] + side + top, texture="top")


def legs():
    leg = lathe([(0.016, 0.0), (0.02, 0.38), (0.0, 0.38)], 16)
    plate = lathe([(0.0, 0.38), (0.15, 0.38), (0.15, 0.42), (0.0, 0.42)])
    places = [(0.11 * sin(a), 0.11 * cos(a)) for a in (pi / 4, 3 * pi / 4, 5 * pi / 4, 7 * pi / 4)]
    return joined([moved(leg, x, z) for x, z in places] + [plate])


def floor():
    half = 0.7
    points = [(-half, 0, -half), (half, 0, -half), (half, 0, half), (-half, 0, half)]
    return points, [(p[0], p[2]) for p in points], [(0, 2, 1), (0, 3, 2)]


def write(path, parts):
    data, views, accessors, meshes, materials = b"", [], [], [], []

    def add(rows, kind, code, component, **more):
        nonlocal data
        packed = b"".join(struct.pack(f"<{len(row)}{code}", *row) for row in rows)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        data += packed
        count = len(rows) * (3 if kind == "SCALAR" else 1)
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count,
                          "type": kind, **more})
        return len(accessors) - 1

    for name, color, (points, coordinates, triangles) in parts:
        low, high = ([f(p[k] for p in points) for k in range(3)] for f in (min, max))
        primitive = {
            "attributes": {
                "POSITION": add(points, "VEC3", "f", 5126, min=low, max=high),
                "NORMAL": add(smooth_normals(points, triangles), "VEC3", "f", 5126),
                "TEXCOORD_0": add(coordinates, "VEC2", "f", 5126),
            },
            "indices": add(triangles, "SCALAR", "I", 5125),
            "material": len(materials),
        }
        meshes.append({"name": name, "primitives": [primitive]})
        materials.append({"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 0.6}})
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(meshes)))}],
        "nodes": [{"mesh": i} for i in range(len(meshes))], "meshes": meshes, "materials": materials,
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(data), b"BIN\0") + data)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: stool.py NAME.glb")
    write(sys.argv[1], [("seat", (0.5, 0.45, 0.4), cushion()), ("wood", (0.45, 0.28, 0.15), legs()),
                        ("floor", (0.35, 0.35, 0.33), floor())])
