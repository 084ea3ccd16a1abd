#!/bin/bash
# Makes the site of these pages, of what each program says of its options, and of the API reference:
# out/site/index.html. Fails on links that lead nowhere. Needs scripts/install-packages.sh development.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

programs=$(find programs -name 'weft-*.cpp' -printf '%f\n' | sed 's/\.cpp$//')
scripts/build.sh release $programs >/dev/null
scripts/api.sh >/dev/null

pages=out/site-pages
rm -rf $pages
mkdir -p $pages/commands
cp -r --parents ./*.md LICENSE docs samples tests/support/RampModel.h $pages
cp -r out/api/html $pages/api
for program in $programs; do
  scripts/command-page.py markdown build/release/bin/$program >$pages/commands/$program.md
done

log=$(mkdocs build --clean --strict 2>&1) || { echo "$log" >&2; exit 1; }
if grep -A 99 "not included in the \"nav\"" <<<"$log" | grep -v docs/api.md | grep '^  - '; then
  echo "These pages are missing in mkdocs.yml" >&2
  exit 1
fi
scripts/check-site.py out/site
echo "Made out/site/index.html"
