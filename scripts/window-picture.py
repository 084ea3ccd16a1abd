#!/usr/bin/python3
"""Runs a program in a window of Xvfb and takes a picture of the screen as soon as it rests:
window-picture.py PICTURE.png WIDTHxHEIGHT PROGRAM [ARGUMENT...]"""
import os
import struct
import subprocess
import sys
import tempfile
import time
import zlib


def screen_of(dump):
    """Rows of RGB of an XWD file, 32 bits a pixel, as Xvfb keeps one."""
    header = struct.unpack(">25I", dump[:100])
    size, width, height, stride, colors = header[0], header[4], header[5], header[12], header[19]
    rows = []
    for y in range(height):
        start = size + 12 * colors + y * stride
        pixels = dump[start : start + 4 * width]
        row = bytearray(3 * width)
        row[0::3], row[1::3], row[2::3] = pixels[2::4], pixels[1::4], pixels[0::4]
        rows.append(bytes(row))
    return rows


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    above = [bytes(len(rows[0])), *rows]  # a row is written as its difference from that
    lines = [b"\2" + bytes((a - b) & 255 for a, b in zip(row, last)) for row, last in zip(rows, above)]
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header))
        file.write(chunk(b"IDAT", zlib.compress(b"".join(lines), 9)) + chunk(b"IEND", b""))


def resting_screen(path, program):
    """What the screen shows when it has not changed for ten seconds."""
    last, since = None, time.time()
    while time.time() - since < 10.0:
        time.sleep(0.5)
        if program.poll() is not None:
            sys.exit("the program has ended")
        with open(path, "rb") as file:
            rows = screen_of(file.read())
        if rows != last or not any(map(any, rows)):
            last, since = rows, time.time()
    return last


def main(picture, size, command):
    with tempfile.TemporaryDirectory() as folder:
        read, write = os.pipe()
        server = subprocess.Popen(["Xvfb", "-screen", "0", f"{size}x24", "-fbdir", folder, "-displayfd", str(write)],
                                  pass_fds=[write], stderr=subprocess.DEVNULL)
        program = None
        try:
            display = ":" + os.read(read, 16).decode().strip()
            program = subprocess.Popen(command, env={**os.environ, "DISPLAY": display, "XDG_STATE_HOME": folder})
            write_png(picture, resting_screen(os.path.join(folder, "Xvfb_screen0"), program))
        finally:
            for process in filter(None, (program, server)):
                process.terminate()
                process.wait()


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
