#!/bin/bash
# Formats our sources; with --check, only says which ones are not formatted and fails if there are any.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mode=(-i)
if [[ ${1:-} == --check ]]; then mode=(--dry-run --Werror --ferror-limit=1); fi
find core chunks scenegraph materials loaders fitter programs samples tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format "${mode[@]}"
