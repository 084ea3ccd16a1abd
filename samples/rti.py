#!/usr/bin/python3
"""Makes an RTI of a measurement's view from the top, to try things on: rti.py tiles.zip tiles

The folder gets the photographs and their light list, tiles.lp.
"""
import os
import re
import sys
import zipfile
from math import cos, radians, sin


def main(measurement, folder):
    os.makedirs(folder, exist_ok=True)
    lines = []
    with zipfile.ZipFile(measurement) as archive:
        for name in sorted(archive.namelist()):
            angles = re.search(r"tl(\d+) pl(\d+) tv000 pv000", name)
            if not angles:
                continue
            polar, azimuth = (radians(int(angle)) for angle in angles.groups())
            photograph = f"{len(lines):02}{os.path.splitext(name)[1]}"
            with open(os.path.join(folder, photograph), "wb") as file:
                file.write(archive.read(name))
            lines.append(f"{photograph} {sin(polar) * cos(azimuth):.5f} {sin(polar) * sin(azimuth):.5f} "
                         f"{cos(polar):.5f}\n")
    if not lines:
        sys.exit(f"{measurement}: no image of the view from the top (tv000 pv000)")
    with open(os.path.join(folder, os.path.basename(folder) + ".lp"), "w") as file:
        file.write(f"{len(lines)}\n" + "".join(lines))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: rti.py MEASUREMENT.zip FOLDER")
    main(*sys.argv[1:])
