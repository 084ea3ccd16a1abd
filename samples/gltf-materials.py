#!/usr/bin/env python3
"""Writes a glTF scene that shows Khronos' material extensions side by side: in each column a
material, above without its extension, below with it (docs/gltf.md shows it).

    samples/gltf-materials.py materials.gltf
    weft-render materials.gltf --env studio --size 880x300 -o materials.png
"""
import base64
import json
import math
import struct
import sys


def sphere(rings=48):
    """Positions, normals, tangents and texture coordinates of a unit sphere, and its triangles."""
    vertices, triangles = [], []
    for row in range(rings + 1):
        for column in range(2 * rings + 1):
            theta, phi = math.pi * row / rings, math.pi * column / rings
            n = (math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi))
            tangent = (math.cos(phi), 0.0, -math.sin(phi), 1.0)
            vertices.append((n, n, tangent, (column / rings, row / rings)))
    width = 2 * rings + 1
    for row in range(rings):
        for column in range(2 * rings):
            first = row * width + column
            triangles += [first, first + width, first + 1, first + 1, first + width, first + width + 1]
    return vertices, triangles


def board(columns, rows):
    """A wall of unit squares around the origin, every other one of them."""
    vertices, triangles = [], []
    for row in range(rows):
        for column in range(columns):
            if (row + column) % 2:
                continue
            first = len(vertices)
            for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
                place = (column - columns / 2 + x, row - rows / 2 + y, 0.0)
                vertices.append((place, (0, 0, 1), (1, 0, 0, 1), (x, y)))
            triangles += [first, first + 1, first + 2, first, first + 2, first + 3]
    return vertices, triangles


class Scene:
    def __init__(self):
        self.data = bytearray()
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [],
                     "meshes": [], "materials": [], "accessors": [], "bufferViews": []}

    def accessor(self, numbers, kind, width, code):
        payload = struct.pack("<%d%s" % (len(numbers), code), *numbers)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(payload)})
        self.data += payload
        accessor = {"bufferView": len(self.json["bufferViews"]) - 1, "count": len(numbers) // width,
                    "componentType": 5126 if code == "f" else 5125, "type": kind}
        if kind == "VEC3":
            accessor["min"] = [min(numbers[i::3]) for i in range(3)]
            accessor["max"] = [max(numbers[i::3]) for i in range(3)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def shape(self, vertices, triangles):
        """Accessors of a mesh, which may have many materials."""
        names = (("POSITION", "VEC3", 3), ("NORMAL", "VEC3", 3), ("TANGENT", "VEC4", 4), ("TEXCOORD_0", "VEC2", 2))
        attributes = {}
        for which, (name, kind, width) in enumerate(names):
            numbers = [number for vertex in vertices for number in vertex[which]]
            attributes[name] = self.accessor(numbers, kind, width, "f")
        return {"attributes": attributes, "indices": self.accessor(triangles, "SCALAR", 1, "I")}

    def add(self, shape, material, place, name):
        self.json["materials"].append({"name": name, **material})
        primitive = {**shape, "material": len(self.json["materials"]) - 1}
        self.json["meshes"].append({"name": name, "primitives": [primitive]})
        self.json["nodes"].append({"mesh": len(self.json["meshes"]) - 1, "translation": place, "name": name})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def look_from(self, distance, height):
        """A camera on the Z axis that sees so much of what stands at the origin."""
        angle = 2 * math.atan(height / 2 / distance)
        self.json["cameras"] = [{"type": "perspective", "perspective": {"yfov": angle, "znear": 1}}]
        self.json["nodes"].append({"camera": 0, "translation": [0, 0, distance], "name": "camera"})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def write(self, path):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.json["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        self.json["extensionsUsed"] = sorted({name for material in self.json["materials"]
                                              for name in material.get("extensions", {})})
        with open(path, "w", encoding="utf-8") as file:
            json.dump(self.json, file)


def surface(color, metallic, roughness):
    return {"pbrMetallicRoughness": {"baseColorFactor": color + [1], "metallicFactor": metallic,
                                     "roughnessFactor": roughness}}


COLUMNS = [
    ("specular", surface([0.1, 0.25, 0.1], 0, 0.3), {"specularFactor": 1, "specularColorFactor": [1, 0.25, 0.25]}),
    ("clearcoat", surface([0.55, 0.03, 0.03], 0.6, 0.6), {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.03}),
    ("sheen", surface([0.05, 0.03, 0.2], 0, 0.9), {"sheenColorFactor": [0.9, 0.7, 1.0], "sheenRoughnessFactor": 0.3}),
    ("anisotropy", surface([0.75, 0.72, 0.68], 1, 0.25), {"anisotropyStrength": 0.8}),
    ("iridescence", surface([0.5, 0.5, 0.5], 1, 0.2),
     {"iridescenceFactor": 1, "iridescenceIor": 1.6, "iridescenceThicknessMaximum": 480}),
    ("transmission", surface([0.55, 0.85, 0.95], 0, 0.03), {"transmissionFactor": 0.95}),
]


def main(path):
    scene = Scene()
    ball = scene.shape(*sphere())
    for column, (name, plain, extension) in enumerate(COLUMNS):
        x = 2.3 * (column - (len(COLUMNS) - 1) / 2)
        layered = {**plain, "extensions": {"KHR_materials_" + name: extension}}
        scene.add(ball, plain, [x, 1.15, 0], name + ", without")
        scene.add(ball, layered, [x, -1.15, 0], name)
    scene.add(scene.shape(*board(17, 7)), surface([0.35, 0.33, 0.3], 0, 1), [0, 0, -2.5], "wall")
    scene.look_from(30, 4.8)
    scene.write(path)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: gltf-materials.py SCENE.gltf")
    main(sys.argv[1])
