#!/bin/bash
# Installs what Weft needs (as root, where anything is missing), then configures and builds it.
# scripts/build.sh [PRESET [TARGET...]]: release (default), sanitize, thread-sanitize or clang; by default
# the preset's targets
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-release}
targets=("${@:2}")
scripts/install-packages.sh
cmake --preset "$preset" --log-level=WARNING
cmake --build --preset "$preset" --parallel "$(nproc)" ${targets:+--target "${targets[@]}"}
