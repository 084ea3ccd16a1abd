#!/bin/bash
# Makes the API reference from the comments of the public headers: out/api/html/index.html.
# Needs scripts/install-packages.sh development.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mkdir -p out/api
doxygen docs/Doxyfile
echo "Made out/api/html/index.html"
