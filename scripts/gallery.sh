#!/bin/bash
# Makes every picture of the README and of docs/images, from nothing but what weft-bake ray-traces.
# Needs scripts/install-packages.sh development.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build.sh release weft-bake weft-fit weft-synth weft-render weft-view far_away_bench \
  moving-light own-model >/dev/null
bin=$PWD/build/release/bin scripts=$PWD/scripts samples=$PWD/samples pages=$PWD/docs/images
images=$PWD/out/gallery/images
rm -rf "$images"
mkdir -p "$images"
cd out/gallery

fit() { "$bin/weft-fit" "$@" --quiet >/dev/null; } # INPUT -o FIELD OPTIONS...
picture() { "$bin/weft-render" "${@:2}" --quiet -o "$images/$1.png"; } # NAME SCENE OPTIONS...
cloth() { picture "$1" shape:cloth --material "*=$2.rf.exr" --uv-scale 12 "${@:3}"; }

echo "Baking and fitting"
for pattern in corduroy weave tiles bumps; do
  "$bin/weft-bake" --pattern $pattern -o $pattern.zip --quiet >/dev/null
  fit $pattern.zip -o $pattern.rf.exr
done
for model in rfnl rfp laf bump; do fit corduroy.zip -o corduroy-$model.rf.exr --model $model; done

echo "README, docs/environment.md: cloths"
cloth corduroy corduroy --size 640x480 --light studio --shadows
cloth weave weave --size 640x480 --light studio --shadows
cloth environment-studio corduroy --size 420x330 --env studio
cloth environment-sky weave --size 420x330 --env sky

echo "docs/baking.md: a set of textures"
"$samples/bricks.py" bricks
for map in height albedo roughness; do cp bricks/$map.png "$images/bricks-$map.png"; done
"$bin/weft-bake" --height bricks/height.png --depth 0.03 --albedo bricks/albedo.png \
  --roughness bricks/roughness.png -o bricks.zip --quiet >/dev/null
fit bricks.zip -o bricks.rf.exr
picture sphere-bricks shape:sphere --material '*=bricks.rf.exr' --uv-scale 3 --size 240

echo "docs/gallery.md: patterns, models"
for pattern in corduroy weave tiles bumps; do
  picture sphere-$pattern shape:sphere --material "*=$pattern.rf.exr" --uv-scale 6 --size 240
done
cp corduroy.rf.exr corduroy-loom.rf.exr
for model in loom rfnl rfp laf bump; do
  picture model-$model shape:plane --material "*=corduroy-$model.rf.exr" --uv-scale 2.5 --size 240 \
    --camera 0.5,0.4,1.2:0,0,0
done

echo "docs/synthesis.md: large surfaces"
for pattern in corduroy weave; do
  for method in patches k-coherence; do
    "$bin/weft-synth" $pattern.rf.exr -o $pattern.coords.exr --size 192 192 --method $method \
      --preview "$images/$pattern-$method.png" --quiet >/dev/null
  done
done

echo "docs/far-away.md"
mkdir -p far
"$bin/far_away_bench" corduroy.zip corduroy-rfnl.rf.exr corduroy.rf.exr far/ >far/errors.txt
mv far/plane.png "$images/far-away-plane.png"
mv far/cloth-16.png "$images/far-away-cloth.png"

echo "docs/stochastic-tiling.md: the same at random"
for pattern in bumps corduroy; do
  for tiling in repeat stochastic; do
    picture tiling-$tiling-$pattern shape:plane --material "*=$pattern.rf.exr" --tiling $tiling --uv-scale 8 \
      --size 240 --camera 0,-0.4,0.7:0,-0.05,0
  done
done

echo "docs/viewer.md: a window"
"$scripts/window-picture.py" "$images/viewer.png" 800x520 "$bin/weft-view" weave.rf.exr --size 800x520

echo "docs/your-rti.md: photographs under many lights"
"$bin/weft-bake" --pattern tiles --size 128 -o tiles-128.zip --quiet >/dev/null
"$samples/rti.py" tiles-128.zip relief
fit relief/relief.lp -o relief.rf.exr
rti() { picture "$1" shape:plane --material '*=relief.rf.exr' --camera 0,0,1.45:0,0,0 --size 240 --light "$2"; }
rti rti-above 0,0,4
rti rti-left -4,0,1
rti rti-top 0,4,1

echo "docs/gltf.md: materials of glTF"
"$samples/gltf-materials.py" materials.gltf
picture gltf-materials materials.gltf --env studio --size 880x300

echo "docs/your-scene.md, docs/your-program.md, docs/your-model.md"
"$samples/stool.py" stool.glb
picture scene-plain stool.glb --size 480x360 --camera 0.9,0.75,1.1:0,0.25,0 --shadows
picture scene stool.glb --material seat=corduroy.rf.exr --material floor=tiles.rf.exr --uv-scale 14 \
  --size 480x360 --camera 0.9,0.75,1.1:0,0.25,0 --shadows
"$bin/moving-light" corduroy.rf.exr light 12
for step in 11 1 3; do cp light-$step.png "$images/"; done
"$bin/own-model" corduroy.zip slope.rf.exr "$images/own-model.png"

rm -f "$pages"/* # what is not made here is in no page
cp "$images"/* "$pages"
