#!/bin/bash
# subdirectory-test.sh BUILD: a project that takes Weft by add_subdirectory(), and tests of its own beside it.
set -euo pipefail
build=$1
here=$(dirname "$(realpath "$0")")
root=$build/test-output/subdirectory
rm -rf "$root"
mkdir -p "$root"
cd "$root"

cmake -S "$here/subdirectory" -B build -G Ninja -DWEFT_FOLDER="$(realpath "$here/../..")" >configure.log
cmake --build build --target viewer >build.log
build/viewer
# It gets the libraries alone, and none of our settings.
if ninja -C build -t targets all | grep -Eq "weft-fit|core_tests|scene_bench"; then exit 1; fi
