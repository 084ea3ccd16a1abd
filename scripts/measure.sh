#!/bin/bash
# Fits the measured wool and corduroy of $WEFT_DATA with every model and prints what docs/measuring.md explains.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

data=$(realpath "${WEFT_DATA:?set it to the folder of the measured data}")/ubo2003
scripts/build.sh release weft-fit read_field_bench >/dev/null
bin=$PWD/build/release/bin
mkdir -p out/measure
cd out/measure

TIMEFORMAT='%U %S'
fit() { # MATERIAL NAME OPTIONS...: MATERIAL-NAME.rf.exr, .json of weft-fit, and .cpu, its user and system seconds
  local name=$1-$2
  { time "$bin/weft-fit" "$data/UBO_$1.zip" -o "$name.rf.exr" "${@:3}" --quiet --json "$name.json"; } 2>"$name.cpu" ||
    { cat "$name.cpu" >&2 && return 1; }
}

for material in WOOL64 CORDUROY64; do
  fit $material rfp --model rfp
  fit $material rfnl --model rfnl --lobes 2
  fit $material rfnl-per-view --model rfnl --lobes 2 --rho-d per-view
done

python3 - <<'END'
import json

print("| material | model | stored avg | min | max | linear avg | min | max | fit, s | CPU, s | file, MB |")
print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
costs = []
for material in ("WOOL64", "CORDUROY64"):
    average = {}
    for model, label in (("rfp", "rfp"), ("rfnl", "rfnl, 2 lobes"), ("rfnl-per-view", "the same, rho_d per view")):
        with open(f"{material}-{model}.json") as file:
            report = json.load(file)
        with open(f"{material}-{model}.cpu") as file:
            cpu = sum(map(float, file.read().split()[-2:]))
        epsilon = [report["epsilon"][space]["luminance"] for space in ("stored", "linear")]
        average[model] = [e["avg"] for e in epsilon]
        cells = [f"{e[key]:.4f}" for e in epsilon for key in ("avg", "min", "max")]
        cells += [f"{report['seconds']['fit']:.1f}", f"{cpu:.1f}", f"{report['bytes']['file'] / 1e6:.1f}"]
        print(f"| {material} | {label} | " + " | ".join(cells) + " |")
    stored, linear = (100 * (s / p - 1) for s, p in zip(average["rfnl"], average["rfnl-per-view"]))
    costs.append(f"{material}: sharing rho_d costs {stored:+.1f} % of stored eps, {linear:+.1f} % of linear eps")
print("", *costs, "", sep="\n")
END
"$bin/read_field_bench" WOOL64-rfnl.rf.exr --benchmark_min_time=2 2>/dev/null
