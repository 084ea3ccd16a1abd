#!/usr/bin/python3
"""Writes a set of textures to try weft-bake on, a brick wall that repeats: bricks.py FOLDER
makes height.png, albedo.png and roughness.png there, 128 x 128 pixels."""
import os
import random
import struct
import sys
import zlib

SIZE, ROWS, COLUMNS = 128, 6, 3
MORTAR = 0.04  # half of a joint, in widths of the wall


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)
    data = b"".join(b"\0" + bytes(round(255 * min(max(v, 0), 1)) for color in row for v in color) for row in rows)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header))
        file.write(chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))


def wall():
    """For each pixel: its height, its colour, its roughness."""
    grain = random.Random(1)
    shades = {(row, column): random.Random(10 * row + column).uniform(0.75, 1.1)
              for row in range(ROWS) for column in range(COLUMNS)}
    for y in range(SIZE):
        for x in range(SIZE):
            v = ROWS * (y + 0.5) / SIZE
            row = int(v)
            u = (COLUMNS * (x + 0.5) / SIZE + 0.5 * (row % 2)) % COLUMNS  # every other row is shifted
            edge = min(min(u % 1, 1 - u % 1) / COLUMNS, min(v % 1, 1 - v % 1) / ROWS)
            rise = min(max((edge - 0.3 * MORTAR) / (0.3 * MORTAR), 0), 1)  # 0 in the joint, 1 on the brick
            noise = grain.uniform(-1, 1)
            shade = shades[row, int(u)] * (1 + 0.1 * noise)
            brick, joint = (0.55 * shade, 0.24 * shade, 0.17 * shade), 3 * (0.6 + 0.05 * noise,)
            color = tuple(rise * b + (1 - rise) * j for b, j in zip(brick, joint))
            yield 0.85 * rise + 0.04 * noise + 0.05, color, 0.9 - 0.25 * rise


def main(folder):
    os.makedirs(folder, exist_ok=True)
    pixels = list(wall())
    for name, of in (("height", lambda p: 3 * (p[0],)), ("albedo", lambda p: p[1]), ("roughness", lambda p: 3 * (p[2],))):
        rows = [[of(p) for p in pixels[y * SIZE : (y + 1) * SIZE]] for y in range(SIZE)]
        write_png(os.path.join(folder, name + ".png"), rows)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
