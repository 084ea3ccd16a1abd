#!/bin/bash
# Installs the Debian 12 packages that building and testing Weft needs. Does nothing where all are there.
# scripts/install-packages.sh [development]: with it, also what .ci/run and scripts/site.sh need
set -euo pipefail

packages=(
  build-essential cmake ninja-build pkg-config clang-format
  libexpected-dev libfmt-dev libglm-dev libcli11-dev nlohmann-json3-dev
  libepoxy-dev libegl-dev libopengl-dev libegl-mesa0 libgl1-mesa-dri # Mesa's EGL and software renderer
  libopenexr-dev libimath-dev libpng-dev libzip-dev libutf8proc-dev
  libturbojpeg0-dev libjpeg62-turbo-dev # the latter for the former's CMake config
  libtinygltf-dev # its header alone
  libdraco-dev libmeshoptimizer-dev # optional: glTF files that are packed
  libeigen3-dev libceres-dev libhwy-dev libtbb-dev libembree-dev
  libopenmpi-dev openmpi-bin # optional: fits of several processes
  libgtest-dev libgmock-dev libbenchmark-dev
  libimgui-dev # optional, with libglfw3-dev: weft-view
  libxtst-dev # its tests
  libglfw3-dev libopenscenegraph-dev xvfb # optional, 120 packages: the samples that embed Weft, and their tests
  assimp-testmodels # optional: glTF files, valid and broken, for the loader's tests
  openexr # exrheader, which must understand our files
  python3 # man pages, scripts/measure.sh
)

if [[ ${1:-} == development ]]; then
  packages+=(
    clang # another compiler's warnings and numbers
    locales # de_DE.UTF-8, where numbers have a comma
    doxygen doxygen-awesome-css # the API reference
    mkdocs mkdocs-material # the site
    python3-pil # a window as a picture: scripts/gallery.sh
  )
fi

missing=()
for package in "${packages[@]}"; do
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then exit 0; fi
if ((EUID != 0)); then
  echo "These packages are missing; install them as root: ${missing[*]}" >&2
  exit 1
fi
echo "Installing ${#missing[@]} packages and what they need"
export DEBIAN_FRONTEND=noninteractive
apt-get -qq update
apt-get -qq -o Dpkg::Use-Pty=0 install --no-install-recommends "${missing[@]}" >/dev/null
