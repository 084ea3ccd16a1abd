#!/bin/bash
# Fits the measured wool and corduroy of $WEFT_DATA with every model and prints what docs/measuring.md explains.
# scripts/measure.sh [large]: with "large", times fits of 256 x 256 texels instead (needs python3-numpy, python3-pil).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

data=$(realpath "${WEFT_DATA:?set it to the folder of the measured data}")/ubo2003
scripts/build.sh release weft-fit read_field_bench read_btf_bench >/dev/null
bin=$PWD/build/release/bin
mkdir -p out/measure
cd out/measure

TIMEFORMAT='%R %U %S'
fit() { # INPUT NAME OPTIONS...: NAME.rf.exr, NAME.json of weft-fit, and NAME.time: seconds by the clock, user and system
  { time "$bin/weft-fit" "$1" -o "$2.rf.exr" "${@:3}" --quiet --json "$2.json"; } 2>"$2.time" || { cat "$2.time" >&2 && return 1; }
}

if [[ ${1:-} == large ]]; then
  echo "| 256 x 256 texels | model | s in all | read, s | fit, s | write, s | CPU, s | peak memory, MB | stored eps | linear eps |"
  echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
  for material in wool corduroy; do
    [[ -f $material-256.zip ]] || /usr/bin/python3 "$data/decode.py" "$data/components/$material" "$material-256.zip" >/dev/null
    for model in "loom" "lod" "rfp" "rfnl --lobes 2" "slaf --lobes 4" "laf --lobes 4"; do
      fit $material-256.zip "$material-256-${model%% *}" --model $model
      python3 - "$material" "$model" "$material-256-${model%% *}" <<'END'
import json, sys

material, model, name = sys.argv[1:]
report = json.load(open(f"{name}.json"))
wall, user, system = map(float, open(f"{name}.time").read().split()[-3:])
seconds = report["seconds"]
epsilon = report["epsilon"]
print(f"| {material} | {model} | {wall:.1f} | {seconds['read']:.1f} | {seconds['fit']:.1f} | {seconds['write']:.1f} "
      f"| {user + system:.0f} | {report['peak_memory_bytes'] / 1e6:.0f} "
      f"| {epsilon['stored']['luminance']['avg']:.4f} | {epsilon['linear']['luminance']['avg']:.4f} |")
END
    done
  done
  "$bin/read_btf_bench" wool-256.zip
  exit
fi

models=("loom" "lod" "rfnl --lobes 2 --rho-d per-view" "rfnl --lobes 2" "slaf --lobes 4" "rfp" "laf --lobes 4" "bump" "lfnl --lobes 2" "lfp")
name() { tr -d ' ' <<<"$*"; }
for material in WOOL64 CORDUROY64; do
  for model in "${models[@]}"; do
    fit "$data/UBO_$material.zip" "$material-$(name $model)" --model $model
    fit "$data/UBO_$material.zip" "$material-$(name $model)-held" --model $model --hold-out 8 --hold-out-views 10
  done
done

python3 - "${models[@]}" <<'END'
import json, sys

print("| material | model | stored avg | min | max | held out | linear avg | held out | CPU, s | file, MB | GPU, MB |")
print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
costs = []
for material in ("WOOL64", "CORDUROY64"):
    average = {}
    for model in sys.argv[1:]:
        name = f"{material}-{model.replace(' ', '')}"
        report, held = (json.load(open(f"{name}{suffix}.json")) for suffix in ("", "-held"))
        cpu = sum(map(float, open(f"{name}.time").read().split()[-2:]))
        epsilon = {space: report["epsilon"][space]["luminance"] for space in ("stored", "linear")}
        left = {space: held["held_out"]["epsilon"][space]["luminance"]["avg"] for space in ("stored", "linear")}
        average[model] = [epsilon[space]["avg"] for space in ("stored", "linear")]
        cells = [epsilon["stored"]["avg"], epsilon["stored"]["min"], epsilon["stored"]["max"], left["stored"],
                 epsilon["linear"]["avg"], left["linear"]]
        print(f"| {material} | {model} | " + " | ".join(f"{cell:.4f}" for cell in cells)
              + f" | {cpu:.1f} | {report['bytes']['file'] / 1e6:.1f} | {report['bytes']['gpu'] / 1e6:.1f} |")
    shared, own = average["rfnl --lobes 2"], average["rfnl --lobes 2 --rho-d per-view"]
    stored, linear = (100 * (s / p - 1) for s, p in zip(shared, own))
    costs.append(f"{material}: sharing rho_d costs {stored:+.1f} % of stored eps, {linear:+.1f} % of linear eps")
print("", *costs, "", sep="\n")
END
"$bin/read_field_bench" WOOL64-rfnl--lobes2.rf.exr --benchmark_min_time=2 2>/dev/null
