#!/bin/bash
# Builds Weft and runs its tests; alone enough on a bare Debian 12 as root.
# scripts/test.sh [PRESET]: release (default), sanitize, thread-sanitize, or clang (needs install-packages.sh development)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:-release}
scripts/build.sh "$preset"
ctest --preset "$preset" --parallel "$(nproc)"
