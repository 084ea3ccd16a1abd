#!/usr/bin/env python3
"""Which model fits photographs of one view best, by the number of lights: the table of docs/fitting.md.

scripts/measure-one-view.py [BIN]: fits the RTI sets of $WEFT_DATA with the programs in BIN
(build/release/bin), each with 6 to 40 of its lights, spread evenly, and prints the mean eps of stored
luminance over lights that were not fitted: of RealRTI, of SynthRTI.
"""
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

MODELS = ["ptm", "rfp", "bump", "rfnl --lobes 1", "rfnl --lobes 2"]
COUNTS = [6, 8, 12, 16, 24, 40]
SIDE = 64  # of the texels in the middle that are fitted


def lights_of(list_file):
    """(line, unit vector) of every light above the horizon; images with their whole paths."""
    lights = []
    for line in filter(str.strip, list_file.read_text().splitlines()[1:]):
        name, x, y, z = line.rsplit(maxsplit=3)
        vector = [float(x), float(y), float(z)]
        length = math.hypot(*vector)
        if vector[2] > 0:
            lights.append((f"{list_file.parent / name} {x} {y} {z}", [v / length for v in vector]))
    return lights


def spread(lights, count):
    """So many lights, each as far from those before as can be, from the one nearest to the top on."""
    chosen = [max(range(len(lights)), key=lambda i: lights[i][1][2])]
    while len(chosen) < count:
        nearest = lambda i: max(sum(a * b for a, b in zip(lights[i][1], lights[j][1])) for j in chosen)
        chosen.append(min((i for i in range(len(lights)) if i not in chosen), key=nearest))
    return chosen


def write_list(path, lights):
    path.write_text(f"{len(lights)}\n" + "".join(line + "\n" for line, _ in lights))
    return path


def middle(programs, list_file):
    run = subprocess.run([programs / "weft-info", list_file, "--json", "-"], check=True, capture_output=True)
    info = json.loads(run.stdout)
    sides = [min(SIDE, info[side]) for side in ("width", "height")]
    return [str(n) for n in ((info["width"] - sides[0]) // 2, (info["height"] - sides[1]) // 2, *sides)]


def held_out(programs, folder, fitted, tested, model, crop):
    """The eps of stored luminance over the lights of `tested` that are not fitted; None without a fit."""
    field, report = folder / "fit.rf.exr", folder / "eval.json"
    fit = [programs / "weft-fit", fitted, "-o", field, "--model", *model.split(), "--crop", *crop, "--quiet"]
    if subprocess.run(fit, capture_output=True).returncode != 0:
        return None
    evaluate = [programs / "weft-eval", field, "--against", tested, "--crop", *crop, "--json", report]
    subprocess.run(evaluate, check=True, capture_output=True)
    return json.loads(report.read_text())["held_out"]["epsilon"]["stored"]["luminance"]["avg"]


def sets(data):
    """(group, list to fit, list to test on) of every set."""
    for item in sorted((data / "rti").glob("item*/dirs.lp")):
        yield "RealRTI", item, item
    for dome in sorted((data / "synthrti").glob("*/*/*/Dome/dirs.lp")):
        yield "SynthRTI", dome, dome.parent.parent / "Test" / "dirs.lp"


def measure(programs, data, folder):
    """errors[count][model][group]: of every set that has so many lights, and six more to test on."""
    errors = {}
    for group, fit_file, test_file in sets(data):
        lights, crop = lights_of(fit_file), middle(programs, fit_file)
        tested = write_list(folder / "test.lp", lights_of(test_file))
        for count in COUNTS:
            if count > len(lights) - (6 if test_file == fit_file else 0):
                continue
            fitted = write_list(folder / "fit.lp", [lights[i] for i in spread(lights, count)])
            for model in MODELS:
                error = held_out(programs, folder, fitted, tested, model, crop)
                errors.setdefault(count, {}).setdefault(model, {}).setdefault(group, []).append(error)
        print(fit_file, file=sys.stderr)
    return errors


def mean(values):
    return "-" if None in values else f"{sum(values) / len(values):.4f}"


def main():
    programs = Path(sys.argv[1] if len(sys.argv) > 1 else "build/release/bin").resolve()
    data = Path(os.environ["WEFT_DATA"]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        errors = measure(programs, data, Path(folder))
    print("| lights | " + " | ".join(MODELS) + " |\n| --- |" + " --- |" * len(MODELS))
    for count, of_model in errors.items():
        cells = [", ".join(mean(of_group) for of_group in of_model[model].values()) for model in MODELS]
        print(f"| {count} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
