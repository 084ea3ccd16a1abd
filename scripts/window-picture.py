#!/usr/bin/python3
"""Runs a program in a window of Xvfb and takes a picture of the screen as soon as it rests:
window-picture.py PICTURE.png WIDTHxHEIGHT PROGRAM [ARGUMENT...]"""
import os
import struct
import subprocess
import sys
import tempfile
import time

from PIL import Image


def screen_of(dump):
    """The picture in an XWD file, 32 bits a pixel, as Xvfb keeps one."""
    header = struct.unpack(">25I", dump[:100])
    size, width, height, stride, colors = header[0], header[4], header[5], header[12], header[19]
    return Image.frombytes("RGB", (width, height), dump[size + 12 * colors :], "raw", "BGRX", stride)


def resting_screen(path, program):
    """What the screen shows when it has not changed for ten seconds."""
    last, since = None, time.time()
    while time.time() - since < 10.0:
        time.sleep(0.5)
        if program.poll() is not None:
            sys.exit("the program has ended")
        with open(path, "rb") as file:
            screen = screen_of(file.read())
        if screen != last or not screen.getbbox():  # all black
            last, since = screen, time.time()
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
            resting_screen(os.path.join(folder, "Xvfb_screen0"), program).save(picture, optimize=True)
        finally:
            for process in filter(None, (program, server)):
                process.terminate()
                process.wait()


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
