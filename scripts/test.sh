#!/bin/bash
# Builds Weft and runs its tests, on a bare Debian 12 too (as root: it installs packages).
# scripts/test.sh [PRESET], release or sanitize
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-release}
scripts/install-packages.sh
cmake --preset "$preset"
cmake --build --preset "$preset" -j "$(nproc)"
ctest --preset "$preset" -j "$(nproc)"
