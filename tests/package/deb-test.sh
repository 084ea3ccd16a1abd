#!/bin/bash
# deb-test.sh BUILD: makes the Debian packages, unpacks them into a folder and runs the programs from there.
set -euo pipefail
build=$1
root=$build/test-output/deb
rm -rf "$root"
mkdir -p "$root"
cd "$root"

cpack --config "$build/CPackConfig.cmake" -B "$root" >cpack.log
for package in weft libweft-dev; do
  dpkg-deb --extract ${package}_*.deb root
  dpkg-deb --field ${package}_*.deb >$package.control
done
# What the programs link is depended on, in versions that fit.
for library in libepoxy0 libopenexr libzip4 libembree3; do grep -Eq "^Depends:.*$library" weft.control; done
grep -q "^Depends:.*libepoxy-dev" libweft-dev.control
[[ -f root/usr/lib/cmake/weft/weft-config.cmake && -f root/usr/include/weft/scenegraph/PassiveWindow.h ]]

bin=root/usr/bin share=root/usr/share
for program in bake compare eval fit info render; do
  $bin/weft-$program --version
  # Each option of --help is in the man page.
  page=$(zcat $share/man/man1/weft-$program.1.gz | tr -d '\\')
  for option in $($bin/weft-$program --help | grep -Eo '^  (-[a-z],)?--[a-z-]+' | grep -Eo -- '--.*'); do
    grep -q -- "$option" <<<"$page"
  done
done
if [[ -e $bin/weft-view ]]; then grep -q "^Exec=weft-view" $share/applications/weft-view.desktop; fi
# bash completes options, and what they may be.
source $share/bash-completion/completions/weft-fit
COMP_WORDS=($bin/weft-fit --hold-out-v) COMP_CWORD=1
_weft $bin/weft-fit
[[ ${COMPREPLY[*]} == --hold-out-views ]]
COMP_WORDS=($bin/weft-fit --cosine "") COMP_CWORD=2
_weft $bin/weft-fit
[[ ${COMPREPLY[*]} == "out in" ]]
$bin/weft-bake --pattern weave --size 4 -o weave.zip --quiet
$bin/weft-fit weave.zip --model laf -o weave.rf.exr --quiet
$bin/weft-info weave.rf.exr | grep -q laf
$bin/weft-render shape:cloth --material '*=weave.rf.exr' --size 64x48 -o weave.png --quiet
[[ -s weave.png ]]
