#!/bin/bash
# install-test.sh BUILD: installs a build, then builds and runs two projects that find it there.
set -euo pipefail
build=$1
here=$(dirname "$(realpath "$0")")
root=$build/test-output/install
rm -rf "$root"
mkdir -p "$root"
cd "$root"

cmake --install "$build" --prefix prefix >install.log
for consumer in scenegraph scene_io; do
  cmake -S "$here/$consumer" -B $consumer -G Ninja -DCMAKE_PREFIX_PATH="$root/prefix" >$consumer.log
  cmake --build $consumer
done
scenegraph/scenegraph_consumer
prefix/bin/weft-bake --pattern weave --size 4 -o weave.zip --quiet
prefix/bin/weft-fit weave.zip --model laf -o weave.rf.exr --quiet
scene_io/offscreen weave.rf.exr weave.png
[[ $(head -c 4 weave.png | tail -c 3) == PNG ]]

# A misspelled component is told.
if cmake -S "$here/scenegraph" -B none -G Ninja -DCMAKE_PREFIX_PATH="$root/prefix" -DCOMPONENT=scenegaph 2>none.log; then
  exit 1
fi
grep -q "no component scenegaph" none.log
