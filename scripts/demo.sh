#!/bin/bash
# From nothing to pictures in out/demo/: ray-traces a corduroy, fits it, renders it on a cloth, a sphere and a plane.
# Alone enough on a bare Debian 12 as root; needs no measured data.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build.sh release weft-bake weft-fit weft-render
bin=$PWD/build/release/bin
mkdir -p out/demo
cd out/demo

render() { "$bin/weft-render" "$@" --material '*=corduroy.rf.exr'; }

echo "Baking a corduroy: 81 views x 81 lights"
"$bin/weft-bake" --pattern corduroy --size 64 -o corduroy.zip
echo "Fitting two lobes to each of its texels and views"
"$bin/weft-fit" corduroy.zip -o corduroy.rf.exr --model rfnl --lobes 2 --json corduroy.json
echo "Rendering"
render shape:cloth -o cloth.png --uv-scale 24
render shape:sphere -o sphere.png --uv-scale 18 --camera 0.3,0.6,3.1:0,0,0
render shape:plane -o plane.png --size 800x400 --uv-scale 20 --camera 0,-0.75,0.22:0,-0.1,0 \
  --light -3,0.5,1.3:1.3,1.25,1.2 --light 2,-2,1:.1,.12,.15

echo "Made in $PWD:"
for file in corduroy.zip corduroy.rf.exr corduroy.json cloth.png sphere.png plane.png; do
  echo "  $file, $(($(stat -c %s "$file") / 1000)) kB"
done
